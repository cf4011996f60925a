#pragma once
// The mesh that openscad makes of a design that came with it.

#include <filesystem>
#include <string>

#include "csg/scene.h"

namespace lamina::conformance {

enum class ReferenceKind {
  kSolid,
  kOutline,  // a 2D design: the mesh is its outline, extruded from 0 to 1
  kEmpty,    // evaluated well to nothing
};

struct Reference {
  ReferenceKind kind = ReferenceKind::kEmpty;
  csg::Mesh mesh;     // of a solid or an outline
  std::string words;  // openscad's messages
};

// Renders `design`, a file below `root`, from which it may read others.
//
// throws  std::runtime_error where openscad is missing or fails
Reference render_reference(const std::filesystem::path& root,
                           const std::filesystem::path& design);

// The design in a tree of links to all files below `root`, in the cache: there
// files can be put beside those of a tree that is not ours.
std::filesystem::path link_of(const std::filesystem::path& root,
                              const std::filesystem::path& design);

}  // namespace lamina::conformance
