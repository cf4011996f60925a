// Files that a design or a command line names are opened in one place
// (base/file/file_access.h). Whatever else touches files stands on a list here,
// with the reason why it may.

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/architecture/source_tree.h"

namespace {

namespace fs = std::filesystem;

using lamina::testing::kRoot;

// What opens a file, looks at one, changes one, or asks whether there is one.
const std::regex kTouch(
    R"(\b[io]?fstream\b|\b(fopen|freopen|opendir|readdir|realpath|mkstemp|)"
    R"(mkostemp|dlopen|gzopen|unzOpen\w*|zipOpen\w*|png_image_begin_read_from_file|)"
    R"(load_file|FT_New_Face|FcConfigAppFontAdd\w+|FcInitLoadConfig|)"
    R"(inotify_add_watch)\s*\()"
    R"(|(^|[^\w])::(open|openat|stat|lstat|fstatat|access|faccessat|readlink|readlinkat|)"
    R"(mkdir|mkdirat|rename|renameat2?|unlink|unlinkat|remove|symlink|link|)"
    R"(truncate|utimensat|chmod|chdir|execvp?e?|posix_spawnp?)\()"
    R"(|\bfs::(exists|is_\w+|status|symlink_status|canonical|weakly_canonical|)"
    R"(create_\w+|directory_iterator|recursive_directory_iterator|file_size|)"
    R"(last_write_time|remove|remove_all|rename|copy\w*|read_symlink|)"
    R"(temp_directory_path|permissions|resize_file|equivalent|space)\b)"
    R"(|std::filesystem::(exists|is_\w+|canonical|weakly_canonical|remove\w*|)"
    R"(temp_directory_path|create_\w+|file_size|last_write_time)\b)");

const std::map<std::string, std::string> kMayTouch = {
    {"base/file/file_access.cpp", "the one place"},
    {"base/file/detail/confined_walk.cpp", "its way through folders"},
    {"base/file/detail/planted_link.cpp", "whose links are on the way"},
    {"base/file/temporary_files.cpp",
     "names beside what FileAccess::find_output found"},
    {"base/file/append_file.cpp", "what FileAccess::find_output found"},
    {"base/file/output_digest.cpp", "the same"},
    {"base/file/output_file.cpp",
     "what FileAccess::find_output found; devices without --root"},
    {"base/file/module.cpp", "the program's own modules"},
    {"base/child_process.cpp", "/dev/null, /proc/self/statm"},
    {"csg/text/font_cache.cpp",
     "Fontconfig, which looks for the system's fonts"},
    {"base/file/zip_output.cpp", "archives into an OutputFile"},
    {"ldni/gl/gl_platforms.cpp", "the system's OpenGL"},
    {"cli/process/landlock.cpp", "names folders to the kernel"},
    {"cli/process/openscad.cpp", "runs openscad; refused with --root"},
    {"cli/commands/watch.cpp", "--watch; refused with --root"},
    {"serve/run/file_watcher.cpp", "the same, the studio's and the service's"},
    {"serve/http/listener.cpp", "the Unix socket that the user serves on"},
    {"cli/commands/studio.cpp",
     "its cookie, and a browser; refused with --root"},
    {"cli/process/streams.cpp", "stands in for streams that are closed"},
    {"cli/report/run_report.cpp", "/proc/self/status"},
    {"cli/process/machine_memory.cpp", "/proc and /sys"},
    {"cli/pages/main.cpp", "another program, of the build"},
};

std::string without_comments(const std::string& line) {
  return line.substr(0, line.find("//"));
}

TEST(Files, AreOpenedInOnePlace) {
  std::map<std::string, bool> is_needed;
  for (const char* folder : {"base", "plane", "parser", "csg", "ldni", "slicer",
                             "compiler", "serve", "api", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      const std::string extension = entry.path().extension();
      if (extension != ".h" && extension != ".cpp") continue;
      const std::string file = fs::relative(entry.path(), kRoot).string();
      std::ifstream text(entry.path());
      std::string line;
      for (int number = 1; std::getline(text, line); ++number) {
        if (!std::regex_search(without_comments(line), kTouch)) continue;
        is_needed[file] = true;
        EXPECT_TRUE(kMayTouch.contains(file))
            << file << ":" << number << ": " << line
            << "\ntouches files; go through base/file/file_access.h";
      }
    }
  }
  for (const auto& [file, reason] : kMayTouch) {
    EXPECT_TRUE(is_needed[file]) << file << " needs no place on the list";
  }
}

// A default of "all files" is for tests and for other programs.
TEST(Files, TheProgramHandsOnWhatItMayUse) {
  const std::regex unconfined(R"(\bkAllFiles\b|\bFileAccess\(\))");
  for (const char* folder : {"compiler", "serve", "cli"}) {
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder)) {
      if (entry.path().extension() != ".cpp") continue;
      std::ifstream text(entry.path());
      std::string line;
      while (std::getline(text, line)) {
        EXPECT_FALSE(std::regex_search(line, unconfined))
            << entry.path() << line;
      }
    }
  }
}

}  // namespace
