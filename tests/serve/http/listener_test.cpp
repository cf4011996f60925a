#include "serve/http/listener.h"

#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "tests/serve/http/serving.h"
#include "tests/support/temporary_folder.h"

namespace lamina::http {
namespace {

unsigned mode_of(const std::string& path) {
  struct stat status {};
  EXPECT_EQ(::lstat(path.c_str(), &status), 0);
  EXPECT_TRUE(S_ISSOCK(status.st_mode));
  return status.st_mode & 0777U;
}

TEST(ParseAddress, ReadsPortsHostsAndPaths) {
  for (const auto& [text, whole] :
       std::vector<std::pair<std::string, std::string>>{
           {"8280", "127.0.0.1:8280"},
           {"0", "127.0.0.1:0"},
           {"65535", "127.0.0.1:65535"},
           {"127.0.0.1:8280", "127.0.0.1:8280"},
           {"0.0.0.0:80", "0.0.0.0:80"},
           {"[::1]:8280", "[::1]:8280"},
           {"[::]:80", "[::]:80"},
           {"/run/lamina/socket", "/run/lamina/socket"},
           {"./socket:1", "./socket:1"}}) {
    EXPECT_EQ(text_of(parse_address(text)), whole);
  }
  EXPECT_EQ(parse_address("[::1]:8280").host, "::1");
  EXPECT_EQ(parse_address("[::1]:8280").port, 8280);
  EXPECT_EQ(parse_address("/run/socket").path, "/run/socket");
}

TEST(ParseAddress, RefusesOtherTexts) {
  for (const std::string text :
       {"", "65536", "-1", "80a", " 80", "127.0.0.1",
        "127.0.0.1:", "127.0.0.1:x", "127.0.0:80", "localhost:80", "::1:80",
        "[::1]", "[127.0.0.1]:80", "[::1:80", ":80", "socket"}) {
    EXPECT_TRUE(has(error_of([&] { parse_address(text); }),
                    "the path of a Unix socket with a '/', not '" + text + "'"))
        << text;
  }
}

TEST(OpenListener, FindsAFreePort) {
  const OpenFile listener = open_listener(parse_address("127.0.0.1:0"));
  const Address own = address_of(listener);
  EXPECT_EQ(own.host, "127.0.0.1");
  EXPECT_NE(own.port, 0);
  const Client client(own);
}

TEST(OpenListener, FailsWithTheReasonOfTheSystem) {
  const OpenFile first = open_listener(parse_address("0"));
  const Address own = address_of(first);
  EXPECT_EQ(error_of([&] { open_listener(own); }),
            "can't serve on port " + std::to_string(own.port) +
                ": Address already in use");
  // An address for documentation (RFC 5737).
  EXPECT_EQ(error_of([] { open_listener(parse_address("192.0.2.1:80")); }),
            "can't serve on 192.0.2.1:80: Cannot assign requested address");
  EXPECT_EQ(error_of([] { open_listener(parse_address("/nonexistent/s")); }),
            "can't serve on /nonexistent/s: No such file or directory");
  const std::string longest = "/" + std::string(108, 'a');
  EXPECT_EQ(error_of([&] { open_listener(parse_address(longest)); }),
            "can't serve on " + longest + ": File name too long");
}

TEST(OpenListener, LetsUserAndGroupConnect) {
  const support::TemporaryFolder folder;
  for (const auto& [mask, mode] : std::vector<std::pair<mode_t, unsigned>>{
           {022, 0660}, {002, 0660}, {0, 0660}, {077, 0600}}) {
    const std::string path = folder.file(std::to_string(mask));
    const mode_t before = ::umask(mask);
    const OpenFile listener = open_listener(parse_address(path));
    ::umask(before);
    EXPECT_EQ(mode_of(path), mode);
    EXPECT_EQ(address_of(listener).path, path);
    const Client client(address_of(listener));
  }
}

TEST(OpenListener, ReplacesASocketThatNobodyListensOn) {
  const support::TemporaryFolder folder;
  const Address address = parse_address(folder.file("socket"));
  { const OpenFile ended = open_listener(address); }
  EXPECT_EQ(mode_of(address.path), 0660U);  // it is still there
  const OpenFile listener = open_listener(address);
  const Client client(address);
}

TEST(OpenListener, KeepsTheSocketOfAnotherServer) {
  const support::TemporaryFolder folder;
  const Address address = parse_address(folder.file("socket"));
  const OpenFile listener = open_listener(address);
  EXPECT_EQ(error_of([&] { open_listener(address); }),
            "can't serve on " + address.path + ": Address already in use");
  const Client client(address);
}

TEST(OpenListener, KeepsOtherFiles) {
  const support::TemporaryFolder folder;
  const std::string file = folder.write("file", "bytes");
  const std::string link = folder.file("link");
  ASSERT_EQ(::symlink("file", link.c_str()), 0);
  for (const std::string& path : {file, link, folder.path() + "/."}) {
    EXPECT_EQ(
        error_of([&] { open_listener(parse_address(path)); }),
        "can't serve on " + path + ": there is a file that is not a socket");
  }
  EXPECT_EQ(support::read_file(link), "bytes");
}

TEST(IsLoopback, IsTrueOfThisMachine) {
  EXPECT_TRUE(is_loopback("127.0.0.1"));
  EXPECT_TRUE(is_loopback("127.1.2.3"));
  EXPECT_TRUE(is_loopback("::1"));
  EXPECT_FALSE(is_loopback("0.0.0.0"));
  EXPECT_FALSE(is_loopback("192.0.2.1"));
  EXPECT_FALSE(is_loopback("::"));
  EXPECT_FALSE(is_loopback(""));
}

}  // namespace
}  // namespace lamina::http
