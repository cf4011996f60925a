#include "serve/http/listener.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <optional>

#include <arpa/inet.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include "base/diagnostic.h"
#include "base/text.h"

namespace lamina::http {
namespace {

constexpr std::string_view kOwnHost = "127.0.0.1";

// An address as the system knows it.
struct SocketAddress {
  sockaddr_storage storage{};
  socklen_t size = sizeof(sockaddr_storage);

  template <typename Kind>
  Kind& as() {
    return reinterpret_cast<Kind&>(storage);
  }
  sockaddr* get() { return &as<sockaddr>(); }
};

std::optional<std::uint16_t> port_in(std::string_view text) {
  std::uint16_t port = 0;
  const char* const end = text.data() + text.size();
  const auto result = std::from_chars(text.data(), end, port);
  if (result.ec != std::errc() || result.ptr != end) return std::nullopt;
  return port;
}

bool is_host(int family, const std::string& host) {
  in6_addr ignored{};  // room for either
  return ::inet_pton(family, host.c_str(), &ignored) == 1;
}

// Of "127.0.0.1:8280" and "[::1]:8280".
std::optional<Address> host_and_port(std::string_view text) {
  const std::size_t mark = text.rfind(':');
  if (mark == std::string_view::npos) return std::nullopt;
  const auto port = port_in(text.substr(mark + 1));
  std::string_view host = text.substr(0, mark);
  const bool is_six = host.starts_with('[') && host.ends_with(']');
  if (is_six) host = host.substr(1, host.size() - 2);
  const Address address{std::string(host), port.value_or(0), ""};
  if (!port || !is_host(is_six ? AF_INET6 : AF_INET, address.host)) {
    return std::nullopt;
  }
  return address;
}

bool is_six(const Address& address) {
  return address.host.find(':') != std::string::npos;
}

[[noreturn]] void fail(const Address& address, std::string_view reason) {
  throw FileError(fmt::format("can't serve on {}: {}",
                              address.host == kOwnHost
                                  ? fmt::format("port {}", address.port)
                                  : on_one_line(text_of(address)),
                              reason));
}

[[noreturn]] void fail(const Address& address) {
  fail(address, std::strerror(errno));
}

SocketAddress internet_address(const Address& address) {
  SocketAddress result;
  if (is_six(address)) {
    auto& six = result.as<sockaddr_in6>();
    six.sin6_family = AF_INET6;
    six.sin6_port = htons(address.port);
    ::inet_pton(AF_INET6, address.host.c_str(), &six.sin6_addr);
    result.size = sizeof six;
  } else {
    auto& four = result.as<sockaddr_in>();
    four.sin_family = AF_INET;
    four.sin_port = htons(address.port);
    ::inet_pton(AF_INET, address.host.c_str(), &four.sin_addr);
    result.size = sizeof four;
  }
  return result;
}

SocketAddress unix_address(const Address& address) {
  SocketAddress result;
  auto& local = result.as<sockaddr_un>();
  if (address.path.size() >= sizeof local.sun_path) {
    errno = ENAMETOOLONG;
    fail(address);
  }
  local.sun_family = AF_UNIX;
  std::copy(address.path.begin(), address.path.end(), local.sun_path);
  result.size = sizeof local;
  return result;
}

OpenFile open_socket(const Address& address, int family) {
  OpenFile opened(
      ::socket(family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  if (!opened) fail(address);
  return opened;
}

bool bind(const OpenFile& opened, SocketAddress address) {
  return ::bind(opened.descriptor(), address.get(), address.size) == 0;
}

// Removes a socket's file, if nobody listens on it.
void remove_stale(const Address& address, SocketAddress place) {
  struct stat status {};
  if (::lstat(address.path.c_str(), &status) != 0) fail(address);
  if (!S_ISSOCK(status.st_mode)) {
    fail(address, "there is a file that is not a socket");
  }
  const OpenFile probe = open_socket(address, AF_UNIX);
  const bool is_served =
      ::connect(probe.descriptor(), place.get(), place.size) == 0 ||
      errno == EAGAIN;  // so many wait
  if (is_served) errno = EADDRINUSE;
  if (is_served || errno != ECONNREFUSED) fail(address);
  if (::unlink(address.path.c_str()) != 0) fail(address);
}

void bind_path(const Address& address, const OpenFile& opened) {
  const SocketAddress place = unix_address(address);
  // The file gets what the umask leaves of this.
  if (::fchmod(opened.descriptor(), 0660) != 0) fail(address);
  if (!bind(opened, place)) {
    if (errno != EADDRINUSE) fail(address);
    remove_stale(address, place);
    if (!bind(opened, place)) fail(address);
  }
  // To connect is to write, which the usual umask does not leave to the group.
  struct stat status {};
  const char* const path = address.path.c_str();
  if (::lstat(path, &status) != 0) fail(address);
  if ((status.st_mode & S_IRGRP) != 0 && ::chmod(path, 0660) != 0) {
    fail(address);
  }
}

void bind_port(const Address& address, const OpenFile& opened) {
  // The port is free as soon as its server has ended.
  const int is_on = 1;
  ::setsockopt(opened.descriptor(), SOL_SOCKET, SO_REUSEADDR, &is_on,
               sizeof is_on);
  if (!bind(opened, internet_address(address))) fail(address);
}

std::string host_of(int family, const void* bytes) {
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_ntop(family, bytes, text.data(), text.size());
  return text.data();
}

}  // namespace

Address parse_address(std::string_view text) {
  if (text.find('/') != std::string_view::npos) {
    return {"", 0, std::string(text)};
  }
  if (const auto port = port_in(text))
    return {std::string(kOwnHost), *port, ""};
  if (const auto address = host_and_port(text)) return *address;
  throw FileError(fmt::format(
      "an address to listen on is a port (8280), an IP address and a port "
      "(127.0.0.1:8280, [::1]:8280), or the path of a Unix socket with a '/', "
      "not '{}'",
      short_name(text)));
}

std::string text_of(const Address& address) {
  if (address.host.empty()) return address.path;
  const std::string host =
      is_six(address) ? '[' + address.host + ']' : address.host;
  return fmt::format("{}:{}", host, address.port);
}

OpenFile open_listener(const Address& address) {
  const bool is_path = address.host.empty();
  OpenFile opened = open_socket(
      address, is_path ? AF_UNIX : (is_six(address) ? AF_INET6 : AF_INET));
  is_path ? bind_path(address, opened) : bind_port(address, opened);
  if (::listen(opened.descriptor(), SOMAXCONN) != 0) fail(address);
  return opened;
}

Address address_of(const OpenFile& listener) {
  SocketAddress own;
  if (::getsockname(listener.descriptor(), own.get(), &own.size) != 0) {
    throw FileError(fmt::format("can't serve: {}", std::strerror(errno)));
  }
  switch (own.storage.ss_family) {
    case AF_INET: {
      const auto& four = own.as<sockaddr_in>();
      return {host_of(AF_INET, &four.sin_addr), ntohs(four.sin_port), ""};
    }
    case AF_INET6: {
      const auto& six = own.as<sockaddr_in6>();
      return {host_of(AF_INET6, &six.sin6_addr), ntohs(six.sin6_port), ""};
    }
    default:
      return {"", 0, own.as<sockaddr_un>().sun_path};
  }
}

}  // namespace lamina::http
