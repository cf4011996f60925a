#include "cli/pieces/piece_table.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <sys/stat.h>

#include "base/file/csv.h"
#include "base/paths.h"
#include "base/text.h"
#include "cli/options/output_pattern.h"
#include "parser/cell.h"
#include "parser/customizer/definitions.h"
#include "parser/customizer/parameter_set.h"
#include "parser/loader.h"

namespace lamina::cli {
namespace {

constexpr const char* kNameColumn = "name";
constexpr const char* kRowWord = "row";

// What a row says of its piece.
struct Row {
  std::uint64_t number = 0;  // from 1
  std::uint32_t line = 0;    // 0: none
  std::string name;          // empty: it has none
  std::string definitions;
  std::optional<ParameterSet> parameters;
  std::string output;
  std::string fault;
};

class Rows {
 public:
  virtual ~Rows() = default;
  // False behind the last one.
  virtual bool next(Row& row) = 0;
  // Begins again with the first one.
  virtual void rewind() = 0;
};

// Runs `work`, which completes the row. What it throws is the row's fault.
template <typename Work>
void complete(Row& row, const Work& work) {
  try {
    work();
  } catch (const Error& error) {
    row.fault = error.diagnostic().message;
    row.output.clear();
  }
}

// The bytes of a table, which can be read again. What comes through a pipe is
// kept; a file must not change meanwhile.
class TableFile {
 public:
  // Throws FileError where it cannot be read, AccessError where it may not be.
  TableFile(const std::string& path, const FileAccess& access) : path_(path) {
    access.require(path);
    if (access.is_regular_file(path)) {
      file_ = access.open(path);
    } else {
      bytes_ = access.read(path);
    }
    if ((!file_ && !bytes_) ||
        (file_ && ::fstat(file_.descriptor(), &status_) != 0)) {
      throw FileError(fmt::format("Can't open table '{}'", path));
    }
  }

  // As CsvReader::Read, from the begin on. Outlived by the file.
  CsvReader::Read from_begin() {
    return [this, offset = std::uint64_t{0}]() mutable {
      std::string block = block_at(offset);
      offset += block.size();
      return block;
    };
  }

 private:
  std::string block_at(std::uint64_t offset) const {
    constexpr std::size_t kBlock = std::size_t{1} << 20;
    if (bytes_) {
      return bytes_->substr(std::min<std::size_t>(offset, bytes_->size()),
                            kBlock);
    }
    if (offset >= static_cast<std::uint64_t>(status_.st_size)) return {};
    const auto block = file_.read_at(offset, kBlock);
    check_machine(path_, block ? 0 : EIO);
    if (!file_.is_unchanged_since(status_)) check_machine(path_, ESTALE);
    return *block;
  }

  const std::string path_;
  OpenFile file_;
  struct stat status_ {};
  std::optional<std::string> bytes_;
};

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
    throw FileError(fmt::format("{}: {}", column, error.diagnostic().message));
  }
}

class CsvRows : public Rows {
 public:
  CsvRows(const TableOptions& options, const FileAccess& access,
          SourceStore& sources, Diagnostics& diagnostics)
      : options_(options),
        file_access_(access),
        sources_(sources),
        file_(options.table, access),
        diagnostics_(diagnostics) {
    for (std::string& word : words_of_pattern(options.request.output.path)) {
      words_.insert(std::move(word));
    }
  }

  // Reads the header; of a table without one nothing.
  void begin() {
    rewind();
    if (cells_.cells.empty()) return;
    read_header(
        variables_of(options_.request, file_access_, sources_, diagnostics_));
  }

  bool next(Row& row) override {
    if (!reader_->next(cells_)) return false;
    row = {};
    row.number = ++number_;
    row.line = cells_.line;
    row.name = cell_of(kNameColumn);
    complete(row, [&] {
      check_width();
      row.definitions = definitions();
      row.output = output();
    });
    return true;
  }

  void rewind() override {
    reader_.emplace(options_.table, file_.from_begin(), sources_);
    reader_->next(cells_);
    number_ = 0;
  }

 private:
  void read_header(const Variables& variables) {
    decimal_ = reader_->separator() == ',' ? DecimalSign::kPoint
                                           : DecimalSign::kPointOrComma;
    const SourceRange header = reader_->range_of_row();
    for (const std::string& name : cells_.cells) {
      const bool is_new = places_.emplace(name, columns_.size()).second;
      columns_.push_back({name, kind_of(name, variables)});
      if (!is_new) refuse_repeated(header, name);
      const bool is_of_use = columns_.back().variable || name == kNameColumn ||
                             words_.contains(name) ||
                             options_.skipped.contains(name);
      if (!is_of_use) refuse_column(header, name);
    }
    for (const std::string& word : words_) {
      if (word == kRowWord || places_.contains(word)) continue;
      diagnostics_.error(
          {}, fmt::format("'{}' in '{}' is no column of '{}'", word,
                          options_.request.output.path, options_.table));
    }
  }

