#pragma once
// The `$` variables, numbered as their names come up.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>

namespace lamina::csg {

// Numbers of the `$` variables that the evaluator itself knows.
enum WellKnown : std::uint32_t {
  kFn,
  kFa,
  kFs,
  kFe,
  kTime,
  kPreview,
  kViewTranslation,
  kViewRotation,
  kViewDistance,
  kViewField,
  kSupport,
  kVisible,
  kRigid,
};

// Whether `name` has dynamic scope.
bool is_dynamic_name(std::string_view name);

class DynamicNames {
 public:
  DynamicNames();

  // Gives a new name the next number.
  std::uint32_t number_of(std::string_view name);
  // No value where no code has named it.
  std::optional<std::uint32_t> find(std::string_view name) const;
  std::size_t size() const { return numbers_.size(); }

 private:
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace lamina::csg
