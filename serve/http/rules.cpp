#include "serve/http/detail/rules.h"

#include <algorithm>
#include <cctype>

namespace lamina::http {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool is_equal(std::string_view name, std::string_view other) {
  return std::equal(name.begin(), name.end(), other.begin(), other.end(),
                    [](char a, char b) { return lower(a) == lower(b); });
}

std::vector<std::string_view> values_of(const Head& head,
                                        std::string_view name) {
  std::vector<std::string_view> values;
  for (const auto& [known, value] : head.fields) {
    if (is_equal(known, name)) values.push_back(value);
  }
  return values;
}

bool has(const Head& head, std::string_view name) {
  return !values_of(head, name).empty();
}

bool is_visible(char c) { return c > ' ' && c < '\x7f'; }

std::string_view trim(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t") + 1 - begin);
}

// The parts of a text between the marks.
std::vector<std::string_view> split(std::string_view text, char mark) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(mark);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

void add_cookies(std::string_view value, Request& request) {
  for (const std::string_view part : split(value, ';')) {
    const std::size_t mark = part.find('=');
    if (mark == std::string_view::npos) continue;
    request.cookies.emplace_back(trim(part.substr(0, mark)),
                                 trim(part.substr(mark + 1)));
  }
}

std::string joined(const std::vector<std::string_view>& values) {
  std::string all;
  for (const std::string_view value : values) {
    if (!all.empty()) all += ", ";
    all += value;
  }
  return all;
}

// The IP address of the client.
//
// host  the one at the other end
std::string peer_of(const Head& head, const std::string& host) {
  constexpr std::size_t kMost = 64;
  const auto lists = values_of(head, "X-Forwarded-For");
  if (lists.empty() || !(host.empty() || is_loopback(host))) return host;
  // A web server appends the address that it has seen itself.
  const std::string_view last = trim(split(lists.back(), ',').back());
  return last.empty() ? host : std::string(last.substr(0, kMost));
}

// Without its port: "[::1]" of "[::1]:8280".
std::string_view name_of(std::string_view host) {
  const std::size_t bracket = host.find(']');
  return host.substr(
      0, host.find(':', bracket == std::string_view::npos ? 0 : bracket));
}

// The Hosts of requests to this machine itself.
std::vector<std::string> local_hosts(const Policy& policy, const Address& own) {
  std::vector<std::string> names = {"127.0.0.1", "localhost"};
  if (policy.peers == Peers::kPrograms) {
    names.insert(names.end(), {"[::1]", own.host});
  }
  std::vector<std::string> hosts;
  for (const std::string& name : names) {
    hosts.push_back(name + ":" + std::to_string(own.port));
    // Clients leave the usual port out.
    if (own.port == 80) hosts.push_back(name);
  }
  return hosts;
}

}  // namespace

Rules::Rules(const Limits& limits, const Policy& policy, const Address& own)
    : limits_(limits), policy_(policy) {
  const bool is_for_browsers = policy.peers == Peers::kBrowsers;
  if (!is_for_browsers && !policy.hosts.empty()) {
    hosts_ = policy.hosts;
  } else if (is_for_browsers || is_loopback(own.host)) {
    hosts_ = local_hosts(policy, own);
  }
}

std::optional<Refusal> Rules::judge_line(std::string_view bytes) const {
  if (std::min(bytes.find('\n'), bytes.size()) > limits_.line_bytes) {
    return Refusal{414, "The request line is too long"};
  }
  return std::nullopt;
}

std::optional<Refusal> Rules::judge_length(std::string_view bytes) const {
  if (bytes.size() < limits_.header_bytes) return std::nullopt;
  return Refusal{431, "The headers are too long"};
}

std::optional<Refusal> Rules::judge(const Head& head) const {
  if (const auto refusal = judge_syntax(head)) return refusal;
  if (const auto refusal = judge_body(head)) return refusal;
  if (const auto refusal = judge_host(head)) return refusal;
  if (policy_.peers == Peers::kPrograms) return std::nullopt;
  return judge_site(head);
}

std::optional<Refusal> Rules::judge_syntax(const Head& head) const {
  const bool is_known =
      head.version == 11 ||
      (head.version == 10 && policy_.peers == Peers::kPrograms);
  if (!is_known) return Refusal{400, "Only HTTP/1.1 is spoken here"};
  for (const std::string_view fold : {"\n ", "\n\t"}) {
    if (head.bytes.find(fold) != std::string_view::npos) {
      return Refusal{400, "A header is folded"};
    }
  }
  if (head.fields.size() > limits_.headers) {
    return Refusal{431, "There are too many headers"};
  }
  if (head.method != "GET" && head.method != "HEAD" && head.method != "POST") {
    return Refusal{405, "Only GET, HEAD and POST are known here"};
  }
  if (!head.target.starts_with('/') ||
      !std::all_of(head.target.begin(), head.target.end(), is_visible) ||
      head.target.find('#') != std::string_view::npos) {
    return Refusal{400, "The target is not a path"};
  }
  return std::nullopt;
}

