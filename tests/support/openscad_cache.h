#pragma once
// openscad, asked once for each thing.
//
// A design may take it a minute, so what it wrote is kept outside the source
// and the build tree, and serves as long as the program's version, the fonts on
// the machine, the design's path and text, and the options stay the same. Tests
// run side by side: every answer is a folder that is filled elsewhere and put
// in its place by one rename, so that there is never half of one.

#include <filesystem>
#include <string>
#include <vector>

namespace lamina::support {

enum class OpenScad {
  k2021,  // the installed program, which is 2021.01
  k2026,  // 2025.07.18, the oracle of language 2026 (openscad_2026.mjs)
};

struct OpenScadResult {
  std::string words;  // its messages
  // What it wrote, in the cache: not to be changed. Empty: nothing, for the
  // design is at fault or makes nothing.
  std::filesystem::path output;
};

// Runs openscad on `design` in cache_folder(), from where its messages name
// files.
//
// format   ending of the output: "echo", "stl" …
// options  beside the design and the output
// throws   std::runtime_error where openscad is missing, crashes, is killed or
//          takes minutes; nothing of that is kept
OpenScadResult ask_openscad(const std::filesystem::path& design,
                            const std::string& format,
                            const std::vector<std::string>& options = {},
                            OpenScad program = OpenScad::k2021);

// $LAMINA_TEST_CACHE, else lamina-tests in the user's cache folder; made where
// it is missing.
std::filesystem::path cache_folder();

}  // namespace lamina::support
