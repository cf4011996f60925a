#pragma once
// Waits until a file changes.
//
// Editors write a file in place, or write another one and rename it over the
// first, or delete it and write it anew. All of this shows in the file's
// folder. So folders are watched for files that were closed after writing or
// moved in. One save can be several of these events; a change is reported when
// no more of them have come for a moment.

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "base/file/open_file.h"

namespace lamina::cli {

class FileWatcher {
 public:
  // Throws FileError where the system cannot watch.
  FileWatcher();

  // Watches `files` from now on, and no others. They need not exist yet, but
  // their folders must. A file that is new among them and was written after
  // `since` counts as changed.
  void watch(const std::set<std::string>& files,
             std::filesystem::file_time_type since);

  // Waits for a change. Returns the changed files, by the names given.
  std::set<std::string> wait();

 private:
  void watch_folder_of(const std::filesystem::path& path,
                       const std::string& file);
  // Takes the next events, for which it waits at most so long (negative:
  // endlessly). Returns whether one was of a watched file.
  bool take_events(int milliseconds);

  OpenFile inotify_;
  std::set<std::string> files_;
  std::set<std::string> changed_;
  // From a folder's watch and a name in it to the file by the name given.
  std::map<int, std::map<std::string, std::string>> names_;
};

}  // namespace lamina::cli
