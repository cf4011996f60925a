#pragma once
// A server in this process, and connections to it, as strangers open them.

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "serve/http/server.h"
#include "tests/support/process.h"
#include "tests/support/text.h"

namespace lamina::http {

using std::chrono::milliseconds;
using support::has;
using support::wait_until;
using ReplyPointer = std::shared_ptr<Reply>;

// Waits until it is set; false where that takes a minute.
inline bool wait_for(const std::atomic<bool>& flag) {
  return wait_until([&] { return flag.load(); });
}

class Client {
 public:
  explicit Client(const Address& address) : socket_(make_socket(address)) {
    connect(address);
  }
  ~Client() { close(); }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void send(const std::string& bytes) {
    EXPECT_EQ(::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(bytes.size()));
  }
  // All up to the end.
  std::string receive() {
    std::string all;
    while (receive_some(all)) {
    }
    return all;
  }
  // All up to the words.
  std::string receive_to(const std::string& words) {
    std::string all;
    while (!has(all, words) && receive_some(all)) {
    }
    return all;
  }
  void close() {
    if (socket_ >= 0) ::close(std::exchange(socket_, -1));
  }

 private:
  static int make_socket(const Address& address) {
    if (address.host.empty()) return ::socket(AF_UNIX, SOCK_STREAM, 0);
    const bool is_six = has(address.host, ":");
    return ::socket(is_six ? AF_INET6 : AF_INET, SOCK_STREAM, 0);
  }

  void connect(const Address& address) {
    const timeval most{10, 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &most, sizeof most);
    if (address.host.empty()) {
      sockaddr_un local{};
      local.sun_family = AF_UNIX;
      address.path.copy(local.sun_path, sizeof local.sun_path - 1);
      return connect_to(local);
    }
    if (has(address.host, ":")) {
      sockaddr_in6 six{};
      six.sin6_family = AF_INET6;
      six.sin6_port = htons(address.port);
      six.sin6_addr = in6addr_loopback;
      return connect_to(six);
    }
    sockaddr_in four{};
    four.sin_family = AF_INET;
    four.sin_port = htons(address.port);
    four.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    connect_to(four);
  }

  template <typename Kind>
  void connect_to(const Kind& kind) {
    EXPECT_EQ(::connect(socket_, reinterpret_cast<const sockaddr*>(&kind),
                        sizeof kind),
              0)
        << std::strerror(errno);
  }

  bool receive_some(std::string& all) {
    std::array<char, 65536> bytes{};
    const ssize_t size = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (size > 0) all.append(bytes.data(), static_cast<std::size_t>(size));
    return size > 0;
  }

  int socket_;
};

class Pipe {
 public:
  Pipe() { EXPECT_EQ(::pipe(ends_.data()), 0); }
  ~Pipe() {
    ::close(ends_[0]);
    end();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;

  int reader() const { return ends_[0]; }
  void write(char byte) { EXPECT_EQ(::write(ends_[1], &byte, 1), 1); }
  char read() {
    char byte = 0;
    EXPECT_EQ(::read(ends_[0], &byte, 1), 1);
    return byte;
  }
  void end() {
    if (ends_[1] >= 0) ::close(std::exchange(ends_[1], -1));
  }

 private:
  std::array<int, 2> ends_{};
};

class Serving : public testing::Test {
 protected:
  explicit Serving(const Limits& limits = {}, const Policy& policy = {},
                   const std::string& address = "0")
      : server_(make_server(limits, policy, {LAMINA_MODULES}, diagnostics_)) {
    OpenFile listener = open_listener(parse_address(address));
    address_ = address_of(listener);
    server_->listen(std::move(listener));
  }

  // Serves while the client does its work in a thread.
  template <typename Work>
  void serve(const Handler& handler, const Work& work) {
    Pipe done;
    server_->on_readable(done.reader(), [&] { server_->stop(); });
    std::thread client([&] {
      work();
      done.write('x');
    });
    try {
      server_->run(handler);
    } catch (...) {
      server_.reset();
      client.join();
      throw;
    }
    client.join();
    server_->forget(done.reader());
  }

  // What the server sends for a request, until it ends the connection.
  std::string answer_to(const std::string& request, const Handler& handler) {
    std::string answer;
    serve(handler, [&] {
      Client client(address_);
      client.send(request);
      answer = client.receive();
    });
    return answer;
  }

  // A reply that comes late learns that its peer has gone, and may be sent.
  void expect_peer_is_seen_to_go() {
    ReplyPointer late;
    std::atomic<bool> has_come = false;
    std::atomic<bool> has_closed = false;
    serve(
        [&](const Request&, const ReplyPointer& reply) {
          late = reply;
          reply->on_close([&] { has_closed = true; });
          has_come = true;
        },
        [&] {
          Client client(address_);
          client.send(get("/"));
          EXPECT_TRUE(wait_for(has_come));
          client.close();
          EXPECT_TRUE(wait_for(has_closed));
        });
    Response response;
    response.body = "too late";
    late->send(response);
  }

  std::string port() const { return std::to_string(address_.port); }
  std::string host() const { return "Host: 127.0.0.1:" + port() + "\r\n"; }
  // A request after which the connection ends.
  std::string get(const std::string& target, const std::string& lines = "",
                  const std::string& method = "GET") const {
    return method + " " + target + " HTTP/1.1\r\n" + host() + lines +
           "Connection: close\r\n\r\n";
  }
  std::string post(const std::string& target, const std::string& body) const {
    return get(target,
               "Origin: http://127.0.0.1:" + port() + "\r\nContent-Length: " +
                   std::to_string(body.size()) + "\r\n",
               "POST") +
           body;
  }

  Diagnostics diagnostics_;
  std::unique_ptr<Server> server_;
  Address address_;
};

inline Response text(const std::string& body) {
  Response response;
  response.body = body;
  return response;
}

inline Handler always(const Response& response) {
  return [response](const Request&, const ReplyPointer& reply) {
    reply->send(response);
  };
}

inline std::string body_of(const std::string& answer) {
  const std::size_t end = answer.find("\r\n\r\n");
  return end == std::string::npos ? "" : answer.substr(end + 4);
}

// The message of the FileError that a call throws; empty if it throws none.
template <typename Call>
std::string error_of(const Call& call) {
  try {
    call();
  } catch (const FileError& error) {
    return error.diagnostic().message;
  }
  return "";
}

}  // namespace lamina::http
