#pragma once
// The files of a run, known by what they are and not by their names: so that no
// output takes the place of an input or of another output.
//
// Outputs are told before the work begins. Inputs make themselves known as they
// are opened (FileAccess), many of them while the design runs. Whichever comes
// second is the error, and nothing has been written then.

#include <cstdint>
#include <mutex>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include <sys/stat.h>

#include "base/diagnostic.h"

namespace lamina {

class FileAccess;

// Safe to use from several threads.
class RunFiles {
 public:
  // Device and inode: what a file is, whatever it is called.
  using Identity = std::pair<dev_t, ino_t>;

  // Says that the run will write `path`, a file or a folder of files of its
  // own.
  //
  // Throws FileError where that is a file that the run has read, or another
  // output; AccessError where it may not be written.
  void expect_output(std::string path, const FileAccess& access);

  // Throws FileError where the run has read `path`, or a file in that folder:
  // for a run without an end, whose outputs may be made again.
  void require_unread(const std::string& path, const FileAccess& access);

  // Says that the run has opened `path` for reading. Throws FileError where
  // that is one of its outputs.
  void note_input(const std::string& path, const struct stat& status);

  // Says that an output has got its name: where `before` stood stands `now`.
  void note_written(const struct stat* before, const struct stat& now);

  // Where a path leads: equal for two paths that would be one file, be it there
  // or not.
  std::string place_of(const std::string& path, const FileAccess& access);

 private:
  struct Folder {
    std::string path;  // without links; ends with '/'
    bool folds_case = false;
  };

  void expect_place(const std::string& place, const std::string& path);
  // With the mutex held.
  void check_unread(const std::string& path,
                    const std::vector<Identity>& files) const;

  std::mutex mutex_;
  std::set<Identity> inputs_;
  std::set<Identity> outputs_;  // of those that are there
  std::unordered_map<std::string, std::string> places_;  // outputs by place
  std::unordered_map<std::string, Folder> folders_;      // that hold them
};

}  // namespace lamina
