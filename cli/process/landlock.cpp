#include "cli/process/landlock.h"

#include <cstdint>
#include <cstdlib>
#include <new>
#include <set>
#include <sstream>
#include <string>

#include <fcntl.h>
#include <link.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "base/file/module.h"
#include "base/file/open_file.h"
#include "csg/cad/cad_reader.h"
#include "csg/import/decimate.h"
#include "csg/text/typesetter.h"
#include "serve/http/server.h"

namespace lamina::cli {
namespace {

// Rights that the header may be too old to name.
constexpr std::uint64_t kRefer = 1U << 13;     // since version 2
constexpr std::uint64_t kTruncate = 1U << 14;  // 3
constexpr std::uint64_t kIoctlDev = 1U << 15;  // 5

constexpr std::uint64_t kRead =
    LANDLOCK_ACCESS_FS_READ_FILE | LANDLOCK_ACCESS_FS_READ_DIR;
constexpr std::uint64_t kWrite =
    LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_REMOVE_DIR |
    LANDLOCK_ACCESS_FS_REMOVE_FILE | LANDLOCK_ACCESS_FS_MAKE_DIR |
    LANDLOCK_ACCESS_FS_MAKE_REG | kTruncate;
// Refused everywhere: to run programs, to make devices, pipes and links, to
// move files between folders, to command devices.
constexpr std::uint64_t kNever =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_MAKE_CHAR |
    LANDLOCK_ACCESS_FS_MAKE_BLOCK | LANDLOCK_ACCESS_FS_MAKE_SOCK |
    LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_SYM | kRefer |
    kIoctlDev;

// The rights that a version of Landlock knows: it refuses others.
std::uint64_t known_rights(long version) {
  if (version < 2) return kRefer - 1;
  if (version < 3) return kTruncate - 1;
  if (version < 5) return kIoctlDev - 1;
  return ~std::uint64_t{0};
}

int create_ruleset(std::uint64_t rights) {
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = rights;
  return static_cast<int>(::syscall(SYS_landlock_create_ruleset, &attributes,
                                    sizeof(attributes), 0));
}

class Ruleset {
 public:
  Ruleset()
      : handled_((kRead | kWrite | kNever) & known_rights(landlock_version())),
        file_(create_ruleset(handled_)) {}

  explicit operator bool() const { return static_cast<bool>(file_); }

  void allow(int folder, std::uint64_t rights) const {
    landlock_path_beneath_attr rule{};
    rule.allowed_access = rights & handled_;
    rule.parent_fd = folder;
    ::syscall(SYS_landlock_add_rule, file_.descriptor(),
              LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  }

  // A path that does not exist is passed over.
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
  std::uint64_t handled_;
  OpenFile file_;
};

// The folders of the shared libraries that are loaded: others that these need
// later lie beside them.
std::set<std::string> library_folders_in_use() {
  struct Folders {
    std::set<std::string> paths;
    bool lack_memory = false;
  };
  Folders folders;
  // Nothing is thrown through glibc: without memory it cannot unwind its stack.
  const auto add = [](dl_phdr_info* info, std::size_t, void* data) {
    Folders& found = *static_cast<Folders*>(data);
    try {
      const std::string path = info->dlpi_name;
      const std::size_t slash = path.rfind('/');
      if (slash != std::string::npos && slash > 0) {
        found.paths.insert(path.substr(0, slash));
      }
    } catch (const std::bad_alloc&) {
      found.lack_memory = true;
    }
    return 0;
  };
  ::dl_iterate_phdr(add, &folders);
  if (folders.lack_memory) throw std::bad_alloc();
  return folders.paths;
}

std::string variable(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Where Fontconfig looks for its configuration, but for the user's: HOME may be
// the root, where strangers write.
std::set<std::string> fontconfig_places() {
  std::set<std::string> places = {"/etc/fonts", "/usr/share/fontconfig",
                                  variable("FONTCONFIG_FILE")};
  std::istringstream folders(variable("FONTCONFIG_PATH"));
  for (std::string folder; std::getline(folders, folder, ':');) {
    places.insert(folder);
  }
  return places;
}

}  // namespace

long landlock_version() {
  return ::syscall(SYS_landlock_create_ruleset, nullptr, 0,
                   LANDLOCK_CREATE_RULESET_VERSION);
}

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
  for (const std::string& folder : module_folders()) {
    for (const Module& module :
         {text::kModule, cad::kModule, csg::kDecimationModule, http::kModule}) {
      rules.allow_reading(folder + "/" + module.file);
    }
  }
  const std::vector<int> folders = access.folder_descriptors();
  rules.allow(folders.front(), kRead | kWrite);
  for (const int folder : folders) rules.allow(folder, kRead);
  rules.enforce();
}

}  // namespace lamina::cli
