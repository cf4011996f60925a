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

#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/similar.h"
#include "parser/customizer/parameter_set.h"
#include "serve/shop/detail/parameter.h"

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
  // throws  OrderError, which says why of the first values that are not offered
  ParameterSet check(std::string_view values) const;

 private:
  std::string unknown_name(const std::string& name, Guesses& guesses) const;

  std::vector<detail::Parameter> parameters_;
};

}  // namespace lamina::shop
