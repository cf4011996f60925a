#include "cli/process/machine_memory.h"

#include <algorithm>
#include <fstream>

#include <fmt/format.h>
#include <sys/sysinfo.h>

namespace lamina::cli {
namespace {

// Lowers `least` to the file's limit, if it has one: version 2 writes "max"
// where there is none.
void apply_limit(const std::string& file, std::uint64_t& least) {
  std::uint64_t bytes = 0;
  if (std::ifstream(file) >> bytes && bytes > 0) {
    least = least == 0 ? bytes : std::min(least, bytes);
  }
}

// The limits of a group and of all above it. A container sees its own group as
// the root, whatever the path says.
void apply_groups(const std::string& mount, std::string path,
                  const std::string& name, std::uint64_t& least) {
  while (true) {
    apply_limit(fmt::format("{}{}/{}", mount, path, name), least);
    const std::size_t slash = path.rfind('/');
    if (slash == std::string::npos) return;
    path.resize(slash);
  }
}

}  // namespace

std::uint64_t control_group_memory(const std::string& root) {
  const std::string mount = root + "/sys/fs/cgroup";
  std::uint64_t least = 0;
  std::ifstream groups(root + "/proc/self/cgroup");
  // Lines such as "4:memory:/jobs/17" and, of version 2, "0::/jobs/17".
  for (std::string line; std::getline(groups, line);) {
    const std::size_t first = line.find(':');
    const std::size_t second = line.find(':', first + 1);
    if (second == std::string::npos) continue;
    const std::string controllers = line.substr(first + 1, second - first - 1);
    const std::string path = line.substr(second + 1);
    if (controllers.empty()) {
      apply_groups(mount, path, "memory.max", least);
    } else if (controllers == "memory") {
      apply_groups(mount + "/memory", path, "memory.limit_in_bytes", least);
    }
  }
  return least;
}

std::uint64_t machine_memory() {
  struct sysinfo machine {};
  if (::sysinfo(&machine) != 0) return control_group_memory();
  const std::uint64_t whole =
      std::uint64_t{machine.totalram} * machine.mem_unit;
  const std::uint64_t group = control_group_memory();
  return group == 0 ? whole : std::min(whole, group);
}

}  // namespace lamina::cli
