#pragma once
// How the arguments of a call meet parameters: by position and by name.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <unordered_map>

#include "csg/eval/code/code.h"
#include "csg/eval/code/dynamic_names.h"
#include "parser/language.h"

namespace lamina::csg {

// Parameters by name; of several with one name, the first.
class ParameterIndex {
 public:
  explicit ParameterIndex(std::span<const Parameter> parameters);

  // Null where there is none.
  const Parameter* find(std::string_view name) const;

 private:
  std::span<const Parameter> parameters_;
  std::unordered_map<std::string_view, const Parameter*> table_;
};

// Parameters without fallbacks, in the slots from 0 on.
std::vector<Parameter> make_parameters(std::span<const std::string_view> names);

// Whether arguments that meet no parameter are warned of.
enum class Surplus : std::uint8_t { kWarn, kSilent };

// positional  how many parameters arguments without a name reach; names reach
//             all
// language    2021: an argument without a name goes to the parameter at its
//             place, named or not, and the last one counts. 2026: to the next
//             parameter that has no value.
ArgumentPlan plan_arguments(std::span<const Parameter> parameters,
                            std::size_t positional,
                            std::span<const WrittenArgument> arguments,
                            DynamicNames& names, Language language,
                            Surplus surplus = Surplus::kWarn);

}  // namespace lamina::csg
