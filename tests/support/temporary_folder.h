#pragma once
// A folder of a test's own, removed at its end, and whole files as strings.

#include <filesystem>
#include <string>

namespace lamina::support {

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::filesystem::path& parent =
                               std::filesystem::temp_directory_path());
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  std::string path() const { return path_.string(); }
  std::string file(const std::string& name) const {
    return (path_ / name).string();
  }
  // Writes a file into the folder and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const;
  // Number of entries, hidden ones included.
  std::size_t entry_count() const;

 private:
  std::filesystem::path path_;
};

// All bytes of a file; throws where it cannot be read.
std::string read_file(const std::string& path);

}  // namespace lamina::support
