#include "base/file/output_digest.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "base/file/open_file.h"
#include "base/fingerprint.h"

namespace lamina {

std::optional<OutputSize> size_of_output(const std::string& path,
                                         const FileAccess& access) {
  const auto status = access.look_at(path);
  if (!status) return std::nullopt;
  if (S_ISDIR(status->st_mode)) return OutputSize{0, true};
  if (!S_ISREG(status->st_mode)) return std::nullopt;
  return OutputSize{static_cast<std::uint64_t>(status->st_size), false};
}

std::string digest_of_output(const std::string& path,
                             const FileAccess& access) {
  const OutputPlace place = access.find_output(path);
  if (place.error != 0 || !place.there || !S_ISREG(place.there->st_mode)) {
    return "";
  }
  const OpenFile file(
      ::open(place.path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW));
  const auto bytes = file ? file.read_all() : std::nullopt;
  return bytes ? digest(*bytes) : "";
}

}  // namespace lamina
