#pragma once
// The outputs that a run has begun and not finished, which no one must see yet.
//
// A file has no name at all until it is whole, where the file system has such
// files (O_TMPFILE): then even a run that is killed leaves nothing. Otherwise,
// and for folders, it has a hidden name beside the target and is locked until
// the run ends: a hidden name whose lock is free is abandoned, and the next run
// that wants it removes what stands there.

#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/file_access.h"

namespace lamina {

// Whether `path` goes through a name that an unfinished output may have.
bool is_hidden_name(std::string_view path);

// The temporary files and folders of a run, so that whoever stops the run can
// remove them. Safe to use from several threads.
class TemporaryFiles {
 public:
  // access  what may be written; outlives them
  explicit TemporaryFiles(const FileAccess& access = kAllFiles)
      : access_(access) {}

  const FileAccess& file_access() const { return access_; }

  // A file on its way to a target.
  struct File {
    int file = -1;     // for reading and writing; −1: none (errno says why)
    std::string name;  // empty: it has none
  };
  // A folder on its way to a target.
  struct Folder {
    std::string path;  // empty: none (errno says why)
    int lock = -1;
    OutputPlace place;  // `path` is valid as long as this
  };

  // Removes them all and forbids new ones and renames from now on: for the
  // thread that ends the process. What another thread keeps busy for more than
  // a second is left to the next run.
  void discard_all();

  // `target` is the path of an OutputPlace.
  File open_file(const std::string& target);
  // Puts the file in the place of `target`, with mode and owner of what stands
  // there as far as that may be. False if it cannot (errno). Either way the
  // file stays open. Throws FileError, which names `path`, where the run has
  // read what it replaces.
  bool commit_file(File& file, const OutputPlace& target,
                   const std::string& path);
  // Closes the file and removes it if it was not committed.
  void discard_file(File& file);

  // Opens a file that never gets a name; −1 if there is no room for it (errno).
  int open_nameless();
  // Bytes of such files for which there was no folder, so that memory holds
  // them. The last known number while another thread is busy here. Called by
  // one thread.
  std::uint64_t bytes_in_memory();

  // A new folder beside `path`, or beside what it links to. Throws AccessError.
  Folder make_folder(const std::string& path);
  // A new file of that folder, for writing; −1 if it cannot be made (errno).
  int open_file_in(const Folder& folder, const std::string& name);
  // Puts the folder in the place of `path`, or of what it links to, and removes
  // what stood there. False if it cannot (errno). Throws FileError where the
  // run has read a file in there.
  bool commit_folder(Folder& folder, const std::string& path);
  void discard_folder(Folder& folder);

 private:
  bool give_name(File& file, const std::string& target);
  bool put_at(File& file, const std::string& target);
  void forget(const std::string& path);

  const FileAccess& access_;
  std::timed_mutex mutex_;
  std::vector<std::string> paths_;  // those that have a name
  std::vector<int> in_memory_;      // files
  std::uint64_t bytes_in_memory_ = 0;
};

}  // namespace lamina
