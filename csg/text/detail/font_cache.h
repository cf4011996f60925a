#pragma once
// Fonts by name: Fontconfig finds the file, FreeType and HarfBuzz read it.
//
// Which file a name means follows OpenSCAD 2021.01, and with the same
// Fontconfig it is the same file: the system's fonts, ~/.fonts, the folders of
// OPENSCAD_FONT_PATH, the fonts that come with OpenSCAD, those that the
// design uses.
//
// Where a run may not read all files, Fontconfig is given the fonts that it may
// read, one by one and as open files, and keeps to its rules of matching. It
// looks into no folder then, and neither reads nor writes its caches.

#include <map>
#include <memory>
#include <string>

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <hb.h>
#include FT_FREETYPE_H

#include "csg/text/detail/engine.h"

namespace lamina::text {

// Frees what the C libraries made.
struct Release {
  void operator()(FcFontSet* set) const { FcFontSetDestroy(set); }
  void operator()(FcConfig* config) const { FcConfigDestroy(config); }
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
  void operator()(FT_Face face) const { FT_Done_Face(face); }
  void operator()(hb_font_t* font) const { hb_font_destroy(font); }
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
template <typename T>
using Owned = std::unique_ptr<T, Release>;

struct Font {
  Owned<FT_FaceRec> face;  // null: there is no such font, or it is broken
  Owned<hb_font_t> shaper;
  // Webdings and its like: characters stand at U+F000 and above.
  bool is_symbol = false;
  std::string complaint;  // what to tell about it, if anything

  // Outlines are read at this size [1/64 pixel], so fine that the
  // hinting of fonts does not show. One em is 100/72 of it.
  static constexpr int kSize = 100000;
};

// Caches share what Fontconfig finds, until a design brings fonts along.
class FontCache {
 public:
  // permitted  null: all fonts; outlives the cache
  explicit FontCache(const FontFiles* permitted);

  // Before the first find(). False if Fontconfig finds no font in the file.
  bool add_font(const char* path);

  // The best match for a Fontconfig name ("Liberation Sans:style=Bold").
  const Font& find(const std::string& name);

 private:
  Font load(const std::string& name) const;
  void add_permitted_folders();
  bool add_permitted(const std::string& path);
  Owned<FcPattern> match(FcPattern& pattern) const;
  FT_Face open_face(const char* path, int index) const;

  const FontFiles* permitted_;
  Owned<FcConfig> config_;
  bool has_own_config_ = false;      // with fonts that no other design sees
  Owned<FcFontSet> fonts_to_match_;  // of permitted_
  Owned<FT_LibraryRec_> library_;
  std::map<std::string, Font> fonts_;  // must go before the library
};

}  // namespace lamina::text
