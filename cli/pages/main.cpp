// lamina_pages FOLDER FRAME...: fills the frames of the manual page
// (lamina.1.in) and of the completions of bash, zsh and fish (lamina.bash.in,
// _lamina.in, lamina.fish.in) and writes them into FOLDER. Run by the build.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>

#include "cli/pages/command_pages.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("can't read " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  if (!file.flush()) throw std::runtime_error("can't write " + path.string());
}

void write_page(const fs::path& folder, const fs::path& frame) {
  const std::map<std::string, decltype(&man_page)> makers = {
      {"lamina.1", man_page},
      {"lamina.bash", bash_completion},
      {"_lamina", zsh_completion},
      {"lamina.fish", fish_completion}};
  const fs::path name = frame.stem();
  write(folder / name, makers.at(name)(command_pages(), read(frame)));
}

}  // namespace
}  // namespace lamina::cli

int main(int argc, char** argv) {
  try {
    for (int i = 2; i < argc; ++i) lamina::cli::write_page(argv[1], argv[i]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "lamina_pages: %s\n", error.what());
    return 1;
  }
  return 0;
}
