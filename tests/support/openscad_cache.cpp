#include "tests/support/openscad_cache.h"

#include <cstdint>
#include <cstdlib>
#include <set>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::support {
namespace {

namespace fs = std::filesystem;

// Processor time [s]: the slowest of its own examples takes it a minute.
constexpr const char* kTimeLimit = "--cpu=240";
constexpr int kDesignIsAtFault = 1;  // or makes nothing

const std::string& installed_version() {
  static const std::string version = [] {
    const ProcessResult result = run_process({"openscad", "--version"});
    if (result.status != 0) throw std::runtime_error("openscad does not run");
    return result.output + result.errors;
  }();
  return version;
}

std::string command_of(OpenScad program) {
  return program == OpenScad::k2021 ? "openscad" : LAMINA_OPENSCAD_2026;
}

// What changes with the program. Its wrapper names the version of the other.
std::string identity_of(OpenScad program) {
  return program == OpenScad::k2021 ? installed_version()
                                    : read_file(LAMINA_OPENSCAD_2026);
}

// Names of the fonts on this machine: which of them a text takes depends on
// all that are there.
const std::string& installed_fonts() {
  static const std::string fonts = [] {
    std::set<std::string> names;
    for (const char* const folder :
         {"/usr/share/fonts", "/usr/local/share/fonts"}) {
      std::error_code missing;
      for (const fs::directory_entry& entry :
           fs::recursive_directory_iterator(folder, missing)) {
        names.insert(entry.path().filename().string());
      }
    }
    std::string all;
    for (const std::string& name : names) all += name + '\0';
    return all;
  }();
  return fonts;
}

// FNV-1a.
std::uint64_t hash(const std::string& text) {
  std::uint64_t value = 0xcbf29ce484222325;
  for (const char c : text) {
    value ^= static_cast<unsigned char>(c);
    value *= 0x100000001b3;
  }
  return value;
}

// The folder in which the cache keeps the answer.
fs::path place_of(const fs::path& design, const std::string& format,
                  const std::vector<std::string>& options, OpenScad program) {
  std::string key = identity_of(program) + installed_fonts() + design.string() +
                    read_file(design.string());
  for (const std::string& option : options) key += '\0' + option;
  return cache_folder() / fmt::format("{}-{:016x}.{}", design.stem().string(),
                                      hash(key), format);
}

// Moves what `folder` holds to `place` at once. Where another test was first,
// its answer stays.
void publish(const TemporaryFolder& folder, const fs::path& place) {
  std::error_code error;
  fs::rename(folder.path(), place, error);
  if (error && !fs::exists(place)) {
    throw fs::filesystem_error("no answer is kept", place, error);
  }
}

void run_openscad(const fs::path& design, const std::string& format,
                  const std::vector<std::string>& options, OpenScad program,
                  const fs::path& place) {
  const TemporaryFolder folder(cache_folder());
  std::vector<std::string> command = {"prlimit", kTimeLimit,
                                      command_of(program)};
  command.insert(command.end(), options.begin(), options.end());
  command.insert(command.end(),
                 {"-o", folder.file("output." + format), design.string()});
  const ProcessResult result = run_process(command, cache_folder().string());
  if (result.status != 0 && result.status != kDesignIsAtFault) {
    throw std::runtime_error(fmt::format("openscad ends with {} on {}\n{}",
                                         result.status, design.string(),
                                         result.errors));
  }
  folder.write("words", result.errors);
  publish(folder, place);
}

}  // namespace

OpenScadResult ask_openscad(const fs::path& design, const std::string& format,
                            const std::vector<std::string>& options,
                            OpenScad program) {
  const fs::path place = place_of(design, format, options, program);
  if (!fs::exists(place)) {
    run_openscad(design, format, options, program, place);
  }
  OpenScadResult result{read_file((place / "words").string()), {}};
  const fs::path output = place / ("output." + format);
  if (fs::exists(output)) result.output = output;
  return result;
}

fs::path cache_folder() {
  fs::path folder = fs::temp_directory_path() / "lamina-tests";
  if (const char* own = std::getenv("LAMINA_TEST_CACHE")) {
    folder = own;
  } else if (const char* user = std::getenv("XDG_CACHE_HOME")) {
    folder = fs::path(user) / "lamina-tests";
  } else if (const char* home = std::getenv("HOME")) {
    folder = fs::path(home) / ".cache" / "lamina-tests";
  }
  fs::create_directories(folder);
  return folder;
}

}  // namespace lamina::support