  // No value where the column sets no variable.
  std::optional<ast::ValueType> kind_of(const std::string& name,
                                        const Variables& variables) const {
    if (options_.skipped.contains(name)) return std::nullopt;
    const auto variable = variables.find(name);
    if (variable != variables.end()) return variable->second;
    if (is_special_variable(name)) return ast::ValueType::kAny;
    return std::nullopt;
  }

  void refuse_column(SourceRange header, const std::string& name) {
    if (name.empty()) {
      diagnostics_.error(header, "a column has no name");
      return;
    }
    diagnostics_.error(
        header,
        fmt::format(
            "'{1}' has no variable '{0}' (--skip {0} ignores the column)", name,
            options_.request.design.path));
  }

  void refuse_repeated(SourceRange header, const std::string& name) {
    diagnostics_.error(header,
                       fmt::format("two columns are called '{}'", name));
  }

  void check_width() const {
    const CsvRow& row = cells_;
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
  std::string cell_of(const std::string& name) const {
    const auto place = places_.find(name);
    return place != places_.end() && place->second < cells_.cells.size()
               ? cells_.cells[place->second]
               : "";
  }

  std::string definitions() const {
    std::string text;
    for (std::size_t i = 0; i < columns_.size(); ++i) {
      const Column& column = columns_[i];
      const std::string& cell = cells_.cells[i];
      if (!column.variable || cell.empty()) continue;
      const std::string value = name_fault(column.name, [&] {
        return value_of_cell(cell, *column.variable, decimal_);
      });
      text += fmt::format("{}={};\n", column.name, value);
    }
    return text;
  }

  std::string output() const {
    return fill_pattern(options_.request.output.path,
                        [&](const std::string& word) -> std::string {
                          if (word == kRowWord && !places_.contains(word)) {
                            return fmt::format("{}", number_);
                          }
                          return name_fault(word, [&] {
                            return require_part_of_name(cell_of(word));
                          });
                        });
  }

  const TableOptions& options_;
  const FileAccess& file_access_;
  SourceStore& sources_;
  TableFile file_;
  Diagnostics& diagnostics_;
  std::set<std::string> words_;  // of the pattern
  std::optional<CsvReader> reader_;
  DecimalSign decimal_ = DecimalSign::kPoint;
  std::vector<Column> columns_;
  std::map<std::string, std::size_t> places_;  // of columns, by their names
  CsvRow cells_;                               // read last
  std::uint64_t number_ = 0;
};

// Words of the pattern can only be {name} and {row}.
class SetRows : public Rows {
 public:
  SetRows(const TableOptions& options, const FileAccess& access,
          Diagnostics& diagnostics)
      : options_(options), sets_(ParameterSets::read(options.table, access)) {
    for (const std::string& word :
         words_of_pattern(options.request.output.path)) {
      if (word == kRowWord || word == kNameColumn) continue;
      diagnostics.error(
          {}, fmt::format("'{}' in '{}' means nothing for parameter sets; "
                          "{{name}} is that of the set",
                          word, options.request.output.path));
    }
  }

  bool next(Row& row) override {
    if (number_ == sets_.size()) return false;
    row = {};
    row.name = sets_.name_of(number_);
    row.number = ++number_;
    complete(row, [&] {
      row.parameters = sets_.values_of(row.number - 1);
      row.output = fill_pattern(
          options_.request.output.path, [&](const std::string& word) {
            return word == kRowWord ? fmt::format("{}", row.number)
                                    : require_part_of_name(row.name);
          });
    });
    return true;
  }

  void rewind() override { number_ = 0; }

 private:
  const TableOptions& options_;
  const ParameterSets sets_;
  std::uint64_t number_ = 0;
};

class PieceTable : public PieceSource {
 public:
  PieceTable(const TableOptions& options, std::unique_ptr<Rows> rows)
      : options_(options), rows_(std::move(rows)) {}

  std::uint64_t count() const override { return count_; }

  std::optional<Piece> next() override {
    while (rows_->next(row_)) {
      if (options_.share.has(row_.number)) return piece_of(row_);
    }
    return std::nullopt;
  }

