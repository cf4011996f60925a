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

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = LAMINA_SOURCE_DIR;

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
    {"base/child_process.cpp", "/dev/null"},
    {"csg/text/font_cache.cpp",
     "Fontconfig, which looks for the system's fonts"},
    {"base/file/zip_output.cpp", "archives into an OutputFile"},
    {"ldni/gl/gl_platforms.cpp", "the system's OpenGL"},
    {"cli/process/landlock.cpp", "names folders to the kernel"},
    {"cli/process/openscad.cpp", "runs openscad; refused with --root"},
    {"cli/commands/watch.cpp", "--watch; refused with --root"},
    {"serve/run/file_watcher.cpp", "the same, the studio's and the service's"},
    {"serve/run/design_process.cpp", "/proc/self/statm"},
    {"serve/http/listener.cpp", "the Unix socket that the user serves on"},
