#pragma once
// Waits until a file changes.
//
// Editors write a file in place, or write another one and rename it over the
// first, or delete it and write it anew. All that shows in the file's folder,
// so folders are watched, for files that were closed after writing or moved in.
// One save can be several of these; a change is reported when nothing more has
// come for a moment.

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace lamina::cli {

class FileWatcher {
 public:
  // Throws FileError where the system cannot watch.
  FileWatcher();
  ~FileWatcher();
  FileWatcher(const FileWatcher&) = delete;
  FileWatcher& operator=(const FileWatcher&) = delete;

  // Watches `files` from now on, and no others. They need not be there yet;
  // their folders do. A file that is new among them and was written after
  // `since` counts as changed.
  void watch(const std::set<std::string>& files,
             std::filesystem::file_time_type since);

  // Waits for a change. Returns the changed files, by the names given.
  std::set<std::string> wait();

 private:
  void watch_folder_of(const std::filesystem::path& path,
                       const std::string& file);
  // Takes events for at most so long; false if none came. Negative: endlessly.
  bool take_events(int milliseconds);

  int inotify_ = -1;
  std::set<std::string> files_;
  std::set<std::string> changed_;
  // Folder and name → the file by the name given.
  std::map<int, std::map<std::string, std::string>> names_;
};

}  // namespace lamina::cli
