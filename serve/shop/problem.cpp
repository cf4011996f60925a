#include "serve/shop/problem.h"

#include <nlohmann/json.hpp>

#include "serve/run/messages.h"

namespace lamina::shop {
namespace {

// Reason phrases of RFC 9110 and RFC 6585.
std::string title_of(unsigned status) {
  switch (status) {
    case 400:
      return "Bad Request";
    case 403:
      return "Forbidden";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 408:
      return "Request Timeout";
    case 413:
      return "Content Too Large";
    case 414:
      return "URI Too Long";
    case 415:
      return "Unsupported Media Type";
    case 417:
      return "Expectation Failed";
    case 422:
      return "Unprocessable Content";
    case 429:
      return "Too Many Requests";
    case 431:
      return "Request Header Fields Too Large";
    case 501:
      return "Not Implemented";
    case 503:
      return "Service Unavailable";
    default:
      return "Internal Server Error";
  }
}

}  // namespace

http::Response problem(unsigned status, const std::string& detail) {
  return problem(status, detail, nlohmann::ordered_json::array());
}

http::Response problem(unsigned status, const std::string& detail,
                       const nlohmann::ordered_json& messages) {
  nlohmann::ordered_json json = {{"type", "about:blank"},
                                 {"title", title_of(status)},
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
