#pragma once
// What a design's customizer offers: as a JSON Schema for other programs, and
// as a check of the values of an order.
//
// Schema and check agree, but for what JSON Schema cannot say. Such rules stand
// in the schema under names of their own, and the check keeps them, too:
//
//   x-step      Numbers with a minimum go in steps from there, to within a
//               millionth of a step: 0.35 is not a multiple of 0.05 as doubles
//               are. Where steps are exact in binary, "multipleOf" says so,
//               too. Numbers without a minimum and vectors have spin boxes: a
//               step is that of their arrows alone, and is not checked.
//   x-maxBytes  The customizer counts bytes of UTF-8, "maxLength" characters.
//   x-group     The group in the customizer. It has no meaning for values.
//
// The design's own value is always accepted.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/similar.h"
#include "parser/customizer/parameter_set.h"

namespace lamina::shop {

class Offer {
 public:
  // parameters  of serve::parameters_of()
  explicit Offer(const nlohmann::ordered_json& parameters);

  // A JSON Schema 2020-12 of the values.
  nlohmann::ordered_json schema(const std::string& title) const;

  // The values as a parameter set, with which the design gets exactly the
  // doubles that came. The design's own values are left out.
  //
  // values  of an Order
  // throws  OrderError, which says of each value that is not offered why
  ParameterSet check(std::string_view values) const;

  // All parameters with the values that count, in the design's order.
  //
  // values  of an Order, which have been checked
  nlohmann::ordered_json values_with_defaults(std::string_view values) const;

  // A value of a parameter.
  using Value = std::variant<bool, double, std::string, std::vector<double>>;

 private:
  struct Option {
    Value value;
    std::string title;
  };
  struct Range {
    double least = 0;
    double greatest = 0;
  };
  struct Parameter {
    std::string name;
    std::string caption;
    std::string group;
    Value own;
    std::vector<Option> options;  // empty: all values
    std::optional<Range> range;   // of a number, and of each in a vector
    std::optional<double> step;   // of a range, or of a spin box
    std::optional<std::size_t> most_bytes;  // of a text

    nlohmann::ordered_json schema() const;
    nlohmann::ordered_json type_schema() const;
    void add_range(nlohmann::ordered_json& json) const;
    // What is wrong with a value; empty where it is offered.
    std::string fault_of(const std::optional<Value>& value) const;
    std::string fault_of_type(const std::optional<Value>& value) const;
    std::string fault_of_number(double number) const;
    bool is_chosen(const Value& value) const;
    void add_option(Value value, std::string title);
    bool counts_steps() const;
    bool has_exact_steps() const;
    bool is_on_step(double number) const;
  };

  static Parameter read_parameter(const nlohmann::ordered_json& json);
  static Range range_with(Range range, const Value& own);
  // Whether the range has steps, and few enough to tell them apart.
  static bool can_count(const Range& range, std::optional<double> step);
  std::string unknown_name(const std::string& name, Guesses& guesses) const;

  std::vector<Parameter> parameters_;
};

}  // namespace lamina::shop
