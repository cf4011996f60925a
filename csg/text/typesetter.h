#pragma once
// Sets text() as outlines, vertex for vertex those of OpenSCAD 2021.01.
//
// The font libraries stand behind a module that the first text opens
// (detail/engine.h): a design without text pays nothing for them.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "base/file/module.h"
#include "base/vec.h"
#include "csg/text_measurer.h"
#include "csg/tree.h"

namespace lamina::text {

// The module that holds the font libraries.
inline constexpr Module kModule{"lamina_text.so", "lamina_make_text_engine",
                                "text()", ""};

// Into how many chords a curve is cut.
struct Chords {
  int count = 1;
  // Greatest distance of a chord from its curve [mm]; 0: `count` decides.
  double error = 0;
};

class Engine;
struct Typeset;
class ReadableFonts;

class Typesetter : public csg::TextMeasurer {
 public:
  // folders      where to look for the module, in this order
  // diagnostics  gets the faults of fonts that the design brings along;
  //              outlives the typesetter
  // access       says which fonts may be read; outlives it, too
  Typesetter(std::vector<std::string> folders, Diagnostics& diagnostics,
             const FileAccess& access = kAllFiles);
  ~Typesetter() override;
  Typesetter(const Typesetter&) = delete;
  Typesetter& operator=(const Typesetter&) = delete;

  // Adds fonts that the design brings along (`use <x.ttf>`); to be called
  // before the first text.
  void add_fonts(const std::vector<std::string>& files);

  // The files of fonts that were read so far.
  const std::vector<std::string>& files_read() const;

  // The polygons of a text; inside is where they wind other than 0 times.
  //
  // diagnostics  gets unknown alignments, fonts that are missing or broken
  // throws       GeometryError where the module is missing
  std::vector<std::vector<Vec2>> outline(const csg::TextParams& params,
                                         const Chords& chords,
                                         SourceRange range,
                                         Diagnostics& diagnostics);

  std::optional<csg::TextMetrics> measure_text(
      const csg::TextParams& params,
      std::vector<std::string>& warnings) override;
  std::optional<csg::FontMetrics> measure_font(
      const csg::TextParams& params,
      std::vector<std::string>& warnings) override;

 private:
  Engine& engine();
  const Typeset& checked(const Typeset* typeset) const;

  std::vector<std::string> folders_;
  Diagnostics& diagnostics_;
  std::vector<std::string> font_files_;
  std::unique_ptr<const ReadableFonts> readable_fonts_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace lamina::text
