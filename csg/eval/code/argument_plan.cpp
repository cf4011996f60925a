#include "csg/eval/code/argument_plan.h"

#include <algorithm>
#include <array>
#include <string>
#include <unordered_set>
#include <utility>

#include <fmt/ranges.h>

#include "base/similar.h"

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

namespace {

class Planner {
 public:
  Planner(std::span<const Parameter> parameters, std::size_t positional,
          std::span<const WrittenArgument> arguments, DynamicNames& names,
          Surplus surplus)
      : parameters_(parameters),
        index_(parameters),
        positional_(positional),
        arguments_(arguments),
        names_(names),
        warns_(surplus == Surplus::kWarn) {}

  // 2021.01 evaluates arguments in the order in which its hash table of names
  // gives them back; the same table gives the same order. It evaluates the
  // fallbacks of all parameters, before.
  ArgumentPlan plan_2021() {
    std::unordered_map<std::string, std::uint32_t> resolved;
    std::size_t position = 0;
    for (std::uint32_t i = 0; i < arguments_.size(); ++i) {
      const std::string_view name = arguments_[i].name;
      if (!name.empty()) {
        warn_of_unknown(name);
        if (resolved.contains(std::string(name))) {
          warn("argument {} supplied more than once", name);
        }
        resolved[std::string(name)] = i;
      } else if (position < positional_) {
        resolved[std::string(parameters_[position++].name)] = i;
      } else {
        warn_of_surplus();
      }
    }
    for (const auto& [name, written] : resolved) bind(name, written);
    add_defaults([&](const Parameter& parameter) {
      return !resolved.contains(std::string(parameter.name)) ||
             !parameter.has_silent_fallback;
    });
    return std::move(plan_);
  }

  // In the order of the text; then the fallbacks of parameters without a value.
  ArgumentPlan plan_2026() {
    plan_.evaluates_fallbacks_last = true;
    std::unordered_set<std::string_view> named;
    std::unordered_set<std::string_view> given;
    std::size_t position = 0;
    for (std::uint32_t i = 0; i < arguments_.size(); ++i) {
      std::string_view name = arguments_[i].name;
      if (!name.empty()) {
        if (named.contains(name)) {
          warn("argument \"{}\" supplied more than once", name);
        } else if (given.contains(name)) {
          warn("argument \"{}\" overrides positional argument", name);
        } else {
          warn_of_unknown(name);
        }
        named.insert(name);
      }
      while (name.empty() && position < positional_) {
        const std::string_view next = parameters_[position++].name;
        if (!named.contains(next)) name = next;
      }
      if (name.empty()) warn_of_surplus();
      given.insert(name);
      bind(name, i);
    }
    add_defaults([&](const Parameter& parameter) {
      return !given.contains(parameter.name);
    });
    return std::move(plan_);
  }

 private:
  template <typename... Parts>
  void warn(fmt::format_string<Parts...> words, Parts&&... parts) {
    plan_.warnings.push_back(
        {fmt::format(words, std::forward<Parts>(parts)...), ""});
  }
  std::vector<std::string_view> parameter_names() const {
    std::vector<std::string_view> names;
    for (const Parameter& parameter : parameters_) {
      if (!parameter.is_extra) names.push_back(parameter.name);
    }
    return names;
  }
  std::string list_of_parameters() const {
    constexpr std::size_t kMost = 10;
    const std::vector<std::string_view> names = parameter_names();
    if (names.empty() || names.size() > kMost) return "";
    return fmt::format("the parameters are {}", fmt::join(names, ", "));
  }
  void warn_of_unknown(std::string_view name) {
    const Parameter* known = index_.find(name);
    if (!warns_ || name[0] == '$') return;
    if (known != nullptr && !known->is_extra) return;
    const Language language =
        plan_.evaluates_fallbacks_last ? Language::k2026 : Language::k2021;
    if (known != nullptr && language == Language::k2021) {
      plan_.has_newer_argument = true;
    }
    warn("variable {} not specified as parameter",
         quoted_name(name, language, ""));
    std::string& hint = plan_.warnings.back().hint;
    hint = did_you_mean(name, parameter_names());
    if (hint.empty()) hint = list_of_parameters();
  }
  // cube(1, 2, 3) and rotate(45, 0, 0) are other languages.
  bool takes_list() const {
    constexpr std::array<std::string_view, 4> kLists = {"size", "v", "a",
                                                        "newsize"};
    return positional_ > 0 &&
           std::ranges::find(kLists, parameters_[0].name) != kLists.end();
  }
  void warn_of_surplus() {
    if (warns_ && !has_too_many_) {
      warn("Too many unnamed arguments supplied");
      plan_.warnings.back().hint = list_of_parameters();
      if (takes_list()) {
        plan_.warnings.back().hint += "; several numbers for one stand in [ ]";
      }
    }
    has_too_many_ = true;
  }

  void bind(std::string_view name, std::uint32_t written) {
    BoundArgument bound;
    bound.written = written;
    const Parameter* parameter = index_.find(name);
    if (parameter != nullptr) {
      bound.target = parameter->target;
    } else if (is_dynamic_name(name)) {
      bound.target = {Target::Kind::kDynamic, names_.number_of(name), nullptr};
    }
    plan_.bound.push_back(bound);
  }
  template <typename IsNeeded>
  void add_defaults(const IsNeeded& is_needed) {
    for (std::uint32_t i = 0; i < parameters_.size(); ++i) {
      if (!parameters_[i].is_extra && is_needed(parameters_[i])) {
        plan_.defaults.push_back(i);
      }
    }
  }

  std::span<const Parameter> parameters_;
  ParameterIndex index_;
  std::size_t positional_;
  std::span<const WrittenArgument> arguments_;
  DynamicNames& names_;
  bool warns_;
  bool has_too_many_ = false;
  ArgumentPlan plan_;
};

}  // namespace

ArgumentPlan plan_arguments(std::span<const Parameter> parameters,
                            std::size_t positional,
                            std::span<const WrittenArgument> arguments,
                            DynamicNames& names, Language language,
                            Surplus surplus) {
  Planner planner(parameters, positional, arguments, names, surplus);
  return language == Language::k2021 ? planner.plan_2021()
                                     : planner.plan_2026();
}

}  // namespace lamina::csg
