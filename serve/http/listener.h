#pragma once
// Where a server listens, and the socket that it listens with.
//
// Sockets are opened before the server is made: a program that shuts itself in
// (Landlock) opens them first.

#include <cstdint>
#include <string>
#include <string_view>

#include "base/file/open_file.h"

namespace lamina::http {

struct Address {
  std::string host;        // "127.0.0.1", "::1"; empty for a Unix socket
  std::uint16_t port = 0;  // 0: any that is free
  std::string path;        // of a Unix socket
};

// Reads "8280" (a port of 127.0.0.1), "127.0.0.1:8280", "[::1]:8280", or the
// path of a Unix socket, which has a '/'. Throws FileError for other texts.
Address parse_address(std::string_view text);

// As parse_address() reads it, with the host.
std::string text_of(const Address& address);

// Opens a socket that listens there. Throws FileError with the reason where
// that is not possible.
//
// A Unix socket's file that nobody listens on any more is replaced, and no
// other file. It has the mode 0660, or 0600 where the umask keeps the group
// out. Nobody removes it at the end.
OpenFile open_listener(const Address& address);

// Where a socket listens, with the port that was found.
Address address_of(const OpenFile& listener);

// Whether a host, as an IP address, is this machine alone.
inline bool is_loopback(std::string_view host) {
  return host.starts_with("127.") || host == "::1";
}

}  // namespace lamina::http
