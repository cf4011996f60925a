#pragma once
// What openscad makes of a design that came with it.
//
// Rendering takes up to a minute a design, so what came out is kept in a folder
// outside the source and the build tree and used again as long as openscad and
// the design's file stay the same.

#include <filesystem>
#include <string>

#include "csg/scene.h"

namespace lamina::oracle {

enum class ReferenceKind {
  kSolid,
  kOutline,  // a 2D design: the mesh is its outline, extruded from 0 to 1
  kEmpty,    // evaluated well to nothing
  kFailed,   // openscad ended with another error
  kTooSlow,  // stopped after kRenderSeconds
};

constexpr int kRenderSeconds = 60;  // processor seconds

struct Reference {
  ReferenceKind kind = ReferenceKind::kFailed;
  csg::Mesh mesh;     // of a solid or an outline
  std::string words;  // openscad's last ones where there is no mesh
};

// Renders `design`, a file below `root`, from which it may read others.
//
// throws  std::runtime_error where openscad is missing
Reference render_reference(const std::filesystem::path& root,
                           const std::filesystem::path& design);

// $LAMINA_TEST_CACHE, else lamina-tests in the user's cache folder.
std::filesystem::path reference_cache();

}  // namespace lamina::oracle
