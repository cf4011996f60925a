#include "cli/commands/piece_table.h"

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/csv.h"
#include "base/text.h"
#include "cli/options/output_pattern.h"
#include "parser/cell.h"
#include "parser/loader.h"
#include "parser/parameter_set.h"
#include "parser/variables.h"

namespace lamina::cli {
namespace {

constexpr const char* kNameColumn = "name";
constexpr const char* kRowWord = "row";

const Source& read_table(const std::string& path, const FileAccess& access,
                         SourceStore& sources) {
  access.require(path);
  std::optional<std::string> text = access.read(path);
  if (!text) {
    throw FileError(fmt::format("Can't open table '{}'", path));
  }
  return sources.add(path, std::move(*text));
}

// Runs `work`, which completes the piece. What it throws is the piece's fault.
template <typename Work>
void complete(Piece& piece, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    piece.fault = error.what();
    piece.request.output.clear();
  }
}

// The variables that the design lets others set. Its warnings come with its
// pieces.
Variables variables_of(const compiler::Request& request,
                       const FileAccess& access, SourceStore& sources,
                       Diagnostics& diagnostics) {
  Diagnostics messages([&](const Diagnostic& message) {
    if (message.severity == Severity::kError) diagnostics.report(message);
  });
  Loader loader(sources, messages, library_folders(access), request.definitions,
                access);
  return find_variables(loader.load(request.design), loader);
}

struct Column {
  std::string name;
  std::optional<ast::ValueType> variable;  // that it sets
};

// Returns what `work` returns; names the column in whatever FileError it
// throws.
template <typename Work>
std::string name_fault(const std::string& column, const Work& work) {
  try {
    return work();
  } catch (const FileError& error) {
    throw FileError(fmt::format("{}: {}", column, error.what()));
  }
}

class TableReader {
 public:
  TableReader(const TableOptions& options, const FileAccess& access,
              SourceStore& sources, Diagnostics& diagnostics)
      : options_(options),
        file_access_(access),
        sources_(sources),
        csv_(read_csv(read_table(options.table, access, sources))),
        decimal_(csv_.separator == ',' ? DecimalSign::kPoint
                                       : DecimalSign::kPointOrComma),
        diagnostics_(diagnostics) {
    for (std::string& word : words_of_pattern(options.request.output)) {
      words_.insert(std::move(word));
    }
  }

  std::vector<Piece> read() {
    if (csv_.rows.size() < 2) {
      diagnostics_.error(
          {}, fmt::format("'{}' has no rows below its header", options_.table));
      return {};
    }
    read_header(
        variables_of(options_.request, file_access_, sources_, diagnostics_));
    std::vector<Piece> pieces;
    for (std::size_t i = 1; i < csv_.rows.size(); ++i) {
      pieces.push_back(read_piece(csv_.rows[i], i));
    }
    return pieces;
  }

 private:
  void read_header(const Variables& variables) {
    const CsvRow& header = csv_.rows.front();
    for (const std::string& name : header.cells) {
      check_repeated(header, name);
      columns_.push_back({name, kind_of(name, variables)});
      const bool is_of_use = columns_.back().variable || name == kNameColumn ||
                             words_.contains(name) ||
                             options_.skipped.contains(name);
      if (!is_of_use) refuse_column(header, name);
    }
    for (const std::string& word : words_) {
      if (word == kRowWord || find_column(word) != nullptr) continue;
      diagnostics_.error({},
                         fmt::format("'{}' in '{}' is no column of '{}'", word,
                                     options_.request.output, options_.table));
    }
  }

  // No value where the column sets no variable.
  std::optional<ast::ValueType> kind_of(const std::string& name,
                                        const Variables& variables) const {
    if (options_.skipped.contains(name)) return std::nullopt;
    const auto variable = variables.find(name);
    if (variable != variables.end()) return variable->second;
    if (name.starts_with('$')) return ast::ValueType::kAny;
    return std::nullopt;
  }

  void refuse_column(const CsvRow& header, const std::string& name) {
    if (name.empty()) {
      diagnostics_.error(header.range, "a column has no name");
      return;
    }
    diagnostics_.error(
        header.range,
        fmt::format("'{0}' is no variable of '{1}' (--skip {0} passes over it)",
                    name, options_.request.design));
  }

  void check_repeated(const CsvRow& header, const std::string& name) {
    if (find_column(name) == nullptr) return;
    diagnostics_.error(header.range,
                       fmt::format("two columns are called '{}'", name));
  }

