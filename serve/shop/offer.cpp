#include "serve/shop/offer.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "serve/shop/order.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;
using detail::Parameter;

constexpr std::size_t kMostFaults = 8;  // of a message

}  // namespace

Offer::Offer(const Json& parameters)
    : parameters_(parameters.begin(), parameters.end()) {}

Json Offer::schema(const std::string& title) const {
  Json properties = Json::object();
  for (const Parameter& parameter : parameters_) {
    properties[parameter.name()] = parameter.schema();
  }
  return {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
          {"title", title},
          {"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false}};
}

std::string Offer::unknown_name(const std::string& name,
                                Guesses& guesses) const {
  std::vector<std::string_view> names;
  for (const Parameter& parameter : parameters_) {
    names.push_back(parameter.name());
  }
  const std::string guess = guesses.did_you_mean(name, names);
  return fmt::format("values/{} is not a parameter of this design{}{}",
                     short_name(name), guess.empty() ? "" : ": ", guess);
}

ParameterSet Offer::check(std::string_view values) const {
  ParameterSet set;
  std::vector<std::string> faults;
  Guesses guesses;
  const Json json = Json::parse(values);
  for (const auto& [name, member] : json.items()) {
    if (faults.size() == kMostFaults) break;
    const auto parameter =
        std::ranges::find(parameters_, name, &Parameter::name);
    if (parameter == parameters_.end()) {
      faults.push_back(unknown_name(name, guesses));
      continue;
    }
    const auto value = detail::value_of(member);
    const std::string fault = parameter->fault_of(value);
    if (!fault.empty()) {
      faults.push_back(fmt::format("values/{}{}", name, fault));
    } else if (*value != parameter->own()) {
      set.push_back({name, detail::set_text_of(*value)});
    }
  }
  if (faults.empty()) return set;
  throw OrderError(fmt::format("{}", fmt::join(faults, "; ")));
}

}  // namespace lamina::shop
