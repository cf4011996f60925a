#include "base/file/detail/planted_link.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include <unistd.h>

namespace lamina {

namespace fs = std::filesystem;

bool is_planted(const struct stat& link, const struct stat& folder) {
  constexpr mode_t kOpenToAll = S_ISVTX | S_IWOTH;
  return (folder.st_mode & kOpenToAll) == kOpenToAll &&
         link.st_uid != ::geteuid() && link.st_uid != folder.st_uid;
}

bool is_planted_at(const std::string& path, const struct stat& file) {
  const fs::path folder = fs::path(path).parent_path();
  struct stat status {};
  return ::stat(folder.empty() ? "." : folder.c_str(), &status) == 0 &&
         is_planted(file, status);
}

std::optional<std::string> find_planted_link(const std::string& path) {
  fs::path here;                  // through no link
  std::vector<fs::path> waiting;  // parts to walk, the next one last
  const auto push = [&](const fs::path& parts) {
    if (parts.is_absolute()) here.clear();
    waiting.insert(waiting.end(), parts.begin(), parts.end());
    std::reverse(waiting.end() - std::distance(parts.begin(), parts.end()),
                 waiting.end());
  };
  push(path);
  for (int links = 0; !waiting.empty() && links <= kMostLinks;) {
    const fs::path next = here / waiting.back();
    waiting.pop_back();
    struct stat status {};
    if (::lstat(next.c_str(), &status) != 0) break;
    if (!S_ISLNK(status.st_mode)) {
      here = next;
      continue;
    }
    struct stat folder {};
    const bool is_known =
        ::stat(here.empty() ? "." : here.c_str(), &folder) == 0;
    if (is_known && is_planted(status, folder)) return next.string();
    std::error_code error;
    push(fs::read_symlink(next, error));
    ++links;
  }
  return std::nullopt;
}

}  // namespace lamina
