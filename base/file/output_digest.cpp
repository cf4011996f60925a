#include "base/file/output_digest.h"

#include <algorithm>
#include <cstddef>
#include <string_view>
#include <utility>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "base/fingerprint.h"

namespace lamina {
namespace {

std::optional<OutputDigest> digest_of_folder(const std::string& path,
                                             const FileAccess& access,
                                             std::uint64_t most_bytes) {
  auto names = access.list(path);
  if (!names) return std::nullopt;
  std::sort(names->begin(), names->end());
  OutputDigest all;
  std::string list;
  for (const std::string& name : *names) {
    const auto file = digest_of_output(fmt::format("{}/{}", path, name), access,
                                       most_bytes - all.bytes);
    if (!file) return std::nullopt;
    all.bytes += file->bytes;
    list += fmt::format("{} {}\n", file->digest, name);
  }
  all.digest = digest(list);
  return all;
}

}  // namespace

std::optional<OutputDigest> digest_of_output(const std::string& path,
                                             const FileAccess& access,
                                             std::uint64_t most_bytes) {
  const OutputPlace place = access.find_output(path);
  if (place.error != 0 || !place.there) return std::nullopt;
  if (S_ISDIR(place.there->st_mode)) {
    return digest_of_folder(path, access, most_bytes);
  }
  const bool is_read = S_ISREG(place.there->st_mode) &&
                       std::cmp_less_equal(place.there->st_size, most_bytes);
  if (!is_read) return std::nullopt;
  const OpenFile file(
      ::open(place.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  return file ? digest_of_file(file) : std::nullopt;
}

std::optional<OutputDigest> digest_of_file(const OpenFile& file) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  struct stat before {};
  if (::fstat(file.descriptor(), &before) != 0) return std::nullopt;
  OutputDigest made;
  std::optional<std::string> block;
  made.digest = digest([&]() -> std::string_view {
    // A byte more than there should be left shows whether the file grows.
    const auto left = static_cast<std::uint64_t>(before.st_size) - made.bytes;
    block = file.read_at(made.bytes, std::min<std::uint64_t>(kBlock, left + 1));
    if (!block) return {};
    made.bytes += block->size();
    return *block;
  });
  const bool is_whole = block && file.is_unchanged_since(before) &&
                        std::cmp_equal(made.bytes, before.st_size);
  return is_whole ? std::optional(std::move(made)) : std::nullopt;
}

bool has_changed_since(std::chrono::steady_clock::time_point begin,
                       const std::string& path, const FileAccess& access) {
  const auto status = access.look_at(path);
  if (!status) return false;
  const auto ago = std::chrono::steady_clock::now() - begin;
  const auto at = std::chrono::system_clock::now() - ago;
  const std::chrono::nanoseconds changed =
      std::chrono::seconds(status->st_ctim.tv_sec) +
      std::chrono::nanoseconds(status->st_ctim.tv_nsec);
  return changed > at.time_since_epoch();
}

}  // namespace lamina
