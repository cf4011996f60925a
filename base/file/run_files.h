#pragma once
// The files of a run, known by what they are and not by their names: so that no
// output takes the place of an input or of another output.
//
// Outputs are announced before the work begins, inputs as they are opened
// (FileAccess), many of them while the design runs. Whichever comes second is
// the error. What the run has read it does not write after that: the outputs
// ask once more when they are written.

#include <cstdint>
#include <mutex>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include <sys/stat.h>

#include "base/diagnostic.h"
#include "base/fingerprint.h"

namespace lamina {

class FileAccess;

// Safe to use from several threads.
class RunFiles {
 public:
  // Says that the run will write `path`, a file, a folder of files of its own,
  // or, as "-", standard output, whatever file that is.
  //
  // Throws FileError where that is a file that the run has read or another
  // output, where one of two outputs would lie inside of the other, and for
  // names that are kept for unfinished outputs; AccessError where it may not be
  // written.
  void expect_output(std::string path, const FileAccess& access);

  // Announces one of so many outputs that only a fingerprint of each is kept.
  // Returns false where another of them has the same one: it is the same file,
  // or, once in many runs, it is not.
  bool expect_one_of_many(const std::string& path, const FileAccess& access);
  // Announces one of many that another run makes beside this one: only its name
  // counts.
  bool expect_of_another_run(const std::string& path, const FileAccess& access);

  // Says that an output at `path` is written in place: what is `there` or has
  // just been made. Throws FileError where the run has read that.
  void expect_files(const std::string& path,
                    const std::optional<struct stat>& there,
                    const FileAccess& access);

  // Says that the many are complete: their names are compared no more.
  void end_of_many();

  // Throws FileError where the run has read what an output is about to replace.
  // Returns that for note_written().
  //
  // there  what stands at `path`
  std::vector<std::uint64_t> require_unread(
      const std::string& path, const std::optional<struct stat>& there,
      const FileAccess& access);

  // Says that the run has opened `path` for reading. Throws FileError where
  // that is one of its outputs. That output is not written any more, but where
  // strangers name inputs (--root): else they could keep others' from being
  // written.
  void note_input(const std::string& path, const struct stat& status,
                  const FileAccess& access);
  bool is_input(const struct stat& status);
  // Says that all inputs are about to be read once more. The outputs of
  // expect_output() are what stands at their places by now.
  void begin_again(const FileAccess& access);

  // Says that an output has got its name: where the files `before` stood
  // stands `now`, or what is in that folder.
  void note_written(const std::vector<std::uint64_t>& before,
                    const std::string& path, const struct stat& now,
                    const FileAccess& access);

  // Where a path leads: equal for two paths that would be one file, be it there
  // or not.
  std::string place_of(const std::string& path, const FileAccess& access);

 private:
  struct Folder {
    std::string path;  // without links; ends with '/'
    bool folds_case = false;
  };

  std::string place_of(const std::string& path, bool is_there,
                       const FileAccess& access);
  void expect_standard_output(const FileAccess& access);
  void expect_place(const std::string& place, const std::string& path);
  // With the mutex held.
  void check_unread(const std::string& path,
                    const std::vector<std::uint64_t>& files) const;
  // Keeps the folders around the place from being outputs, too.
  void claim_place(const std::string& place, const std::string& path);

  std::mutex mutex_;
  // Fingerprints of device and inode: of what a file is, whatever it is called.
  FingerprintSet inputs_;
  FingerprintSet outputs_;  // of those that are there
  std::unordered_map<std::string, std::string> places_;  // outputs by place
  FingerprintSet many_places_;                           // of the many
  FingerprintSet around_;  // the folders around all of these, up to the root
  std::unordered_map<std::string, Folder> folders_;  // that hold them
};

}  // namespace lamina
