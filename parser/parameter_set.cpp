#include "parser/parameter_set.h"

#include <algorithm>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "parser/detail/customizer_value.h"
#include "parser/tree_facts.h"

namespace lamina {
namespace {

struct Entry {
  std::string name;
  std::string text;
};

// Collects the entries of one set while the file is read. It keeps the texts of
// numbers as they stand there, which a tree of values would not.
class SetReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit SetReader(const std::string& set)
      : wanted_({"parameterSets", set}) {}

  bool is_found() const { return is_found_; }
  std::vector<Entry> take_entries() { return std::move(entries_); }
  const std::string& complaint() const { return complaint_; }

  bool null() override { return add("null"); }
  bool boolean(bool value) override { return add(value ? "true" : "false"); }
  bool number_integer(number_integer_t value) override {
    return add(fmt::format("{}", value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return add(fmt::format("{}", value));
  }
  bool number_float(number_float_t /*value*/, const string_t& text) override {
    return add(text);
  }
  bool string(string_t& text) override { return add(text); }
  bool binary(binary_t& /*bytes*/) override { return add(""); }

  bool start_object(std::size_t /*size*/) override {
    add("");
    path_.emplace_back();
    if (is_in_set()) is_found_ = true;
    return true;
  }
  bool end_object() override {
    path_.pop_back();
    return true;
  }
  bool key(string_t& name) override {
    path_.back() = name;
    return true;
  }
  bool start_array(std::size_t /*size*/) override {
    add("");
    path_.emplace_back();
    return true;
  }
  bool end_array() override { return end_object(); }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    position_ = position;
    const std::string_view what = error.what();
    // "[json.exception.parse_error.101] parse error at line 2, column 1: …"
    complaint_ = what.substr(what.find(": ") + 2);
    return false;
  }
  std::size_t error_position() const { return position_; }

 private:
  bool is_in_set() const {
    return path_.size() == 3 &&
           std::equal(wanted_.begin(), wanted_.end(), path_.begin());
  }

  bool add(std::string text) {
    if (is_in_set()) entries_.push_back({path_.back(), std::move(text)});
    return true;
  }

  std::vector<std::string> wanted_;
  std::vector<std::string> path_;  // names around what is being read
  std::vector<Entry> entries_;
  bool is_found_ = false;
  std::string complaint_;
  std::size_t position_ = 0;
};

std::optional<std::vector<Entry>> read_set(const std::string& path,
                                           const std::string& set,
                                           const FileAccess& access,
                                           Diagnostics& diagnostics) {
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(
        {}, fmt::format("Cannot open Parameter Set '{}': {}", path, why));
    return std::nullopt;
  };
  access.require(path);
  const std::optional<std::string> text = access.read(path);
  if (!text) return refuse(path + ": cannot open file");
  SetReader reader(set);
  if (!nlohmann::json::sax_parse(*text, &reader)) {
    const std::size_t position =
        std::min(reader.error_position(), text->size());
    const auto end =
        text->begin() + static_cast<std::string::difference_type>(position);
    return refuse(fmt::format("{}({}): {}", path,
                              std::count(text->begin(), end, '\n') + 1,
                              reader.complaint()));
  }
  if (!reader.is_found()) {
    diagnostics.error(
        {}, fmt::format("Cannot apply Parameter Set '{}': '{}' has no such set",
                        set, path));
    return std::nullopt;
  }
  return reader.take_entries();
}

std::optional<bool> read_truth(std::string_view text) {
  const auto is_blank = [](char c) { return c == ' ' || c == '\t'; };
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  return std::nullopt;
}

// The text as a value of a parameter of type `type`; null where it is none.
const ast::Expr* read_value(std::string_view text, ast::ValueType type,
                            Arena& arena) {
  if (type == ast::ValueType::kString) {
    return arena.make(ast::Expr{ast::String{arena.copy(text)}, {}});
  }
  if (type == ast::ValueType::kBool) {
    const std::optional<bool> truth = read_truth(text);
    return truth ? arena.make(ast::Expr{ast::Bool{*truth}, {}}) : nullptr;
  }
  const ast::Expr* value = detail::read_customizer_value(text, arena);
  const bool is_fit = value != nullptr && ast::type_of(*value) == type;
  return is_fit ? value : nullptr;
}

// Sets what `statement` assigns. False where the text is no value of a
// parameter that wants true or false.
bool set_value(const ast::Statement*& statement, std::string_view text,
               Arena& arena) {
  const auto& assignment = std::get<ast::Assignment>(statement->node);
  const auto type = ast::type_of(*assignment.value);
  if (type == ast::ValueType::kAny) return true;
  const ast::Expr* value = read_value(text, type, arena);
  if (value == nullptr) return type != ast::ValueType::kBool;
  // A variable that was no parameter must not become one, so its value gets no
  // place: comments describe values that have one.
  const bool was_literal = ast::is_literal(*assignment.value);
  const SourceRange range =
      was_literal ? assignment.value->range : SourceRange();
  ast::Statement replaced = *statement;
  replaced.node = ast::Assignment{assignment.name,
                                  arena.make(ast::Expr{value->node, range})};
  statement = arena.make(replaced);
  return true;
}

// Sets values variable by variable, as OpenSCAD does: that decides which are
// set before one fails.
bool set_values(const std::vector<Entry>& entries, ast::Program& program) {
  Arena& arena = *program.arena;
  std::vector<const ast::Statement*> statements(program.statements.begin(),
                                                program.statements.end());
  bool is_good = true;
  for (const std::size_t place :
       ast::assignments_that_count(program.statements)) {
    const ast::Statement*& statement = statements[place];
    for (const Entry& entry : entries) {
      if (std::get<ast::Assignment>(statement->node).name != entry.name) {
        continue;
      }
      is_good = is_good && set_value(statement, entry.text, arena);
    }
  }
  program.statements =
      arena.copy(std::span<const ast::Statement* const>(statements));
  return is_good;
}

}  // namespace

bool apply_parameter_set(const std::string& path, const std::string& set,
                         ast::Program& program, Diagnostics& diagnostics,
                         const FileAccess& access) {
  const auto entries = read_set(path, set, access, diagnostics);
  if (!entries) return false;
  if (set_values(*entries, program)) return true;
  diagnostics.error(
      {},
      "Cannot apply Parameter Set 'conversion of data to type \"b\" failed'");
  return false;
}

std::vector<std::string> parameter_set_names(const std::string& path,
                                             const FileAccess& access) {
  const auto refuse = [&](std::string_view why) {
    throw FileError(fmt::format("Cannot open '{}': {}", path, why));
  };
  access.require(path);
  const std::optional<std::string> text = access.read(path);
  if (!text) refuse("no such file");
  using Json = nlohmann::ordered_json;
  const Json json = Json::parse(*text, nullptr, false);
  const auto sets = json.is_object() ? json.find("parameterSets") : json.end();
  if (sets == json.end() || !sets->is_object()) {
    refuse("it has no sets of OpenSCAD's customizer");
  }
  std::vector<std::string> names;
  for (const auto& [name, values] : sets->items()) names.push_back(name);
  return names;
}

}  // namespace lamina
