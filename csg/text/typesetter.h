#pragma once
// From text() to outlines, vertex for vertex those of OpenSCAD 2021.01.
//
// The font libraries stand behind a module that the first text opens
// (detail/engine.h): a design without text pays nothing for them.

#include <memory>
#include <string>
#include <vector>

#include "csg/tree.h"
#include "csg/vec.h"
#include "parser/diagnostic.h"

namespace lamina::text {

// Where the program's modules lie: beside it, or in ../lib/lamina where it is
// installed.
std::vector<std::string> module_folders();

class Engine;

class Typesetter {
 public:
  // folders  where the module is looked for, in this order
  explicit Typesetter(std::vector<std::string> folders);
  ~Typesetter();
  Typesetter(const Typesetter&) = delete;
  Typesetter& operator=(const Typesetter&) = delete;

  // Fonts that the design brings along (`use <x.ttf>`), before the first text.
  void add_fonts(const std::vector<std::string>& files);

  // The polygons of a text; inside is where they wind other than 0 times.
  //
  // segments     into which a curve is cut
  // diagnostics  gets unknown alignments, fonts that are missing or broken
  // throws       GeometryError where the module is missing
  std::vector<std::vector<Vec2>> outline(const csg::TextParams& params,
                                         int segments, SourceRange range,
                                         Diagnostics& diagnostics);

 private:
  void open_engine(SourceRange range, Diagnostics& diagnostics);

  std::vector<std::string> folders_;
  std::vector<std::string> font_files_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace lamina::text
