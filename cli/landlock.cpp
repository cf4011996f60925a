#include "cli/landlock.h"

#include <cstdint>
#include <cstdlib>
#include <set>
#include <string>

#include <fcntl.h>
#include <link.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "csg/text/typesetter.h"
#include "parser/open_file.h"

namespace lamina::cli {
namespace {

constexpr std::uint64_t kRead =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
    LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_DIR |
    LANDLOCK_ACCESS_FS_MAKE_REG;
// Not to be had anywhere: to run programs, to make devices, pipes, links.
constexpr std::uint64_t kNever =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_SYM;

int create_ruleset() {
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = kRead | kWrite | kNever;
  return static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes,
                                    sizeof(attributes), 0));
}

class Ruleset {
 public:
  Ruleset() : file_(create_ruleset()) {}

  explicit operator bool() const { return static_cast<bool>(file_); }

  void allow(int folder, std::uint64_t rights) const {
    landlock_path_beneath_attr rule{};
    rule.allowed_access = rights;
    rule.parent_fd = folder;
    ::syscall(SYS_landlock_add_rule, file_.descriptor(),
              LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }

  // What is not there is passed over.
  void allow_reading(const std::string& path) const {
    const OpenFile folder(
        ::open(path.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (folder) {
      allow(folder.descriptor(), kRead);
      return;
    }
    const OpenFile file(::open(path.c_str(), O_PATH | O_CLOEXEC));
    if (file) allow(file.descriptor(), LANDLOCK_ACCESS_FS_READ_FILE);
  }

  void enforce() const {
    if (::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
    ::syscall(SYS_landlock_restrict_self, file_.descriptor(), 0);
  }

 private:
  OpenFile file_;
};

// The folders of the shared libraries that are loaded: others that these need
// later lie beside them.
std::set<std::string> library_folders_in_use() {
  std::set<std::string> folders;
  const auto add = [](dl_phdr_info* info, std::size_t, void* data) {
    const std::string path = info->dlpi_name;
    const std::size_t slash = path.rfind('/');
    if (slash != std::string::npos && slash > 0) {
      static_cast<std::set<std::string>*>(data)->insert(path.substr(0, slash));
    }
    return 0;
  };
  ::dl_iterate_phdr(add, &folders);
  return folders;
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Where Fontconfig looks for its configuration.
std::set<std::string> fontconfig_places() {
  const std::string home = variable("HOME");
  return {"/etc/fonts",
          "/usr/share/fontconfig",
          home + "/.config/fontconfig",
          home + "/.fonts.conf",
          home + "/.fonts.conf.d",
          variable("XDG_CONFIG_HOME") + "/fontconfig",
          variable("FONTCONFIG_FILE"),
          variable("FONTCONFIG_PATH")};
}

}  // namespace

void restrict_process(const FileAccess& access) {
  if (!access.is_confined()) return;
  const Ruleset rules;
  if (!rules) return;
  for (const char* own :
       {"/usr/lib", "/usr/lib64", "/usr/local/lib", "/lib", "/lib64",
        "/etc/ld.so.cache", "/usr/share/drirc.d", "/etc/localtime",
        "/proc/self", "/proc/meminfo", "/proc/cpuinfo", "/proc/stat",
        "/sys/devices", "/sys/fs/cgroup", "/dev/dri", "/dev/null",
        "/dev/urandom"}) {
    rules.allow_reading(own);
  }
  for (const std::string& place : fontconfig_places()) {
    rules.allow_reading(place);
  }
  for (const std::string& folder : library_folders_in_use()) {
    rules.allow_reading(folder);
  }
  for (const std::string& folder : text::module_folders()) {
    rules.allow_reading(folder + "/" + text::kModuleName);
  }
  const std::vector<int> folders = access.folder_descriptors();
  rules.allow(folders.front(), kRead | kWrite);
  for (const int folder : folders) rules.allow(folder, kRead);
  rules.enforce();
}

}  // namespace lamina::cli
