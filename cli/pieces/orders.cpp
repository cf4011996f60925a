#include "cli/pieces/orders.h"

#include <map>
#include <utility>

#include <fmt/format.h>

#include "base/file/csv.h"
#include "base/paths.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/piece_table.h"
#include "compiler/validate.h"
#include "parser/cell.h"

namespace lamina::cli {
namespace {

// More of one order is a mistake.
constexpr std::uint64_t kMostCopies = 100000;

class OrderReader {
 public:
  OrderReader(const std::string& table, const compiler::Request& request,
              const FileAccess& access, SourceStore& sources,
              Diagnostics& diagnostics)
      : request_(request),
        access_(access),
        sources_(sources),
        diagnostics_(diagnostics),
        reader_(
            table,
            [bytes = read(table, access)]() mutable {
              return std::exchange(bytes, {});
            },
            sources) {}

  std::vector<Order> read_all() {
    std::vector<Order> orders;
    if (!reader_.next(row_) || row_.cells.empty()) return orders;
    columns_ = row_.cells;
    while (reader_.next(row_)) orders.push_back(order());
    return orders;
  }

 private:
  static std::string read(const std::string& table, const FileAccess& access) {
    access.require(table);
    auto bytes = access.read(table);
    if (!bytes) throw FileError(fmt::format("Can't open table '{}'", table));
    return std::move(*bytes);
  }

  Order order() {
    Order order;
    order.request = request_;
    order.name = fmt::format("row {}", ++number_);
    if (row_.cells.size() != columns_.size()) {
      fail(fmt::format("the row has {} cells, the header has {}",
                       row_.cells.size(), columns_.size()));
      return order;
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      take_own(columns_[i], row_.cells[i], order);
    }
    if (order.request.design.path.empty()) {
      fail("the row names no design, and neither does the command line");
      return order;
    }
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      if (is_own(columns_[i]) || row_.cells[i].empty()) continue;
      take_variable(columns_[i], row_.cells[i], order);
    }
    return order;
  }

  static bool is_own(const std::string& column) {
    return column == "name" || column == "design" || column == "quantity" ||
           column == "material";
  }

  void take_own(const std::string& column, const std::string& cell,
                Order& order) {
    if (cell.empty()) return;
    if (column == "name") order.name = cell;
    if (column == "design") order.request.design.path = cell;
    if (column == "material") order.request.output.material = cell;
    if (column != "quantity") return;
    const auto count = whole_number(cell);
    if (!count || *count > kMostCopies) {
      fail(fmt::format("quantity: a number of copies was expected, not '{}'",
                       cell));
    } else {
      order.quantity = static_cast<std::size_t>(*count);
    }
  }

  void take_variable(const std::string& column, const std::string& cell,
                     Order& order) {
    const Variables& variables = variables_of_design(order.request);
    const auto variable = variables.find(column);
    if (variable == variables.end() && !is_special_variable(column)) {
      fail(fmt::format("'{}' has no variable '{}'", order.request.design.path,
                       column));
      return;
    }
    const auto kind =
        variable == variables.end() ? ast::ValueType::kAny : variable->second;
    const DecimalSign decimal = reader_.separator() == ','
                                    ? DecimalSign::kPoint
                                    : DecimalSign::kPointOrComma;
    try {
      order.request.design.definitions +=
          fmt::format("{}={};\n", column, value_of_cell(cell, kind, decimal));
    } catch (const FileError& error) {
      fail(fmt::format("{}: {}", column, error.diagnostic().message));
    }
  }

  const Variables& variables_of_design(const compiler::Request& request) {
    const auto known = variables_.find(request.design.path);
    if (known != variables_.end()) return known->second;
    return variables_
        .emplace(request.design.path,
                 compiler::is_imported(request.design.path)
                     ? Variables()
                     : variables_of(request, access_, sources_, diagnostics_))
        .first->second;
  }

  void fail(std::string message) {
    diagnostics_.error(reader_.range_of_row(), std::move(message));
  }

  const compiler::Request& request_;
  const FileAccess& access_;
  SourceStore& sources_;
  Diagnostics& diagnostics_;
  CsvReader reader_;
  CsvRow row_;
  std::vector<std::string> columns_;
  std::map<std::string, Variables> variables_;  // by design
  std::size_t number_ = 0;
};

}  // namespace

void check(const OrderSources& from, std::string_view command) {
  compiler::refuse_if(from.designs.empty() && from.table.empty(),
                      "{} needs a design or --table", command);
  compiler::refuse_if(
      from.designs.size() > 1 && !from.table.empty(),
      "with --table one design at most: that of rows without one");
  compiler::refuse_if(from.copies && !from.table.empty(),
                      "--copies is the table's column 'quantity'");
  for (const std::string& design : from.designs) refuse_layers(design);
}

std::vector<Order> read_orders(const OrderSources& from,
                               const compiler::Request& request,
                               const FileAccess& access, SourceStore& sources,
                               Diagnostics& diagnostics) {
  std::vector<Order> orders;
  if (from.table.empty()) {
    for (const std::string& design : from.designs) {
      orders.push_back({stem(design), request, from.copies.value_or(1)});
      orders.back().request.design.path = design;
    }
    return orders;
  }
  orders =
      OrderReader(from.table, request, access, sources, diagnostics).read_all();
  if (orders.empty()) {
    diagnostics.error(
        {}, fmt::format("'{}' has no rows below its header", from.table));
  }
  return orders;
}

}  // namespace lamina::cli
