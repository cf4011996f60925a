#pragma once
// The service's description of itself: OpenAPI 3.1, from the table of routes.

#include <string>
#include <vector>

namespace lamina::shop {

// JSON.
//
// formats  that layers can have: extensions
std::string openapi(const std::vector<std::string>& formats);

}  // namespace lamina::shop
