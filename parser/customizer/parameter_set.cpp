#include "parser/customizer/parameter_set.h"

#include <algorithm>
#include <map>
#include <optional>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/similar.h"
#include "base/text.h"
#include "parser/ast_printer.h"
#include "parser/customizer/customizer.h"
#include "parser/customizer/detail/customizer_value.h"
#include "parser/tree_facts.h"

namespace lamina {

// Fills ParameterSets while the file is read. It keeps the texts of numbers as
// they stand there, which a tree of values would not.
class ParameterSets::Reader : public nlohmann::json_sax<nlohmann::json> {
 public:
  explicit Reader(ParameterSets& sets) : sets_(sets) {}

  const std::string& complaint() const { return complaint_; }
  std::size_t error_position() const { return position_; }

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
    add("", false);
    if (is_among_sets()) sets_.sets_.back().is_object = true;
    path_.push_back({true, ""});
    return true;
  }
  bool end_object() override {
    path_.pop_back();
    return true;
  }
  bool key(string_t& name) override {
    path_.back().name = name;
    if (is_among_sets()) {
      sets_.sets_.push_back({name, sets_.values_.size(), false});
    }
    return true;
  }
  bool start_array(std::size_t /*size*/) override {
    add("", false);
    path_.push_back({false, ""});
    return true;
  }
  bool end_array() override { return end_object(); }

  bool parse_error(std::size_t position, const std::string& /*token*/,
                   const nlohmann::detail::exception& error) override {
    position_ = position;
    const std::string_view what = error.what();
    // "[json.exception.parse_error.101] parse error at line 2, column 1: …" or
    // "[json.exception.out_of_range.406] number overflow parsing '1e400'"
    const std::string_view mark = error.id == 406 ? "] " : ": ";
    complaint_ = what.substr(what.find(mark) + mark.size());
    return false;
  }

 private:
  struct Level {
    bool is_object = false;  // else an array
    std::string name;        // of the member that is being read
  };

  bool is_within_sets(std::size_t depth) const {
    return path_.size() == depth && path_[0].name == "parameterSets" &&
           std::all_of(path_.begin(), path_.end(),
                       [](const Level& level) { return level.is_object; });
  }
  bool is_among_sets() const { return is_within_sets(2); }
  bool is_in_set() const { return is_within_sets(3); }

  bool add(std::string_view text, bool is_single = true) {
    if (!is_in_set()) return true;
    const auto [name, is_new] = numbers_of_names_.try_emplace(
        path_.back().name, static_cast<std::uint32_t>(sets_.names_.size()));
    if (is_new) sets_.names_.push_back(name->first);
    sets_.texts_ += text;
    sets_.values_.push_back({name->second, is_single, sets_.texts_.size()});
    return true;
  }

  ParameterSets& sets_;
  std::map<std::string, std::uint32_t> numbers_of_names_;
  std::vector<Level> path_;  // what is around what is being read
  std::string complaint_;
  std::size_t position_ = 0;
};

ParameterSets ParameterSets::read(const std::string& path,
                                  const FileAccess& access) {
  const auto refuse = [&](const std::string& why) {
    throw FileError(
        fmt::format("Cannot open Parameter Set '{}': {}", path, why));
  };
  access.require(path);
  const std::optional<std::string> text = access.read(path);
  if (!text) refuse(path + ": cannot open file");
  ParameterSets sets(path);
  Reader reader(sets);
  if (!nlohmann::json::sax_parse(*text, &reader)) {
    const std::size_t position =
        std::min(reader.error_position(), text->size());
    const auto end =
        text->begin() + static_cast<std::string::difference_type>(position);
    refuse(fmt::format("{}({}): {}", path,
                       std::count(text->begin(), end, '\n') + 1,
                       reader.complaint()));
  }
  return sets;
}

ParameterSet ParameterSets::values_of(std::size_t index) const {
  const Set& set = sets_[index];
  if (!set.is_object) refuse(set.name);
  const std::size_t end =
      index + 1 < sets_.size() ? sets_[index + 1].begin : values_.size();
  ParameterSet values;
  for (std::size_t i = set.begin; i < end; ++i) {
    const std::size_t begin = i == 0 ? 0 : values_[i - 1].text_end;
    values.push_back({names_[values_[i].name],
                      texts_.substr(begin, values_[i].text_end - begin),
                      values_[i].is_single});
  }
  return values;
}

ParameterSet ParameterSets::values_of(std::string_view name) const {
  const auto set = std::find_if(sets_.begin(), sets_.end(),
                                [&](const Set& s) { return s.name == name; });
  if (set == sets_.end()) refuse(name);
  return values_of(static_cast<std::size_t>(set - sets_.begin()));
}

void ParameterSets::refuse(std::string_view name) const {
  throw FileError(fmt::format(
      "Cannot apply Parameter Set '{}': '{}' has no such set", name, path_));
}

namespace {

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
  SetApplier(const ParameterSet& set, ast::Program& program, Language language,
             Diagnostics& diagnostics, Misfit misfit)
      : set_(set),
        program_(program),
        arena_(*program.arena),
        customizer_(Customizer::read(program)),
        language_(language),
        diagnostics_(diagnostics),
        is_strict_(misfit == Misfit::kError) {}

