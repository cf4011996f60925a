#include "tests/conformance/page.h"

#include <fmt/format.h>

#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

bool has(const std::string& part) {
  static const std::string page =
      support::read_file(LAMINA_SOURCES "/docs/conformance.md");
  return page.find(part) != std::string::npos;
}

}  // namespace

bool page_has_line(const std::string& line) {
  return has(fmt::format("\n{}\n", line));
}

bool page_names(const std::string& name) {
  return has(fmt::format("`{}`", name));
}

bool is_exception(const std::string& name) {
  return has(fmt::format("\n| `{}` | ", name));
}

}  // namespace lamina::conformance
