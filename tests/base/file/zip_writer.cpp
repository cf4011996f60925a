#include "tests/base/file/zip_writer.h"

#include <stdexcept>

#include <minizip/zip.h>

#include "tests/support/temporary_folder.h"

namespace lamina::csg {

std::string make_zip(
    const std::vector<std::pair<std::string, std::string>>& entries) {
  const support::TemporaryFolder folder;
  const std::string path = folder.file("archive.zip");
  const zipFile archive = zipOpen(path.c_str(), APPEND_STATUS_CREATE);
  if (archive == nullptr) throw std::runtime_error("cannot write " + path);
  for (const auto& [name, contents] : entries) {
    const zip_fileinfo info = {};
    zipOpenNewFileInZip(archive, name.c_str(), &info, nullptr, 0, nullptr, 0,
                        nullptr, Z_DEFLATED, Z_DEFAULT_COMPRESSION);
    zipWriteInFileInZip(archive, contents.data(),
                        static_cast<unsigned>(contents.size()));
    zipCloseFileInZip(archive);
  }
  zipClose(archive, nullptr);
  return support::read_file(path);
}

}  // namespace lamina::csg