  // Sets values variable by variable, as OpenSCAD does: that decides which are
  // set before one fails. False where a text is not a value of a parameter that
  // wants true or false, or where misfits are errors.
  bool apply() {
    std::vector<const ast::Statement*> statements(program_.statements.begin(),
                                                  program_.statements.end());
    Entries entries;
    for (const ParameterValue& entry : set_) {
      entries[entry.name].push_back(&entry);
    }
    std::vector<std::string_view> names;
    bool is_good = true;
    for (const std::size_t place :
         ast::assignments_that_count(program_.statements)) {
      const ast::Statement*& statement = statements[place];
      names.push_back(std::get<ast::Assignment>(statement->node).name);
      const auto own = entries.extract(names.back());
      if (own.empty()) continue;
      for (const ParameterValue* entry : own.mapped()) {
        is_good = is_good && apply(*entry, statement);
      }
    }
    program_.statements =
        arena_.copy(std::span<const ast::Statement* const>(statements));
    warn_of_unknown(entries, names);
    return is_good && !(is_strict_ && has_misfits_);
  }

 private:
  // By name; those of one name in the order of the set.
  using Entries =
      std::map<std::string_view, std::vector<const ParameterValue*>>;

  bool apply(const ParameterValue& entry, const ast::Statement*& statement) {
    const auto& own = *std::get<ast::Assignment>(statement->node).value;
    const auto rule = customizer_.rule_of(*statement);
    Fitted fitted;
    if (rule) fitted = fit(entry.text, own, *rule, arena_);
    const auto type = ast::type_of(own);
    if (language_ == Language::k2021 && type != ast::ValueType::kAny) {
      fitted.value = read_value(entry.text, type, arena_);
      if (!fitted.value && type == ast::ValueType::kBool && !is_strict_) {
        return false;
      }
    }
    const bool is_lost =
        fitted.value == nullptr && (rule || !is_own(entry, own));
    if (is_lost || !fitted.keeps_rule || !entry.is_single) {
      warn(entry, *statement, rule.has_value(), fitted);
    }
    if (fitted.value != nullptr) set(statement, *fitted.value);
    return true;
  }

  // Whether the text says the value that the variable has anyway.
  bool is_own(const ParameterValue& entry, const ast::Expr& own) const {
    const ast::Expr* said = read_value(entry.text, ast::type_of(own), arena_);
    if (said == nullptr) return false;
    std::string said_text;
    std::string own_text;
    ast::append_expression(*said, said_text);
    ast::append_expression(own, own_text);
    return said_text == own_text;
  }

  void warn(const ParameterValue& entry, const ast::Statement& statement,
            bool has_rule, const Fitted& fitted) {
    has_misfits_ = true;
    const std::string fault = fault_of(entry, statement, has_rule, fitted);
    if (is_strict_) {
      diagnostics_.error(statement.range, fmt::format("{} = {} {}", entry.name,
                                                      entry.text, fault));
      return;
    }
    std::string text = fmt::format("parameter {} = {} of the set {}",
                                   entry.name, entry.text, fault);
    if (fitted.value == nullptr) {
      text += "; it keeps its own value";
    } else if (!entry.is_single) {
      text += "; it is taken for an empty text";
    } else if (language_ == Language::k2026) {
      text += "; it is moved there";
    }
    diagnostics_.own_warning(statement.range, std::move(text));
  }

  std::string fault_of(const ParameterValue& entry,
                       const ast::Statement& statement, bool has_rule,
                       const Fitted& fitted) const {
    const auto& own = *std::get<ast::Assignment>(statement.node).value;
    if (!entry.is_single) return "is a list or an object";
    if (!has_rule && language_ == Language::k2026) {
      return "is for no parameter of the customizer";
    }
    if (ast::type_of(own) == ast::ValueType::kAny) {
      return "can't replace what is computed";
    }
    const std::string values = customizer_.comment_of(statement).values;
    return fitted.keeps_rule || values == "\"\""
               ? "is no value for it"
               : fmt::format("does not keep to {}", values);
  }

  // names  of all variables of the design
  void warn_of_unknown(const Entries& unknown,
                       std::span<const std::string_view> names) {
    Guesses guesses;
    for (const auto& [name, entries] : unknown) {
      has_misfits_ = true;
      Diagnostic misfit{
          is_strict_ ? Severity::kError : Severity::kWarning,
          {},
          fmt::format("the set has '{}', the design has no such variable",
                      short_name(name))};
      misfit.hints = hint_of(guesses.did_you_mean(name, names));
      misfit.audience = Audience::kTerminal;
      diagnostics_.report(std::move(misfit));
    }
  }

  void set(const ast::Statement*& statement, const ast::Expr& value) {
    const auto& assignment = std::get<ast::Assignment>(statement->node);
    // A variable that was not a parameter must not become one, so its value
    // gets no place: comments describe values that have one.
    const bool was_literal = ast::is_literal(*assignment.value);
    const SourceRange range =
        was_literal ? assignment.value->range : SourceRange();
    ast::Statement replaced = *statement;
    replaced.node = ast::Assignment{assignment.name,
                                    arena_.make(ast::Expr{value.node, range})};
    statement = arena_.make(replaced);
  }

  const ParameterSet& set_;
  ast::Program& program_;
  Arena& arena_;
  const Customizer customizer_;
  Language language_;
  Diagnostics& diagnostics_;
  const bool is_strict_;
  bool has_misfits_ = false;
};

}  // namespace

bool apply_parameter_set(const ParameterSet& set, ast::Program& program,
                         Language language, Diagnostics& diagnostics,
                         Misfit misfit) {
  if (SetApplier(set, program, language, diagnostics, misfit).apply()) {
    return true;
  }
  if (misfit == Misfit::kError) return false;
  diagnostics.error(
      {},
      "Cannot apply Parameter Set 'conversion of data to type \"b\" failed'");
  return false;
}

}  // namespace lamina
