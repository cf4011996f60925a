// What the program loads at start. Each shared library costs time and memory
// at every run; what is heavy is opened on first use instead.

#include <array>
#include <cstdio>
#include <memory>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace {

// What `command` prints.
std::string output_of(const std::string& command) {
  const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command.c_str(), "r"),
                                                   pclose);
  EXPECT_NE(pipe, nullptr) << command;
  std::string output;
  std::array<char, 4096> buffer{};
  while (const std::size_t size =
             std::fread(buffer.data(), 1, buffer.size(), pipe.get())) {
    output.append(buffer.data(), size);
  }
  return output;
}

// The libraries that the program names as needed (not what those need).
std::set<std::string> needed_libraries() {
  const std::string table = output_of("readelf -d " LAMINA_PROGRAM);
  std::set<std::string> names;
  const std::string mark = "Shared library: [";
  for (std::size_t at = table.find(mark); at != std::string::npos;
       at = table.find(mark, at + 1)) {
    const std::size_t begin = at + mark.size();
    names.insert(table.substr(begin, table.find(']', begin) - begin));
  }
  return names;
}

TEST(SharedLibraries, AreOnlyThoseOfTheList) {
  const std::set<std::string> known = {"libc.so.6",
                                       "libm.so.6",
                                       "libstdc++.so.6",
                                       "libgcc_s.so.1",
                                       "libtbb.so.12",
                                       "libfmt.so.9",
                                       "libpng16.so.16",
                                       "libz.so.1",  // libpng's, too
                                       "libdouble-conversion.so.3",
                                       "ld-linux-x86-64.so.2"};
  const std::set<std::string> needed = needed_libraries();
  ASSERT_FALSE(needed.empty()) << "readelf printed no library";
  for (const std::string& name : needed) {
    EXPECT_EQ(known.count(name), 1U) << LAMINA_PROGRAM " needs " << name;
  }
}

// Direct and indirect: a small library that drags in a display server would
// pass the test above.
TEST(SharedLibraries, AreFewInAll) {
  const std::string list = output_of("ldd " LAMINA_PROGRAM);
  std::size_t count = 0;
  for (const char character : list) count += character == '\n' ? 1 : 0;
  ASSERT_GT(count, 0U);
  EXPECT_LE(count, 16U) << list;
}

}  // namespace
