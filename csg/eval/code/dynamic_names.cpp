#include "csg/eval/code/dynamic_names.h"

namespace lamina::csg {

bool is_dynamic_name(std::string_view name) {
  return !name.empty() && name[0] == '$' && name != "$children";
}

DynamicNames::DynamicNames() {
  for (const char* name :
       {"$fn", "$fa", "$fs", "$fe", "$t", "$preview", "$vpt", "$vpr", "$vpd",
        "$vpf", "$support", "$visible", "$rigid"}) {
    number_of(name);
  }
}

std::uint32_t DynamicNames::number_of(std::string_view name) {
  return numbers_
      .try_emplace(std::string(name),
                   static_cast<std::uint32_t>(numbers_.size()))
      .first->second;
}

std::optional<std::uint32_t> DynamicNames::find(std::string_view name) const {
  const auto found = numbers_.find(std::string(name));
  if (found == numbers_.end()) return std::nullopt;
  return found->second;
}

}  // namespace lamina::csg
