#pragma once
// Files of a design: the main file, what it includes, what it uses.
//
// A name in `include <…>` or `use <…>` is looked up in the folder of the file
// that names it, then in the library folders. A missing file is a warning.
// Every used file is parsed once, right after the main file, in OpenSCAD's
// order: all messages of the parser precede those of the evaluator. A syntax
// error in a used file leaves its names unknown; one in the main file or what
// that includes ends the run.

#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/source.h"
#include "parser/ast.h"

namespace lamina {

// Where OpenSCAD looks for libraries: in the folders of OPENSCADPATH, the
// user's and the installed one. An empty name is the folder in which the
// program runs.
std::vector<std::string> library_folders(const FileAccess& access = kAllFiles);

class Loader {
 public:
  // sources          owns all texts; outlives the programs
  // folders          library folders, in the order in which they are searched
  // definitions      what `-D` appends to the main file and to each used file,
  //                  as text ("x=1;\ny=2;\n")
  // access           what may be read; outlives the loader
  Loader(SourceStore& sources, Diagnostics& diagnostics,
         std::vector<std::string> folders, std::string definitions = {},
         const FileAccess& access = kAllFiles);

  // Whose words the parser's messages have, where that is known before it is
  // done: 2021.01's else.
  void set_language(Language language) { language_ = language; }
  Language language() const { return language_; }

  // What follows the text of the design to come, before the definitions.
  void append(std::string text) { appended_ = std::move(text); }

  // Reads and parses a design, its includes and all files that it uses.
  // Throws FileError if it cannot be read, AccessError where it or a file that
  // it names may not be, SyntaxError if it has errors (they are already
  // reported then; the others are not).
  ast::Program load(const std::string& path);

  // Parses a text at hand, and the rest as load(). `path` is what messages show
  // and relative names are resolved against; no file needs to be there.
  //
  // is_implied  whether nobody wrote the text: it imports the file at `path`
  ast::Program load_text(const std::string& path, std::string text,
                         bool is_implied = false);

  // The program behind an entry of Program::uses; null where the file is
  // missing or has syntax errors. Valid as long as the Loader lives; two
  // entries that name one file have one program.
  const ast::Program* used_program(const ast::Use& use) const;

  // The program and all that it uses, directly or not, each once: first itself,
  // then file by file with what that uses.
  std::vector<const ast::Program*> with_used(const ast::Program& program) const;

  // Fonts that the design and the files that it uses bring along
  // (`use <….ttf>`), in the order in which they were read; files that exist.
  const std::vector<std::string>& fonts() const { return fonts_; }

  // What the design depends on so far: the main file by the name given to
  // load(), then all files that `include` and `use` found, absolute, in the
  // order in which they were found, each once.
  const std::vector<std::string>& files() const { return files_; }

  // Where a file would have been found that `include` or `use` names, beside
  // the file that names it, and was not; absolute, each once.
  const std::vector<std::string>& missing() const { return missing_; }

  // The first place in the design, or in a file that it uses, that OpenSCAD
  // 2021.01 cannot parse, if there is one.
  const std::optional<NewerSyntax>& newer_syntax() const { return newer_; }

  const FileAccess& file_access() const { return access_; }

  // For the parser. Absolute path of the file that `name` means at `place`;
  // empty if there is none, or if it is one of the files in `open` (a cycle). A
  // file that is found is one of files() from then on. Throws AccessError.
  std::string find(SourceRange place, std::string_view name,
                   std::span<const Source* const> open);

  // For the parser. The text of a file that `find` found; null if it cannot
  // be read. A file included twice is read once.
  const Source* open_include(const std::string& path);

 private:
  void load_uses(const ast::Program& program);
  ast::Program parse_file(const std::string& path, std::string text,
                          const Source* user, bool is_implied = false);
  std::optional<ast::Program> load_used(const std::string& path,
                                        const Source& user);
  std::string look_up(SourceRange place, std::string_view name,
                      std::span<const Source* const> open) const;
  void add_file(const std::string& path);
  void add_missing(const std::string& path);
  std::optional<std::string> read(const std::string& path) const;
  // The design itself may come from standard input ("-") or a pipe.
  std::optional<std::string> read_design(const std::string& path) const;

  SourceStore& sources_;
  Diagnostics& diagnostics_;
  std::vector<std::string> folders_;
  std::string definitions_;
  std::string appended_;
  const FileAccess& access_;
  Language language_ = Language::k2021;
  std::vector<std::string> files_;
  std::vector<std::string> missing_;
  std::vector<std::string> fonts_;
  std::optional<NewerSyntax> newer_;
  std::map<std::string, const Source*, std::less<>> included_;
  // Empty where parsing failed.
  std::map<std::string, std::optional<ast::Program>, std::less<>> used_;
};

}  // namespace lamina
