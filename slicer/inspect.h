#pragma once
// `lamina inspect`: what a .slc file holds and what is wrong with it.

#include <cstdint>
#include <string>

namespace lamina::slicer {

enum class LayerList { kSummary, kAll };

struct Inspection {
  std::string text;  // for the user, ended by '\n'
  std::uint64_t defects = 0;
};

// Reads the file layer by layer. Throws FileError where it is no SLC file or
// breaks off.
//
// min_feature  width below which walls and gaps are told [mm]; 0: none are
Inspection inspect_slc(const std::string& path, LayerList list,
                       double min_feature);

}  // namespace lamina::slicer
