// What a stranger sends to the server over one connection.
//
// Each input goes to a server for browsers and to one for programs. Server and
// peer take turns in one thread: the peer sends all, ends its side and reads to
// the end. The bytes "PORT" stand for the server's port, which a request must
// name.

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "serve/http/server.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

struct Serving {
  explicit Serving(http::Peers peers) {
    http::Policy policy;
    policy.peers = peers;
    policy.has_problems = peers == http::Peers::kPrograms;
    server = http::make_server({}, policy, {LAMINA_MODULES}, diagnostics);
    OpenFile listener = http::open_listener(http::parse_address("0"));
    port = http::address_of(listener).port;
    server->listen(std::move(listener));
  }

  Diagnostics diagnostics;
  std::unique_ptr<http::Server> server;
  std::uint16_t port = 0;
};

std::string with_port(std::string text, std::uint16_t port) {
  constexpr std::string_view kMark = "PORT";
  const std::string number = std::to_string(port);
  for (std::size_t at = text.find(kMark); at != std::string::npos;
       at = text.find(kMark, at + number.size())) {
    text.replace(at, kMark.size(), number);
  }
  return text;
}

int connect_to(std::uint16_t port) {
  const int peer = ::socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  fuzz::require(::connect(peer, reinterpret_cast<sockaddr*>(&address),
                          sizeof address) == 0,
                "the server can be reached");
  return peer;
}

// What the server sends for the bytes.
std::string exchange(http::Server& server, std::uint16_t port,
                     const std::string& bytes, const http::Handler& handler) {
  const int peer = connect_to(port);
  fuzz::require(::send(peer, bytes.data(), bytes.size(), 0) ==
                    static_cast<ssize_t>(bytes.size()),
                "the socket takes a small input whole");
  ::shutdown(peer, SHUT_WR);
  std::string answers;
  server.on_readable(peer, [&] {
    std::array<char, 65536> part{};
    const ssize_t size = ::recv(peer, part.data(), part.size(), 0);
    if (size > 0) {
      answers.append(part.data(), static_cast<std::size_t>(size));
    } else {
      server.stop();
    }
  });
  server.run(handler);
  server.forget(peer);
  ::close(peer);
  return answers;
}

void require_well_formed(const http::Request& request) {
  const auto is_visible = [](std::string_view text) {
    return std::all_of(text.begin(), text.end(), [](char c) {
      return std::isgraph(static_cast<unsigned char>(c)) != 0;
    });
  };
  fuzz::require(request.method == "GET" || request.method == "POST",
                "the method is one of two");
  fuzz::require(request.path.starts_with('/') && is_visible(request.path) &&
                    is_visible(request.query),
                "the target is a path of visible letters");
  fuzz::require(request.body.empty() || request.method == "POST",
                "only POST has a body");
  fuzz::require(request.body.size() <= http::Limits().body_bytes,
                "the body keeps to its limit");
}

// Reads the status of the first answer, and takes the answer away.
int take_answer(std::string_view& answers, bool is_head) {
  const std::size_t end = answers.find("\r\n\r\n");
  fuzz::require(answers.starts_with("HTTP/1.1 ") && end != answers.npos,
                "each answer has a head");
  const std::string head(answers.substr(0, end + 2));
  const std::string mark = "\r\nContent-Length: ";
  const std::size_t at = head.find(mark);
  fuzz::require(at != head.npos, "each answer has a length");
  const std::size_t size =
      is_head ? 0 : std::strtoul(head.c_str() + at + mark.size(), nullptr, 10);
  answers.remove_prefix(end + 4);
  fuzz::require(size <= answers.size(), "each answer comes whole");
  answers.remove_prefix(size);
  return std::atoi(head.c_str() + 9);
}

void check(const Serving& serving, std::string_view input) {
  int handled = 0;
  int refused = 0;
  serving.server->on_refusal([&](unsigned) { ++refused; });
  const std::string answers =
      exchange(*serving.server, serving.port,
               with_port(std::string(input), serving.port),
               [&](const http::Request& request,
                   const std::shared_ptr<http::Reply>& reply) {
                 ++handled;
                 require_well_formed(request);
                 // Without a body HEAD and GET are answered alike.
                 reply->send({});
               });
  std::string_view rest = answers;
  for (int i = 0; i < handled; ++i) {
    fuzz::require(take_answer(rest, false) == 200,
                  "what is handled is answered, in order");
  }
  fuzz::require(refused == (rest.empty() ? 0 : 1),
                "what is refused is reported, once");
  if (!rest.empty()) {
    // A refusal of a HEAD has no body.
    const bool is_head = rest.ends_with("\r\n\r\n");
    fuzz::require(take_answer(rest, is_head) >= 400,
                  "what is not handled is refused");
    fuzz::require(rest.empty(), "nothing comes after a refusal");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  static const Serving browsers(http::Peers::kBrowsers);
  static const Serving programs(http::Peers::kPrograms);
  const std::string_view input = fuzz::as_text(data, size);
  check(browsers, input);
  check(programs, input);
  return 0;
}
