#pragma once
// What a request must be to reach the handler, and what each answer says.
//
// Boost.Beast has parsed the head by then, so names are tokens and values have
// no control characters. It lets through what proxies once did: folded lines, a
// Content-Length twice. What two programs can read in two ways smuggles a
// request past one of them, so all of that is refused here.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "serve/http/server.h"

namespace lamina::http {

struct Refusal {
  unsigned status;
  const char* reason;
};

// The head of a request as it came.
struct Head {
  std::string_view bytes;  // all, with the empty line at the end
  std::string_view method;
  std::string_view target;
  unsigned version = 11;  // HTTP/1.1
  std::vector<std::pair<std::string_view, std::string_view>> fields;
};

class Rules {
 public:
  // own  where the server listens
  Rules(const Limits& limits, const Policy& policy, const Address& own);

  // Judges a head that is not whole yet by its length.
  std::optional<Refusal> judge_length(std::string_view bytes) const;
  std::optional<Refusal> judge_line(std::string_view bytes) const;
  // Judges a head that is.
  std::optional<Refusal> judge(const Head& head) const;

 private:
  std::optional<Refusal> judge_syntax(const Head& head) const;
  std::optional<Refusal> judge_body(const Head& head) const;
  std::optional<Refusal> judge_host(const Head& head) const;
  std::optional<Refusal> judge_site(const Head& head) const;
  bool is_own(std::string_view host) const;

  Limits limits_;
  Policy policy_;
  std::vector<std::string> hosts_;  // "127.0.0.1:8080"; any if there are none
};

// The request, without its body, of a head that the rules let through.
//
// host  the IP address at the other end; empty for a Unix socket
Request request_of(const Head& head, const std::string& host);

// An answer of the server's own.
Response refusal_response(const Refusal& refusal, const Policy& policy);

// Whether all that it puts into headers can stand there.
bool is_sendable(const Response& response);

// The headers that each answer has.
const std::vector<std::pair<std::string_view, std::string_view>>&
headers_of_all();

}  // namespace lamina::http
