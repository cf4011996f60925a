// Runs a fuzzer without libFuzzer, on inputs that are there.
//
//     stl_replay FILE|FOLDER…
//
// A crash, a sanitizer's report or an exception that a fuzzer does not expect
// ends the program; the input's name is the last line printed then. No input is
// worth a gigabyte: more is not given, but where sanitizers reserve terabytes.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <sys/resource.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size);

namespace {

namespace fs = std::filesystem;

// The files of `path`, in the order of their names.
std::vector<fs::path> files_below(const fs::path& path) {
  if (!fs::is_directory(path)) return {path};
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(path)) {
    if (entry.is_regular_file()) files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

// The bytes lie in memory of exactly their size, so that a sanitizer sees who
// reads on.
void run(const fs::path& path) {
  std::printf("%s\n", path.c_str());
  std::fflush(stdout);
  std::ifstream file(path, std::ios::binary);
  const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                         bytes.size());
}

void limit_memory() {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  constexpr rlimit kGigabyte{1 << 30, 1 << 30};
  setrlimit(RLIMIT_DATA, &kGigabyte);
#endif
}

}  // namespace

int main(int count, char** arguments) {
  limit_memory();
  LLVMFuzzerTestOneInput(nullptr, 0);
  for (int i = 1; i < count; ++i) {
    // A target without findings has no folder of crashes.
    if (!fs::exists(arguments[i])) continue;
    for (const fs::path& path : files_below(arguments[i])) run(path);
  }
  return 0;
}