  const Column* find_column(const std::string& name) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(),
                     [&](const Column& c) { return c.name == name; });
    return found == columns_.end() ? nullptr : &*found;
  }

  // number  of the row, from 1
  Piece read_piece(const CsvRow& row, std::size_t number) {
    Piece piece;
    piece.request = options_.request;
    piece.line = row.line;
    piece.name = cell_of(row, kNameColumn);
    piece.prefix = fmt::format("{}:{}: ", options_.table, row.line);
    if (piece.name.empty()) {
      piece.name = fmt::format("{}", number);
    } else {
      piece.prefix += on_one_line(piece.name) + ": ";
    }
    complete(piece, [&] {
      check_width(row);
      piece.request.definitions += definitions_of(row);
      piece.request.output = output_of(row, number);
    });
    return piece;
  }

  void check_width(const CsvRow& row) const {
    const std::size_t wanted = columns_.size();
    const bool has_more =
        row.cells.size() > wanted &&
        std::any_of(row.cells.begin() + static_cast<std::ptrdiff_t>(wanted),
                    row.cells.end(),
                    [](const std::string& cell) { return !cell.empty(); });
    if (row.cells.size() >= wanted && !has_more) return;
    throw FileError(fmt::format("the row has {} cells, the header has {}",
                                row.cells.size(), wanted));
  }

  // Empty where the row has no such cell.
  std::string cell_of(const CsvRow& row, const std::string& name) const {
    const Column* column = find_column(name);
    if (column == nullptr) return "";
    const auto index = static_cast<std::size_t>(column - columns_.data());
    return index < row.cells.size() ? row.cells[index] : "";
  }

  std::string definitions_of(const CsvRow& row) const {
    std::string text;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      if (!column.variable || row.cells[i].empty()) continue;
      const std::string value = name_fault(column.name, [&] {
        return value_of_cell(row.cells[i], *column.variable, decimal_);
      });
      text += fmt::format("{}={};\n", column.name, value);
    }
    return text;
  }

  std::string output_of(const CsvRow& row, std::size_t number) const {
    return fill_pattern(
        options_.request.output, [&](const std::string& word) -> std::string {
          if (word == kRowWord && find_column(word) == nullptr) {
            return fmt::format("{}", number);
          }
          return name_fault(
              word, [&] { return require_part_of_name(cell_of(row, word)); });
        });
  }

  const TableOptions& options_;
  const FileAccess& file_access_;
  SourceStore& sources_;
  const Csv csv_;
  const DecimalSign decimal_;
  Diagnostics& diagnostics_;
  std::set<std::string> words_;  // of the pattern
  std::vector<Column> columns_;
};

// The pieces of a file of parameter sets. Words of the pattern can only be
// {name} and {row}.
std::vector<Piece> read_sets(const TableOptions& options,
                             const FileAccess& access,
                             Diagnostics& diagnostics) {
  for (const std::string& word : words_of_pattern(options.request.output)) {
    if (word == kRowWord || word == kNameColumn) continue;
    diagnostics.error(
        {},
        fmt::format("'{}' in '{}' means nothing for parameter sets; {{name}} "
                    "is that of the set",
                    word, options.request.output));
  }
  std::vector<Piece> pieces;
  for (const std::string& name : parameter_set_names(options.table, access)) {
    Piece& piece = pieces.emplace_back();
    piece.request = options.request;
    piece.request.parameter_file = options.table;
    piece.request.parameter_set = name;
    piece.name = name;
    piece.prefix = fmt::format("{}: {}: ", options.table, on_one_line(name));
    complete(piece, [&] {
      piece.request.output =
          fill_pattern(options.request.output, [&](const std::string& word) {
            return word == kRowWord ? fmt::format("{}", pieces.size())
                                    : require_part_of_name(name);
          });
    });
  }
  if (pieces.empty()) {
    diagnostics.error({}, fmt::format("'{}' has no sets", options.table));
  }
  return pieces;
}

void refuse_equal_outputs(const std::vector<Piece>& pieces,
                          const FileAccess& access, Diagnostics& diagnostics) {
  std::map<std::string, const Piece*> outputs;
  for (const Piece& piece : pieces) {
    if (!piece.fault.empty()) continue;
    const auto [first, is_new] = outputs.try_emplace(
        access.run_files()->place_of(piece.request.output, access), &piece);
    if (is_new) continue;
    diagnostics.error(
        {}, fmt::format("{}and {}have one output, '{}'", first->second->prefix,
                        piece.prefix, piece.request.output));
  }
}

}  // namespace

std::vector<Piece> read_pieces(const TableOptions& options,
                               const FileAccess& access, SourceStore& sources,
                               Diagnostics& diagnostics) {
  std::vector<Piece> pieces;
  if (options.table.ends_with(".json")) {
    pieces = read_sets(options, access, diagnostics);
  } else {
    pieces = TableReader(options, access, sources, diagnostics).read();
  }
  refuse_equal_outputs(pieces, access, diagnostics);
  return pieces;
}

}  // namespace lamina::cli
