#pragma once
// Which files a run may use, and the one way to them.
//
// A design may come from a stranger. So whatever a design or a command line
// names is looked for and opened here. Under --root that is only what lies in
// that folder, or for reading in one of --allow-read, after all symbolic links.
// What lies outside is not even looked for, so nothing shows whether it exists.
// The file that is opened is the one that was judged: the way to it is walked
// through descriptors (detail/confined_walk.h), so a link put in its place
// meanwhile does not help. Hard links look like files of the folder.
//
// What the program needs for itself (its libraries, /proc, Fontconfig's
// configuration) does not pass here.

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <sys/stat.h>

#include "base/diagnostic.h"
#include "base/file/open_file.h"
#include "base/file/run_files.h"
#include "base/source.h"

namespace lamina {

struct PermittedFolder;
struct Destination;

// A file may not be used.
struct AccessError : Error {
  using Error::Error;
};

// What a design names a file for.
enum class FileUse {
  kCode,  // include, use
  kData,  // import(), surface(), dxf_dim(), dxf_cross(), fonts
};

// Where an output goes.
struct OutputPlace {
  // Through no link any more, and valid as long as `folder`: under --root it
  // begins with that descriptor.
  std::string path;
  OpenFile folder;
  int error = 0;                     // why nothing can stand there (errno)
  std::optional<struct stat> there;  // what does
};

// Throws FileError where `error` (errno) is a fault of the machine and not of
// the name: a disk that fails, no memory, no descriptor left.
void check_machine(const std::string& path, int error);

class FileAccess {
 public:
  // All files that the user of the program may use.
  FileAccess() = default;
  // No file at all.
  static FileAccess none();

  struct Limits {
    std::string root;  // all files are in it; empty: everywhere
    std::vector<std::string> readable;  // with `root`: more, to read only
    bool refuses_data = false;          // FileUse::kData
  };
  // Throws AccessError for what is not a folder.
  static FileAccess within(const Limits& limits);

  // Lets a run know of all files that are opened to be read.
  void report_to(std::shared_ptr<RunFiles> run) { run_ = std::move(run); }
  // Null: nobody wants to know.
  RunFiles* run_files() const { return run_.get(); }

  bool is_confined() const { return folders_ != nullptr; }
  // The descriptors of the folders, the root first; none where nothing is
  // confined. They stay open as long as this.
  std::vector<int> folder_descriptors() const;

  // --- Judging ---------------------------------------------------------------

  // Whether the file may be read, be it there or not.
  bool allows(const std::string& path) const;

  // Throws AccessError at `range` where a design may not read the file that it
  // calls `written`.
  void require(const std::string& path, std::string_view written,
               SourceRange range, FileUse use) const;
  // Throws AccessError where a file of the command line may not be read.
  void require(const std::string& path) const;

  // --- Looking ---------------------------------------------------------------

  // What stands there, behind all links; nothing for what may not be read.
  // Where the machine fails, this and all that follow throw FileError.
  std::optional<struct stat> look_at(const std::string& path) const;
  bool is_there(const std::string& path) const;
  // Something other than a folder.
  bool is_file(const std::string& path) const;
  bool is_regular_file(const std::string& path) const;
  // A symbolic link, to whatever.
  bool is_link(const std::string& path) const;

  // The path without links and dots; empty for what is not there.
  std::string canonical(const std::string& path) const;
  // The path without links and dots as far as it is there, and in words behind
  // that. Links to what is not there are followed, too.
  std::string weakly_canonical(const std::string& path) const;

  // Names of what stands in a folder, in no order, without "." and ".."; no
  // value where it cannot be read (errno says why).
  std::optional<std::vector<std::string>> list(const std::string& folder) const;

  // Whether names that differ in the case of letters are one in that folder.
  bool folds_case(const std::string& folder) const;

  // The parts of a folder that may be read: itself, folders in it, or none.
  std::vector<std::string> readable_parts(const std::string& folder) const;

  // --- Opening ---------------------------------------------------------------

  // Opens a regular file to read it. Where that fails, no file is open and
  // errno says why; it is 0 for what is not a regular file. Never waits.
  OpenFile open(const std::string& path) const;

  // All bytes of a file, or, where nothing is confined, of a stream such as a
  // pipe. errno as above.
  std::optional<std::string> read(const std::string& path) const;

  // All bytes of a regular file; errno as of open(). They are a copy: whoever
  // shortens a mapped file ends the process that reads it.
  std::optional<std::string> read_regular(const std::string& path) const;

  // Says that the run depends on a file, be it opened or not: no output takes
  // its place. Throws FileError where it is an output.
  void note_input(const std::string& path) const;

  // --- Writing ---------------------------------------------------------------

  // Throws AccessError for what may not be written.
  OutputPlace find_output(const std::string& path) const;

  // Makes a folder and those around it, as far as that can be.
  void make_folders(const std::string& path) const;

  // A folder for what has to wait before it is written elsewhere: TMPDIR, or
  // the root.
  std::string scratch_folder() const;

 private:
  using Folders = std::vector<PermittedFolder>;

  Destination find(const std::string& path) const;
  Destination find_in_root(const std::string& path) const;
  OutputPlace find_confined_output(const std::string& path) const;

  std::shared_ptr<const Folders> folders_;  // the root first; null: all
  bool refuses_data_ = false;
  std::shared_ptr<RunFiles> run_;
};

// The default where no other is given.
inline const FileAccess kAllFiles;

// Why a file could not be opened to be read, by errno as open() leaves it.
std::string words_of_open_fault(int error);

}  // namespace lamina