std::optional<Refusal> Rules::judge_body(const Head& head) const {
  const auto lengths = values_of(head, "Content-Length");
  if (has(head, "Transfer-Encoding")) {
    if (!lengths.empty()) return Refusal{400, "The body has two lengths"};
    return Refusal{501, "Transfer-Encoding is not known here"};
  }
  if (lengths.size() > 1) return Refusal{400, "The body has two lengths"};
  if (!lengths.empty()) {
    const std::string_view length = lengths.front();
    if (length.empty() ||
        length.find_first_not_of("0123456789") != std::string_view::npos) {
      return Refusal{400, "Content-Length is not a number"};
    }
    const bool is_zero =
        length.find_first_not_of('0') == std::string_view::npos;
    if (head.method != "POST" && !is_zero) {
      return Refusal{400, "Only POST may have a body"};
    }
  }
  if (has(head, "Expect")) return Refusal{417, "Expect is not known here"};
  return std::nullopt;
}

std::optional<Refusal> Rules::judge_host(const Head& head) const {
  const auto hosts = values_of(head, "Host");
  // HTTP/1.0 does not know it.
  if (hosts.empty() && head.version == 10 && policy_.hosts.empty()) {
    return std::nullopt;
  }
  if (hosts.size() != 1) return Refusal{400, "There must be one Host"};
  if (!is_own(hosts.front())) {
    return Refusal{403, "The Host is not this server's"};
  }
  return std::nullopt;
}

// Whether a page of this server, or the user, has sent it.
std::optional<Refusal> Rules::judge_site(const Head& head) const {
  const auto origins = values_of(head, "Origin");
  for (const std::string_view origin : origins) {
    constexpr std::string_view kScheme = "http://";
    if (!origin.starts_with(kScheme) ||
        !is_own(origin.substr(kScheme.size()))) {
      return Refusal{403, "The Origin is not this server's"};
    }
  }
  for (const std::string_view site : values_of(head, "Sec-Fetch-Site")) {
    if (site != "same-origin" && site != "none") {
      return Refusal{403, "Another site has sent this"};
    }
  }
  if (head.method == "POST" && origins.empty()) {
    return Refusal{403, "A POST must have an Origin"};
  }
  return std::nullopt;
}

bool Rules::is_own(std::string_view host) const {
  if (policy_.peers == Peers::kBrowsers) {
    return std::find(hosts_.begin(), hosts_.end(), host) != hosts_.end();
  }
  if (hosts_.empty()) return true;
  return std::any_of(hosts_.begin(), hosts_.end(), [&](const std::string& own) {
    return is_equal(own, host) || is_equal(own, name_of(host));
  });
}

Request request_of(const Head& head, const std::string& host) {
  Request request;
  request.if_none_match = joined(values_of(head, "If-None-Match"));
  request.peer = peer_of(head, host);
  request.method = head.method == "HEAD" ? "GET" : head.method;
  const std::size_t mark = head.target.find('?');
  request.path = head.target.substr(0, mark);
  if (mark != std::string_view::npos) {
    request.query = head.target.substr(mark + 1);
  }
  for (const std::string_view type : values_of(head, "Content-Type")) {
    request.content_type = trim(type.substr(0, type.find(';')));
  }
  std::transform(request.content_type.begin(), request.content_type.end(),
                 request.content_type.begin(), lower);
  for (const std::string_view value : values_of(head, "Cookie")) {
    add_cookies(value, request);
  }
  return request;
}

Response refusal_response(const Refusal& refusal, const Policy& policy) {
  Response response;
  response.status = refusal.status;
  if (policy.has_problems) {
    // Neither text has anything to escape.
    response.type = "application/problem+json";
    response.body = R"({"type":"about:blank","title":")" +
                    std::string(title_of(refusal.status)) + R"(","status":)" +
                    std::to_string(refusal.status) + R"(,"detail":")" +
                    refusal.reason + R"("})";
  } else {
    response.body = std::string(refusal.reason) + "\n";
  }
  if (refusal.status == 405) {
    response.headers.emplace_back("Allow", "GET, HEAD, POST");
  }
  return response;
}

bool is_sendable(const Response& response) {
  const auto is_value = [](std::string_view text) {
    return std::none_of(text.begin(), text.end(), [](char c) {
      const auto code = static_cast<unsigned char>(c);
      return (code < ' ' && c != '\t') || code == 0x7f;
    });
  };
  const auto is_name = [](std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
      return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
    });
  };
  return response.status >= 200 && response.status <= 599 &&
         is_value(response.type) &&
         std::all_of(response.headers.begin(), response.headers.end(),
                     [&](const auto& header) {
                       return is_name(header.first) && is_value(header.second);
                     });
}

const std::vector<std::pair<std::string_view, std::string_view>>&
headers_of_all() {
  static const std::vector<std::pair<std::string_view, std::string_view>>
      headers = {
          {"Content-Security-Policy",
           "default-src 'none'; script-src 'self'; style-src 'self'; "
           "img-src 'self' data: blob:; connect-src 'self'; base-uri 'none'; "
           "form-action 'none'; frame-ancestors 'none'"},
          {"X-Content-Type-Options", "nosniff"},
          {"Referrer-Policy", "no-referrer"},
          {"Cross-Origin-Opener-Policy", "same-origin"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cache-Control", "no-store"},
      };
  return headers;
}

}  // namespace lamina::http
