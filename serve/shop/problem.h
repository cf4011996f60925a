#pragma once
// Problems: what a client of the service gets in the place of an answer, as RFC
// 9457 has it.

#include <string>

#include <nlohmann/json_fwd.hpp>

#include "serve/http/server.h"

namespace lamina::shop {

// After so many seconds a client may ask again that got 429 or 503: most orders
// take less.
inline constexpr int kRetrySeconds = 5;

// An answer of type application/problem+json, with Retry-After where it is 429
// or 503.
//
// status    400 or above
// detail    one sentence for the client's reader; bytes that are not UTF-8 are
//           replaced
// messages  of serve::messages_json(); an empty list is left out
http::Response problem(unsigned status, const std::string& detail);
http::Response problem(unsigned status, const std::string& detail,
                       const nlohmann::ordered_json& messages);

}  // namespace lamina::shop
