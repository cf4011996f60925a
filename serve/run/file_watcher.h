#pragma once
// Waits until files change.
//
// Editors write a file in place, or write another one and rename it over the
// first, or delete it and write it anew. All of this shows in the file's
// folder. So folders are watched for files that were closed after writing or
// moved in. One save can be several of these events.

#include <filesystem>
#include <map>
#include <set>
#include <string>

#include "base/file/open_file.h"

namespace lamina::serve {

class FileWatcher {
 public:
  // The steps of one save are at most so far apart.
  static constexpr int kQuietMilliseconds = 100;

  // The time that a file has which is written from now on, or an earlier one:
  // the times of files come from a clock that ticks seldom.
  static std::filesystem::file_time_type now();

  // Throws FileError where the system cannot watch.
  FileWatcher();

  // Watches `files` from now on, and no others. They need not exist yet, but
  // their folders must. A file that is new among them and was written after
  // `since` counts as changed.
  void watch(const std::set<std::string>& files,
             std::filesystem::file_time_type since);

  // Waits for a change, and then until nothing has changed for
  // kQuietMilliseconds. Returns the changed files, by the names given.
  std::set<std::string> wait();

  // Can be read when something has happened in a folder.
  int descriptor() const { return inotify_.descriptor(); }
  // Takes what has happened, without waiting. Returns whether a watched file is
  // among what has changed since the last take_changes().
  bool look();
  // The changed files, by the names given.
  std::set<std::string> take_changes();

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

}  // namespace lamina::serve
