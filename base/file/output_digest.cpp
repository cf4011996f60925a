#include "base/file/output_digest.h"

#include <algorithm>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include "base/file/open_file.h"
#include "base/fingerprint.h"

namespace lamina {
namespace {

std::optional<OutputDigest> digest_of_folder(const std::string& path,
                                             const FileAccess& access) {
  auto names = access.list(path);
  if (!names) return std::nullopt;
  std::sort(names->begin(), names->end());
  OutputDigest all;
  std::string list;
  for (const std::string& name : *names) {
    const auto file =
        digest_of_output(fmt::format("{}/{}", path, name), access);
    if (!file) return std::nullopt;
    all.bytes += file->bytes;
    list += fmt::format("{} {}\n", file->digest, name);
  }
  all.digest = digest(list);
  return all;
}

}  // namespace

std::optional<OutputDigest> digest_of_output(const std::string& path,
                                             const FileAccess& access) {
  const OutputPlace place = access.find_output(path);
  if (place.error != 0 || !place.there) return std::nullopt;
  if (S_ISDIR(place.there->st_mode)) return digest_of_folder(path, access);
  if (!S_ISREG(place.there->st_mode)) return std::nullopt;
  const OpenFile file(
      ::open(place.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  const auto bytes = file ? file.read_all() : std::nullopt;
  if (!bytes) return std::nullopt;
  return OutputDigest{bytes->size(), digest(*bytes)};
}

}  // namespace lamina
