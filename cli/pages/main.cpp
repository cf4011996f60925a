// lamina_pages FRAME FOLDER: writes the manual page, made from FRAME, and the
// completions of bash, zsh and fish into FOLDER. Run by the build.

#include <cstdio>
#include <exception>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "cli/pages/command_pages.h"
#include "cli/pages/completions.h"
#include "cli/pages/man_page.h"

namespace lamina::cli {
namespace {

std::string read(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(fmt::format("can't read {}", path));
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush())
    throw std::runtime_error(fmt::format("can't write {}", path));
}

void write_pages(const std::string& frame, const std::string& folder) {
  const std::vector<CommandPage> pages = command_pages();
  write(folder + "/lamina.1", man_page(pages, read(frame)));
  write(folder + "/lamina.bash", bash_completion(pages));
  write(folder + "/_lamina", zsh_completion(pages));
  write(folder + "/lamina.fish", fish_completion(pages));
}

}  // namespace
}  // namespace lamina::cli

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: lamina_pages FRAME FOLDER\n", stderr);
    return 2;
  }
  try {
    lamina::cli::write_pages(argv[1], argv[2]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lamina_pages: %s\n", error.what());
    return 1;
  }
  return 0;
}
