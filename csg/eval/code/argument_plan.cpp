#include "csg/eval/code/argument_plan.h"

#include <string>

namespace lamina::csg {

namespace {
// Comparing so many names costs less than a table.
constexpr std::size_t kFew = 12;
}  // namespace

ParameterIndex::ParameterIndex(std::span<const Parameter> parameters)
    : parameters_(parameters) {
  if (parameters.size() <= kFew) return;
  for (const Parameter& p : parameters) table_.try_emplace(p.name, &p);
}

const Parameter* ParameterIndex::find(std::string_view name) const {
  if (parameters_.size() > kFew) {
    const auto found = table_.find(name);
    return found == table_.end() ? nullptr : found->second;
  }
  for (const Parameter& p : parameters_) {
    if (p.name == name) return &p;
  }
  return nullptr;
}

std::vector<Parameter> make_parameters(
    std::span<const std::string_view> names) {
  std::vector<Parameter> parameters(names.size());
  for (std::uint32_t i = 0; i < names.size(); ++i) {
    parameters[i].name = names[i];
    parameters[i].target = {Target::Kind::kSlot, i, nullptr};
  }
  return parameters;
}

ArgumentPlan plan_arguments(std::span<const Parameter> parameters,
                            std::size_t positional,
                            std::span<const WrittenArgument> arguments,
                            DynamicNames& names, Surplus surplus) {
  ArgumentPlan plan;
  const bool warns = surplus == Surplus::kWarn;
  const ParameterIndex index(parameters);
  // OpenSCAD evaluates arguments in the order in which its hash table of names
  // gives them back; the same table gives the same order.
  std::unordered_map<std::string, std::uint32_t> resolved;
  std::size_t position = 0;
  bool has_too_many = false;
  for (std::uint32_t i = 0; i < arguments.size(); ++i) {
    const std::string_view name = arguments[i].name;
    if (!name.empty()) {
      const Parameter* known = index.find(name);
      if (warns && name[0] != '$' && (known == nullptr || known->is_extra)) {
        plan.warnings.push_back("variable " + std::string(name) +
                                " not specified as parameter");
      }
      if (resolved.contains(std::string(name))) {
        plan.warnings.push_back("argument " + std::string(name) +
                                " supplied more than once");
      }
      resolved[std::string(name)] = i;
    } else if (position < positional) {
      resolved[std::string(parameters[position++].name)] = i;
    } else if (warns && !has_too_many) {
      plan.warnings.emplace_back("Too many unnamed arguments supplied");
      has_too_many = true;
    }
  }
  for (const auto& [name, written] : resolved) {
    BoundArgument bound;
    bound.written = written;
    const Parameter* parameter = index.find(name);
    if (parameter != nullptr) {
      bound.target = parameter->target;
    } else if (is_dynamic_name(name)) {
      bound.target = {Target::Kind::kDynamic, names.number_of(name), nullptr};
    }
    plan.bound.push_back(bound);
  }
  for (std::uint32_t i = 0; i < parameters.size(); ++i) {
    if (!parameters[i].is_extra &&
        (!resolved.contains(std::string(parameters[i].name)) ||
         !parameters[i].has_silent_fallback)) {
      plan.defaults.push_back(i);
    }
  }
  return plan;
}

}  // namespace lamina::csg