  // Counts the pieces, tells their outputs to RunFiles, and begins again.
  void check(const FileAccess& access, Diagnostics& diagnostics) {
    RunFiles& files = *access.run_files();
    // Outputs that may not be the only ones of their name, by their places.
    std::set<std::string> doubtful;
    constexpr std::size_t kMostTold = 100;
    std::uint64_t all = 0;
    for (; rows_->next(row_); ++all) {
      const bool is_own = options_.share.has(row_.number);
      if (is_own) ++count_;
      if (!row_.fault.empty()) continue;
      const bool is_new =
          is_own ? files.expect_one_of_many(row_.output, access)
                 : files.expect_of_another_run(row_.output, access);
      if (is_new || doubtful.size() >= kMostTold) continue;
      doubtful.insert(files.place_of(row_.output, access));
    }
    if (all == 0) {
      diagnostics.error({},
                        options_.table.ends_with(".json")
                            ? fmt::format("'{}' has no sets of OpenSCAD's "
                                          "customizer",
                                          options_.table)
                            : fmt::format("'{}' has no rows below its header",
                                          options_.table));
    }
    files.end_of_many();
    rows_->rewind();
    if (doubtful.empty()) return;
    refuse_equal_outputs(doubtful, access, diagnostics);
    rows_->rewind();
  }

 private:
  // "orders.csv:17: ring-17: "
  std::string prefix_of(const Row& row) const {
    std::string prefix = short_name(display_path(options_.table));
    if (row.line > 0) prefix += fmt::format(":{}", row.line);
    prefix += ": ";
    if (!row.name.empty()) prefix += short_name(row.name) + ": ";
    return prefix;
  }

  Piece piece_of(const Row& row) const {
    Piece piece;
    piece.request = options_.request;
    piece.request.design.definitions += row.definitions;
    piece.request.output.path = row.output;
    piece.request.design.parameters = row.parameters;
    piece.name = row.name.empty() ? fmt::format("{}", row.number) : row.name;
    piece.prefix = prefix_of(row);
    piece.number = row.number;
    piece.line = row.line;
    piece.fault = row.fault;
    return piece;
  }

  void refuse_equal_outputs(const std::set<std::string>& doubtful,
                            const FileAccess& access,
                            Diagnostics& diagnostics) {
    std::map<std::string, std::string> firsts;  // prefixes, by places
    while (rows_->next(row_)) {
      if (!row_.fault.empty()) continue;
      const std::string place =
          access.run_files()->place_of(row_.output, access);
      if (!doubtful.contains(place)) continue;
      const auto [first, is_new] = firsts.try_emplace(place, prefix_of(row_));
      if (is_new) continue;
      diagnostics.error(
          {}, fmt::format("{}and {}would both write '{}'", first->second,
                          prefix_of(row_), row_.output));
    }
  }

  const TableOptions& options_;
  std::unique_ptr<Rows> rows_;
  Row row_;
  std::uint64_t count_ = 0;
};

std::unique_ptr<Rows> open_rows(const TableOptions& options,
                                const FileAccess& access, SourceStore& sources,
                                Diagnostics& diagnostics) {
  if (options.table.ends_with(".json")) {
    return std::make_unique<SetRows>(options, access, diagnostics);
  }
  auto rows = std::make_unique<CsvRows>(options, access, sources, diagnostics);
  rows->begin();
  return rows;
}

}  // namespace

Variables variables_of(const compiler::Request& request,
                       const FileAccess& access, SourceStore& sources,
                       Diagnostics& diagnostics) {
  Diagnostics messages([&](const Diagnostic& message) {
    if (message.severity == Severity::kError) diagnostics.report(message);
  });
  Loader loader(sources, messages, library_folders(access),
                request.design.definitions, access);
  return find_variables(loader.load(request.design.path), loader);
}

bool is_special_variable(std::string_view name) {
  return name.size() > 1 && name[0] == '$' &&
         std::all_of(name.begin() + 1, name.end(), [](char c) {
           return c == '_' || (c >= '0' && c <= '9') ||
                  (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
         });
}

std::unique_ptr<PieceSource> open_table(const TableOptions& options,
                                        const FileAccess& access,
                                        SourceStore& sources,
                                        Diagnostics& diagnostics) {
  auto table = std::make_unique<PieceTable>(
      options, open_rows(options, access, sources, diagnostics));
  if (!diagnostics.has_errors()) table->check(access, diagnostics);
  return table;
}

}  // namespace lamina::cli
