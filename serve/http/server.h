#pragma once
// A server for HTTP/1.1, with a limit for everything that a stranger can send:
// for the browsers of this machine's user, or for programs (Policy).
//
// Boost.Beast reads and writes; it stands behind a module (base/file/module.h),
// so that no other run pays for it. One thread does all: it calls the handler
// for each request, and what else it was asked to call.
//
// What is refused before the handler sees it, and by which status:
//
//   400  what is not HTTP/1.1: other versions, other targets than "/…" in
//        visible ASCII, control characters, folded lines; no Host or two, two
//        Content-Lengths, a body of GET
//   403  a Host that is not the server's (DNS rebinding); of browsers, whose
//        cookies count, also what another site has sent: an Origin other than
//        "http://" and an own Host, a Sec-Fetch-Site other than same-origin and
//        none, a POST without Origin
//   405  methods other than GET, HEAD and POST
//   408  headers or a body that take longer than their limit
//   413  a body longer than the limit
//   414  a request line longer than the limit
//   417  Expect
//   431  headers longer than the limit, or more of them
//   501  Transfer-Encoding
//
// Browsers send an Origin with each POST, so the rule for it costs none of them
// anything. Of programs HTTP/1.0 is taken, too, as web servers send on requests
// by it, and there may be no Host in it. After a refusal the connection is
// closed. More connections than the limit are closed as they come. Paths are
// not made shorter: "/../x" is the handler's to refuse.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/module.h"
#include "base/file/open_file.h"
#include "serve/http/listener.h"
#include "serve/http/status.h"

namespace lamina::http {

struct Limits {
  std::size_t line_bytes = 8 << 10;     // of the request line
  std::size_t header_bytes = 16 << 10;  // with the request line
  std::size_t headers = 64;
  std::size_t body_bytes = 64 << 10;
  std::chrono::milliseconds header_time{5000};  // from the connection, or from
                                                // the first byte of a later
                                                // request
  std::chrono::milliseconds body_time{5000};
  // Between two requests, and while the peer takes nothing of an answer.
  std::chrono::milliseconds idle_time{60000};
  std::size_t connections = 64;
  // Of one answer that its reader does not take; then it is cut off.
  std::size_t queued_bytes = 32 << 20;
};

enum class Peers { kBrowsers, kPrograms };

struct Policy {
  Peers peers = Peers::kBrowsers;
  // The Hosts that programs may name, in any letter case, with a port or for
  // each. Where there are none: 127.0.0.1:PORT, localhost:PORT and [::1]:PORT
  // if the server listens on a loopback address, else any. Browsers may name
  // the first two.
  std::vector<std::string> hosts;
  // Refusals are problems of RFC 9457 (application/problem+json), not words.
  bool has_problems = false;
};

struct Request {
  std::string method;        // "GET" also for HEAD, "POST"
  std::string path;          // as it came, without the query: "/file/5"
  std::string query;         // behind the '?', as it came
  std::string content_type;  // without parameters, lower case
  std::string body;
  std::string if_none_match;  // all of them, joined by ", "
  // The IP address of the client. Of one on this machine, which may have sent
  // on the request for another: the last one of X-Forwarded-For, of any text,
  // at most 64 bytes. Empty if it is not known.
  std::string peer;
  std::vector<std::pair<std::string, std::string>> cookies;

  // The value of a cookie; empty if it is not there.
  std::string_view cookie(std::string_view name) const {
    for (const auto& [known, value] : cookies) {
      if (known == name) return value;
    }
    return {};
  }
};

struct Response {
  unsigned status = 200;
  std::string type = "text/plain; charset=utf-8";
  std::string body;
  // A path. The file is sent instead of the body, as it is at that time, and
  // may be of any size; 404 where it cannot be opened.
  std::string file;
  // Beside those that every answer has: security policy, no caching, length.
  // One of the first two kinds is sent instead of the server's of that name.
  // Where a name or value cannot be sent (line feeds in it), the answer is 500.
  std::vector<std::pair<std::string, std::string>> headers;
};

// An answer of 200.
Response content(std::string_view type, std::string body);

// The header by which an answer is kept as a file. What could not stand between
// its quotes is '_' in the name.
std::pair<std::string, std::string> attachment(std::string_view name);

// The answer to one request. It may come later, also when the connection has
// ended. One that is given up without an answer is answered by 500; one that is
// given up after begin() ends with what has been written.
//
// A peer that has closed its side counts as gone.
class Reply {
 public:
  virtual ~Reply() = default;

  // The whole answer. To be called once, or begin() instead.
  virtual void send(Response response) = 0;

  // Begins an answer that ends with the connection; it has no body yet.
  virtual void begin(Response response) = 0;
  // Adds to an answer that has begun. The writing goes on by itself; where
  // nobody takes it, the connection is closed (Limits::queued_bytes).
  virtual void write(std::string bytes) = 0;
  // Whether the connection still lives.
  virtual bool is_open() const = 0;
  // Calls once the connection has ended, however it did; at once if it has. Not
  // if the answer is sent and the next request has come.
  virtual void on_close(std::function<void()> call) = 0;
};

using Handler =
    std::function<void(const Request& request, std::shared_ptr<Reply> reply)>;

// Processes that the program forks may keep copies of its descriptors: the
// connections end all the same.
class Server {
 public:
  // Connections end at once, and no call is made.
  virtual ~Server() = default;

  // Takes connections of a socket that listens (open_listener()). To be called
  // once.
  virtual void listen(OpenFile listener) = 0;

  // Takes no connections any more, also none of those that wait for it. Those
  // without a request end now, the others with their answer. Calls once the
  // last has ended.
  virtual void stop_listening(std::function<void()> call) = 0;

  // Calls with the status of each answer that the server gives by itself: of
  // refusals, and of 500 where the handler has given an answer up.
  virtual void on_refusal(std::function<void(unsigned status)> call) = 0;

  // Calls whenever a descriptor, which no longer blocks from now on, can be
  // read or has come to its end, and at times when there is nothing to read,
  // until forget(). The descriptor (not of a file on a disk) stays the
  // caller's, who closes it after forget().
  virtual void on_readable(int descriptor, std::function<void()> call) = 0;
  virtual void forget(int descriptor) = 0;

  // Calls once, after so long.
  virtual void after(std::chrono::milliseconds time,
                     std::function<void()> call) = 0;

  // Answers until stop(), which a call from within may make. What the handler
  // and other calls throw ends it, and is thrown.
  virtual void run(const Handler& handler) = 0;
  virtual void stop() = 0;
};

// The module that holds Boost.Beast.
inline constexpr Module kModule{"lamina_http.so", "lamina_make_http_engine",
                                "serving", ""};

// Opens the module. Throws GeometryError where it is missing.
std::unique_ptr<Server> make_server(const Limits& limits, const Policy& policy,
                                    const std::vector<std::string>& folders,
                                    Diagnostics& diagnostics);

}  // namespace lamina::http
