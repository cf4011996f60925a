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

#include "parser/customizer.h"
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

// A value, and what of it does not keep to the parameter's rule.
struct Fitted {
  const ast::Expr* value = nullptr;  // null: keeps its own
  bool keeps_rule = true;
};

// No more than so many bytes of a text, no character cut.
std::string_view cut(std::string_view text, std::size_t most_bytes) {
  std::size_t size = std::min(text.size(), most_bytes);
  const auto goes_on = [](char c) { return (c & 0xC0) == 0x80; };
  while (size > 0 && size < text.size() && goes_on(text[size])) --size;
  return text.substr(0, size);
}

Fitted fit_choice(std::string_view text, const ParameterRule& rule,
                  Arena& arena) {
  const ast::Expr* read = detail::read_customizer_value(text, arena);
  const auto number = read ? ast::number_of(*read) : std::nullopt;
  for (const ParameterRule::Choice& choice : rule.choices) {
    const auto* as_number = std::get_if<double>(&choice.value);
    if (as_number != nullptr && number == *as_number) return {read};
    const auto* as_text = std::get_if<std::string>(&choice.value);
    if (as_text != nullptr && text == *as_text) {
      return {arena.make(ast::Expr{ast::String{arena.copy(text)}, {}})};
    }
  }
  return {nullptr, false};
}

Fitted fit_numbers(std::string_view text, const std::vector<double>& own,
                   const ParameterRule& rule, Arena& arena) {
  const ast::Expr* read = detail::read_customizer_value(text, arena);
  auto numbers = read ? ast::numbers_of(*read) : std::nullopt;
  if (!numbers || numbers->size() != own.size()) return {nullptr, false};
  bool keeps_rule = true;
  for (double& number : *numbers) {
    const double within = rule.nearest(number);
    keeps_rule = keeps_rule && within == number;
    number = within;
  }
  const auto copy = arena.copy(std::span<const double>(*numbers));
  return {arena.make(ast::Expr{ast::Numbers{copy}, {}}), keeps_rule};
}

// The text as a value of a parameter that OpenSCAD 2026 shows.
Fitted fit(std::string_view text, const ast::Expr& own,
           const ParameterRule& rule, Arena& arena) {
  if (!rule.choices.empty()) return fit_choice(text, rule, arena);
  if (const auto numbers = ast::numbers_of(own)) {
    return fit_numbers(text, *numbers, rule, arena);
  }
  const ast::Expr* value = read_value(text, ast::type_of(own), arena);
  if (value == nullptr) return {nullptr, false};
  if (const auto number = ast::number_of(*value)) {
    const double within = rule.nearest(*number);
    return {arena.make(ast::Expr{ast::Number{within}, {}}), within == *number};
  }
  if (rule.most_bytes && text.size() > *rule.most_bytes) {
    return {
        read_value(cut(text, *rule.most_bytes), ast::ValueType::kString, arena),
        false};
  }
  return {value};
}

class SetApplier {
 public:
  SetApplier(const std::vector<Entry>& entries, ast::Program& program,
             Language language, Diagnostics& diagnostics)
      : entries_(entries),
        program_(program),
        arena_(*program.arena),
        customizer_(Customizer::read(program)),
        language_(language),
        diagnostics_(diagnostics) {}

  // Sets values variable by variable, as OpenSCAD does: that decides which are
  // set before one fails. False where a text is no value of a parameter that
  // wants true or false.
  bool apply() {
    std::vector<const ast::Statement*> statements(program_.statements.begin(),
                                                  program_.statements.end());
    bool is_good = true;
    for (const std::size_t place :
         ast::assignments_that_count(program_.statements)) {
      for (const Entry& entry : entries_) {
        const ast::Statement*& statement = statements[place];
        if (std::get<ast::Assignment>(statement->node).name == entry.name) {
          is_good = is_good && apply(entry, statement);
        }
      }
    }
    program_.statements =
        arena_.copy(std::span<const ast::Statement* const>(statements));
    return is_good;
  }

 private:
  bool apply(const Entry& entry, const ast::Statement*& statement) {
    const auto& own = *std::get<ast::Assignment>(statement->node).value;
    const auto rule = customizer_.rule_of(*statement);
    Fitted fitted;
    if (rule) fitted = fit(entry.text, own, *rule, arena_);
    const auto type = ast::type_of(own);
    if (language_ == Language::k2021 && type != ast::ValueType::kAny) {
      fitted.value = read_value(entry.text, type, arena_);
      if (!fitted.value && type == ast::ValueType::kBool) return false;
    }
    if (!fitted.keeps_rule) warn(entry, *statement, fitted.value != nullptr);
    if (fitted.value != nullptr) set(statement, *fitted.value);
    return true;
  }

  void warn(const Entry& entry, const ast::Statement& statement, bool is_set) {
    const std::string values = customizer_.comment_of(statement).values;
    std::string text =
        fmt::format("parameter {} = {} of the set ", entry.name, entry.text);
    text += values == "\"\"" ? std::string("is no value for it")
                             : fmt::format("does not keep to {}", values);
    if (!is_set) {
      text += "; it keeps its own value";
    } else if (language_ == Language::k2026) {
      text += "; it is moved there";
    }
    diagnostics_.own_warning(statement.range, std::move(text));
  }

  void set(const ast::Statement*& statement, const ast::Expr& value) {
    const auto& assignment = std::get<ast::Assignment>(statement->node);
    // A variable that was no parameter must not become one, so its value gets
    // no place: comments describe values that have one.
    const bool was_literal = ast::is_literal(*assignment.value);
    const SourceRange range =
        was_literal ? assignment.value->range : SourceRange();
    ast::Statement replaced = *statement;
    replaced.node = ast::Assignment{assignment.name,
                                    arena_.make(ast::Expr{value.node, range})};
    statement = arena_.make(replaced);
  }

  const std::vector<Entry>& entries_;
  ast::Program& program_;
  Arena& arena_;
  const Customizer customizer_;
  Language language_;
  Diagnostics& diagnostics_;
};

}  // namespace

bool apply_parameter_set(const std::string& path, const std::string& set,
                         ast::Program& program, Language language,
                         Diagnostics& diagnostics, const FileAccess& access) {
  const auto entries = read_set(path, set, access, diagnostics);
  if (!entries) return false;
  if (SetApplier(*entries, program, language, diagnostics).apply()) return true;
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
