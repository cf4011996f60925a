#pragma once
// FreeCAD files (.FCStd) as CSG trees.
//
// FreeCAD keeps both how a part is made and what came of it: features with
// their parameters, and the boundary representation of each feature's result.
// Here features become nodes of the CSG tree where these say the same and most
// parts have them: whole primitives, prisms and bodies of revolution over
// sketches of lines and circles, Booleans, placements. All else (holes,
// patterns, fillets, splines, imported shapes) is a node that imports the
// feature's stored boundary, which lowering reads. A body that ends with a
// fillet thus is one boundary, one with a pocket after it that boundary less a
// prism. docs/decisions/0048 has what was measured.
//
// Positions are as FreeCAD computed and stored them: neither constraints nor
// expressions are solved anew.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/arena.h"
#include "base/source.h"
#include "csg/tree.h"

namespace lamina::csg {

struct FreecadOptions {
  std::string_view path;  // of the file; must live as long as the nodes
  // One object, by name or label, in the frame of what holds it. Not given:
  // all that is shown and that no other object is made of.
  std::optional<std::string_view> part = std::nullopt;
  // Greatest distance of facets from what they stand for, in the file's own
  // millimetres.
  double chordal_error = 0.01;
  std::size_t most_leaves = 10'000'000;
  SourceRange range = {};            // of the nodes
  const CallSite* caller = nullptr;  // likewise
  // The `.csg` text of a node that imports the boundary of the object of this
  // name in the file at `path`.
  std::function<std::string(std::string_view path, std::string_view name)>
      boundary_text;
  // The path of `file`, which the file at `from` links to: one for each file;
  // it must live as long as the nodes.
  std::function<std::string_view(std::string_view from, std::string_view file)>
      find_linked = {};
  // The bytes of the file at such a path; nothing where there is none.
  std::function<std::optional<std::string>(std::string_view path)> read_linked =
      {};
};

struct FreecadModel {
  std::vector<const Node*> nodes;
  std::size_t leaves = 0;
  // On what is shown and left out all the same.
  std::vector<std::string> warnings;
  // On what is hidden, encloses nothing, or is taken by its boundary.
  std::vector<std::string> notes;
};

// A part as freecad_parts() lists it.
struct FreecadPart {
  std::string name;   // for FreecadOptions::part; so is the label
  std::string label;  // what the user calls it
  std::string type;   // "Part::Box"
  bool is_visible = true;
};

// What FreecadOptions::part may name: all objects with a solid or a group of
// such, in the order of the file.
//
// throws  FormatError; LimitExceeded
std::vector<FreecadPart> freecad_parts(std::string_view bytes);

// Reads the file, and those that it links to, and makes nodes, in the arena.
//
// throws  FormatError where the file is broken, an object is made from itself,
//         or there is no such part; LimitExceeded
FreecadModel read_freecad(std::string_view bytes, const FreecadOptions& options,
                          Arena& arena);

}  // namespace lamina::csg
