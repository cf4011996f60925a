#include "tests/fuzz/input.h"

#include <cstdio>
#include <cstdlib>

#include "tests/support/temporary_folder.h"

namespace lamina::fuzz {

std::string write_input(const std::string& name, std::string_view bytes) {
  static const support::TemporaryFolder folder;
  return folder.write(name, std::string(bytes));
}

void require(bool holds, std::string_view claim) {
  if (holds) return;
  std::fprintf(stderr, "does not hold: %.*s\n", static_cast<int>(claim.size()),
               claim.data());
  std::abort();
}

}  // namespace lamina::fuzz
