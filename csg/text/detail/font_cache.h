#pragma once
// Fonts by name: Fontconfig finds the file, FreeType and HarfBuzz read it.
//
// Which file a name means follows OpenSCAD 2021.01, and with the same
// Fontconfig it is the same file: the system's fonts, ~/.fonts, the folders of
// OPENSCAD_FONT_PATH, the fonts that come with OpenSCAD, those that the
// design uses.
//
// Fontconfig gets fonts that a design brings along as bytes, not as files.
// Where a run may not read all files, it gets each font that the run may read
// this way, and only matches them by its rules: it looks into no folder then,
// and neither reads nor writes its caches.
//
// FreeType, too, gets bytes and no path: it would map the file, and the process
// would end where somebody shortens the file meanwhile.

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fontconfig/fontconfig.h>
#include <ft2build.h>
#include <hb.h>
#include FT_FREETYPE_H
#include FT_GLYPH_H

#include "csg/text/detail/engine.h"

namespace lamina::text {

// Characters of the first page of symbol fonts stand at U+F000.
inline constexpr hb_codepoint_t kSymbolPage = 0xF000;

// Frees what the C libraries made.
struct Release {
  void operator()(FcFontSet* set) const { FcFontSetDestroy(set); }
  void operator()(FcConfig* config) const { FcConfigDestroy(config); }
  void operator()(FcCharSet* letters) const { FcCharSetDestroy(letters); }
  void operator()(FcPattern* pattern) const { FcPatternDestroy(pattern); }
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
  void operator()(FT_Face face) const { FT_Done_Face(face); }
  void operator()(FT_Glyph glyph) const { FT_Done_Glyph(glyph); }
  void operator()(hb_font_t* font) const { hb_font_destroy(font); }
  void operator()(hb_buffer_t* buffer) const { hb_buffer_destroy(buffer); }
};
template <typename T>
using Owned = std::unique_ptr<T, Release>;

// One face of a font file, at the size at which outlines are read.
struct Face {
  Owned<FT_FaceRec> outlines;  // null: the file holds no such face
  Owned<hb_font_t> shaper;     // null: there is none of this size
  bool has_charmap = false;
  // Webdings and its like: characters stand at U+F000 and above.
  bool is_symbol = false;

  // In units of 1/64 pixel: so large that hinting does not show. One em is
  // 100/72 of it.
  static constexpr int kSize = 100000;
};

// What a name means.
struct Font {
  const Face* face = nullptr;  // null: there is no such font, or it is broken
  // Asked for by the name: "Amiri:fontfeatures=-liga;+smcp".
  std::vector<hb_feature_t> features;
  std::string complaint;  // a warning to report; "" if none
};

// All caches share what Fontconfig finds, and which font a name means. A cache
// keeps each file and each face once, however many names mean it.
class FontCache {
 public:
  // Loads Fontconfig's configuration; where only some files may be read, also
  // every font among them.
  //
  // files  outlives the cache
  static FontCache open(const FontFiles& files);

  // To be called before the first find(). False if the file holds no font.
  bool add_font(const char* path);

  // The best match for a Fontconfig name ("Liberation Sans:style=Bold").
  const Font& find(const std::string& name);

  // The family of a font that has outlines of all these letters; "": none does.
  std::string family_with(const std::vector<hb_codepoint_t>& letters) const;

 private:
  explicit FontCache(const FontFiles& files) : files_(files) {}

  struct Match;

  Font load(const std::string& name);
  const Face& find_face(const std::string& file, int index);
  Face load_face(const std::string& bytes, int index) const;
  Match find_match(const std::string& name) const;
  Match shared_match(const std::string& name) const;
  void add_permitted_folders();
  void add_pattern(FT_FaceRec& face, const char* path, unsigned index);
  // The best font of outlines; adds to the pattern what Fontconfig's rules say.
  Owned<FcPattern> match(FcPattern& pattern) const;
  Owned<FT_FaceRec> open_face(const std::string& bytes, long index) const;

  const FontFiles& files_;
  Owned<FcConfig> config_;
  Owned<FcFontSet> own_fonts_;  // that Fontconfig was given
  Owned<FT_LibraryRec_> library_;
  std::map<std::string, const std::string> bytes_;  // by file
  // By file and index; must go before their bytes and the library.
  std::map<std::pair<std::string, int>, Face> faces_;
  std::map<std::string, Font> fonts_;  // by name
};

}  // namespace lamina::text
