#include "serve/shop/problem.h"

#include <nlohmann/json.hpp>

#include "serve/run/messages.h"

namespace lamina::shop {
http::Response problem(unsigned status, const std::string& detail) {
  return problem(status, detail, nlohmann::ordered_json::array());
}

http::Response problem(unsigned status, const std::string& detail,
                       const nlohmann::ordered_json& messages) {
  nlohmann::ordered_json json = {{"type", "about:blank"},
                                 {"title", http::title_of(status)},
                                 {"status", status},
                                 {"detail", detail}};
  if (!messages.empty()) json["messages"] = messages;
  http::Response response{.status = status,
                          .type = "application/problem+json",
                          .body = serve::text_of(json) + "\n",
                          .file = {},
                          .headers = {}};
  if (status == 429 || status == 503) {
    response.headers.emplace_back("Retry-After", std::to_string(kRetrySeconds));
  }
  return response;
}

}  // namespace lamina::shop
