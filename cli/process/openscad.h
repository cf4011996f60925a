#pragma once
// Asks the openscad that is installed here for its mesh of a design.

#include <string>
#include <string_view>

#include "base/file/temporary_files.h"
#include "compiler/request.h"

namespace lamina::cli {

// A folder for another program's output, removed with all that it holds.
class ScratchFolder {
 public:
  // Throws FileError if it cannot be made.
  explicit ScratchFolder(TemporaryFiles& temporary_files);
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  ~ScratchFolder();

  std::string file(const std::string& name) const {
    return folder_.path + "/" + name;
  }

 private:
  TemporaryFiles& temporary_files_;
  TemporaryFiles::Folder folder_;
};

// "OpenSCAD version 2021.01". Throws FileError where the program is missing.
std::string openscad_version(TemporaryFiles& temporary_files);

// The language (of --language) that a version reads.
std::string language_of(std::string_view version);

struct OpenScadMesh {
  std::string path;    // of the binary STL, in the folder
  double seconds = 0;  // that it took, by the clock
};

// request     design, definitions and parameter set are passed on
// time_limit  after which it is ended [s]
// throws      FileError where the program is missing, takes longer, or makes no
//             mesh; with its last words
OpenScadMesh render_with_openscad(const compiler::Request& request,
                                  double time_limit,
                                  const ScratchFolder& folder);

}  // namespace lamina::cli
