#include "base/file/detail/confined_walk.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <climits>
#include <filesystem>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <unistd.h>

#include "base/file/detail/planted_link.h"

namespace lamina {
namespace {

class Walker {
 public:
  explicit Walker(std::span<const PermittedFolder> folders)
      : folders_(folders) {}

  Destination walk(const std::string& path) {
    if (*kernel_path(path) == '\0') return miss("", ENOENT);
    if (path.size() >= PATH_MAX) return miss("", ENAMETOOLONG);
    push(path);
    if (path.front() != '/') {
      std::error_code error;
      push(std::filesystem::current_path(error).string());
      if (error) return miss("", error.value());
    }
    enter();
    while (!waiting_.empty()) {
      const std::string part = std::move(waiting_.back());
      waiting_.pop_back();
      if (part.empty() || part == ".") continue;
      if (folder_ == nullptr) {
        step_outside(part);
      } else if (part == "..") {
        step_up();
      } else if (!step_into(part)) {
        return std::move(result_);
      }
    }
    return arrive_at_folder();
  }

 private:
  // What is walked next.
  void push(const std::string& path) {
    const auto count = static_cast<std::ptrdiff_t>(waiting_.size());
    for (std::size_t i = 0; i <= path.size();) {
      const std::size_t end = std::min(path.find('/', i), path.size());
      waiting_.push_back(path.substr(i, end - i));
      i = end + 1;
    }
    std::reverse(waiting_.begin() + count, waiting_.end());
  }

  // Outside there are words only.
  void step_outside(const std::string& part) {
    if (part != "..") {
      outside_.push_back(part);
    } else if (!outside_.empty()) {
      outside_.pop_back();
    }
    enter();
  }

  // Enters the permitted folder that the words outside name, if they do.
  void enter() {
    for (const PermittedFolder& folder : folders_) {
      if (outside_ != folder.parts && outside_ != folder.given_parts) continue;
      folder_ = &folder;
      return;
    }
  }

  void step_up() {
    if (!names_.empty()) {
      names_.pop_back();
      files_.pop_back();
      return;
    }
    if (folder_->parts.empty()) return;  // nothing is above "/"
    outside_ = folder_->parts;
    folder_ = nullptr;
    step_outside("..");
  }

  int place() const {
    return files_.empty() ? folder_->file.descriptor()
                          : files_.back().descriptor();
  }

  // False where the walk ends; result_ is complete then.
  bool step_into(const std::string& part) {
    OpenFile file(
        ::openat(place(), part.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
    struct stat status {};
    if (!file || ::fstat(file.descriptor(), &status) != 0) {
      result_ = miss(part, errno);
      return false;
    }
    if (S_ISLNK(status.st_mode)) return follow(file, status, part);
    if (S_ISDIR(status.st_mode)) {
      names_.push_back(part);
      files_.push_back(std::move(file));
      return true;
    }
    // Behind a file stands nothing, not even a slash.
    result_ = waiting_.empty() ? arrive_at_file(part, std::move(file), status)
                               : miss(part, ENOTDIR);
    return false;
  }

  bool follow(const OpenFile& link, const struct stat& link_status,
              const std::string& part) {
    std::array<char, PATH_MAX> target{};
    const ssize_t size =
        ::readlinkat(link.descriptor(), "", target.data(), target.size());
    const int error = size < 0 ? errno : ENOENT;
    struct stat folder {};
    if (::fstat(place(), &folder) != 0 || is_planted(link_status, folder)) {
      result_ = miss(part, EACCES);
      return false;
    }
    if (++links_ > kMostLinks || size <= 0) {
      result_ = miss(part, links_ > kMostLinks ? ELOOP : error);
      return false;
    }
    push({target.data(), static_cast<std::size_t>(size)});
    if (target.front() == '/') {
      folder_ = nullptr;
      names_.clear();
      files_.clear();
      outside_.clear();
      enter();
    }
    return true;
  }

  // A copy of the descriptor where a permitted folder keeps its own; none
  // where that fails (errno says why).
  OpenFile take_place() {
    if (files_.empty()) {
      return OpenFile(::fcntl(place(), F_DUPFD_CLOEXEC, 0));
    }
    OpenFile top = std::move(files_.back());
    files_.pop_back();
    return top;
  }

  std::string path_here() const {
    std::vector<std::string> parts;
    if (folder_ != nullptr) parts = folder_->parts;
    parts.insert(parts.end(), names_.begin(), names_.end());
    return join_parts(parts);
  }

  Destination miss(const std::string& part, int error) {
    Destination missing;
    missing.state = Destination::State::kMissing;
    missing.error = error;
    std::filesystem::path path = std::filesystem::path(path_here()) / part;
    std::for_each(waiting_.rbegin(), waiting_.rend(),
                  [&](const std::string& rest) { path /= rest; });
    missing.path = path.lexically_normal().string();
    missing.name = part;
    if (folder_ == nullptr) return missing;
    missing.folder = take_place();
    if (!missing.folder) missing.error = errno;
    missing.has_folder = missing.error == ENOENT && waiting_.empty();
    return missing;
  }

  Destination arrive_at_file(const std::string& part, OpenFile file,
                             const struct stat& status) {
    Destination there;
    there.state = Destination::State::kThere;
    there.error = 0;
    there.path = (std::filesystem::path(path_here()) / part).string();
    there.folder = take_place();
    if (!there.folder) return miss(part, errno);
    there.name = part;
    there.file = std::move(file);
    there.status = status;
    return there;
  }

  Destination arrive_at_folder() {
    Destination there;
    if (folder_ == nullptr) return there;
    there.path = path_here();
    there.file = take_place();
    if (!there.file || ::fstat(there.file.descriptor(), &there.status) != 0) {
      return miss("", errno);
    }
    if (!names_.empty()) {
      there.folder = take_place();
      if (!there.folder) return miss("", errno);
      there.name = names_.back();
    }
    there.state = Destination::State::kThere;
    there.error = 0;
    return there;
  }

  const std::span<const PermittedFolder> folders_;
  std::vector<std::string> waiting_;         // parts to walk, the next one last
  const PermittedFolder* folder_ = nullptr;  // null: outside of all
  std::vector<std::string> outside_;         // parts of the path there
  std::vector<std::string> names_;           // below folder_
  std::vector<OpenFile> files_;              // of names_
  int links_ = 0;
  Destination result_;
};

}  // namespace

std::vector<std::string> parts_of(const std::string& path) {
  std::vector<std::string> parts;
  for (const auto& part : std::filesystem::path(path).lexically_normal()) {
    if (part != "/" && !part.empty() && part != ".") parts.push_back(part);
  }
  return parts;
}

std::string join_parts(std::span<const std::string> parts) {
  std::string path;
  for (const std::string& part : parts) {
    path += '/';
    path += part;
  }
  return path.empty() ? "/" : path;
}

const char* kernel_path(const std::string& path) {
  return path.find('\0') == std::string::npos ? path.c_str() : "";
}

Destination walk(std::span<const PermittedFolder> folders,
                 const std::string& path) {
  return Walker(folders).walk(path);
}

}  // namespace lamina
