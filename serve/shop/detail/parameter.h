#pragma once
// A parameter of a customizer: what JSON Schema says of it, and whether a value
// is offered.

#include <cstddef>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace lamina::shop::detail {

using Value = std::variant<bool, double, std::string, std::vector<double>>;

// No value for what a parameter cannot have.
std::optional<Value> value_of(const nlohmann::ordered_json& json);
nlohmann::ordered_json json_of(const Value& value);

// As a parameter set has it: numbers are the shortest texts that read back as
// the same doubles.
std::string set_text_of(const Value& value);

class Parameter {
 public:
  // json  an element of serve::parameters_of()
  explicit Parameter(const nlohmann::ordered_json& json);

  const std::string& name() const { return name_; }
  const Value& own() const { return own_; }  // the design's

  nlohmann::ordered_json schema() const;

  // What is wrong with a value, to be read behind the parameter's name: " must
  // be a number", "/1 must be at most 2". Empty where it is offered.
  std::string fault_of(const std::optional<Value>& value) const;

 private:
  struct Option {
    Value value;
    std::string title;
  };
  struct Range {
    double least = 0;
    double greatest = 0;
  };

  void read_range(const nlohmann::ordered_json& json);
  void add_option(Value value, std::string title);
  bool is_chosen(const Value& value) const;
  bool counts_steps() const;
  bool has_exact_steps() const;
  bool is_on_step(double number) const;
  nlohmann::ordered_json type_schema() const;
  void add_range(nlohmann::ordered_json& json) const;
  std::string fault_of_choice(const std::optional<Value>& value) const;
  std::string fault_of_type(const std::optional<Value>& value) const;
  std::string fault_of_number(double number) const;
  std::string fault_of_numbers(const std::vector<double>& numbers) const;

  std::string name_;
  std::string caption_;
  std::string group_;
  Value own_;
  std::vector<Option> options_;  // empty: all values
  std::optional<Range> range_;   // of a number, and of each in a vector
  std::optional<double> step_;   // of a range, or of a spin box
  std::optional<std::size_t> most_bytes_;  // of a text
};

}  // namespace lamina::shop::detail
