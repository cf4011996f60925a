#pragma once
// Texts that become part of the program (serve/shop/description).

#include <string_view>

namespace lamina::shop {

// JSON: schemas of what the service takes and gives, by their names.
extern const std::string_view kDescribedSchemas;

}  // namespace lamina::shop
