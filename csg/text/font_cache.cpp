#include "csg/text/detail/font_cache.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <new>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fontconfig/fcfreetype.h>
#include <hb-ft.h>
#include <sys/mman.h>
#include FT_TRUETYPE_IDS_H

#include "base/text.h"

namespace lamina::text {
namespace {

namespace fs = std::filesystem;

constexpr const char* kDefaultFont = "Liberation Sans:style=Regular";
constexpr const char* kBundledFonts = "/usr/share/openscad/fonts";
constexpr unsigned kDotsPerInch = 100;

const FcChar8* to_fc(const char* text) {
  return reinterpret_cast<const FcChar8*>(text);
}
const char* from_fc(const FcChar8* text) {
  return reinterpret_cast<const char*>(text);
}

// For lack of memory these libraries leave things undone, and the text would be
// another one.
void require(bool is_done) {
  if (!is_done) throw std::bad_alloc();
}

// --- Fontconfig -------------------------------------------------------------

bool has_family(const FcPattern& pattern, const FcChar8* family) {
  FcChar8* other = nullptr;
  for (int i = 0;
       FcPatternGetString(&pattern, FC_FAMILY, i, &other) == FcResultMatch;
       ++i) {
    if (FcStrCmpIgnoreCase(family, other) == 0) return true;
  }
  return false;
}

// Whether the configuration calls the font `match` as good as the one asked for
// (Liberation Sans for Arial).
bool is_equivalent(const FcPattern& substituted, const FcPattern& match) {
  FcValue value;
  FcValueBinding binding = FcValueBindingWeak;
  for (int i = 0; FcPatternGetWithBinding(&substituted, FC_FAMILY, i, &value,
                                          &binding) == FcResultMatch;
       ++i) {
    if (binding == FcValueBindingWeak) continue;
    if (value.type == FcTypeString && has_family(match, value.u.s)) return true;
  }
  return false;
}

bool is_generic(std::string_view family) {
  constexpr std::string_view kGeneric[] = {"sans",    "sans-serif", "serif",
                                           "mono",    "monospace",  "cursive",
                                           "fantasy", "system-ui"};
  return std::find(std::begin(kGeneric), std::end(kGeneric), family) !=
         std::end(kGeneric);
}

// The warning where Fontconfig took another font than the one asked for.
// OpenSCAD takes it silently.
std::string describe_substitution(const FcPattern& asked,
                                  const FcPattern& substituted,
                                  const FcPattern& match) {
  FcChar8* family = nullptr;
  FcChar8* taken = nullptr;
  if (FcPatternGetString(&asked, FC_FAMILY, 0, &family) != FcResultMatch ||
      FcPatternGetString(&match, FC_FAMILY, 0, &taken) != FcResultMatch ||
      is_generic(from_fc(family)) || is_equivalent(substituted, match)) {
    return "";
  }
  return fmt::format("Font '{}' not found, '{}' is used instead",
                     from_fc(family), from_fc(taken));
}

// Where OpenSCAD looks for fonts, besides the system's.
std::vector<std::string> font_folders() {
  std::vector<std::string> folders = {kBundledFonts};
  if (const char* home = std::getenv("HOME")) {
    folders.push_back(std::string(home) + "/.fonts");
  }
  if (const char* more = std::getenv("OPENSCAD_FONT_PATH")) {
    std::istringstream list(more);
    for (std::string folder; std::getline(list, folder, ':');) {
      folders.push_back(std::move(folder));
    }
  }
  return folders;
}

// Fontconfig crashes where memory runs out within it, so check beforehand that
// there is as much as it takes.
void require_room() {
  constexpr std::size_t kRoom = std::size_t{64} << 20;
  void* const room = ::mmap(nullptr, kRoom, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  require(room != MAP_FAILED);
  ::munmap(room, kRoom);
}

bool parse(FcConfig& config, const char* rules) {
  return FcConfigParseAndLoadFromMemory(&config, to_fc(rules), FcTrue) ==
         FcTrue;
}

// The machine's rules of which font stands for which, and where fonts are,
// without any font yet.
Owned<FcConfig> load_rules() {
  require_room();
  errno = 0;
  Owned<FcConfig> config(FcConfigCreate());
  require(config != nullptr);
  // Fontconfig keeps what it finds for all programs of the user: where files
  // could not be opened, that there are no fonts. It would write to the first
  // of its folders that may be written, and this one takes no files.
  require(parse(*config,
                "<fontconfig><cachedir>/dev/null</cachedir>"
                "</fontconfig>"));
  if (FcConfigParseAndLoad(config.get(), nullptr, FcTrue) != FcTrue) {
    require(
        parse(*config, "<fontconfig><dir>/usr/share/fonts</dir></fontconfig>"));
  }
  require(errno != ENOMEM);
  return config;
}

Owned<FcConfig> load_fonts(const std::vector<std::string>& folders) {
  Owned<FcConfig> config = load_rules();
  for (const std::string& path : folders) {
    std::error_code error;
    const fs::path folder = fs::absolute(path, error);
    if (!fs::is_directory(folder, error)) continue;
    require(FcConfigAppFontAddDir(config.get(), to_fc(folder.c_str())));
  }
  require(FcConfigBuildFonts(config.get()));
  require(errno != ENOMEM);
  return config;
}

// Without the rules of HOME, to which others may be able to write.
Owned<FcConfig> load_confined_rules() {
  FcConfigEnableHome(FcFalse);
  return load_rules();
}

// Looking for all fonts takes longer than many a design, and finds the same for
// each. Fontconfig lets threads share the result.
Owned<FcConfig> shared_config() {
  static std::mutex mutex;
  static std::vector<std::string> known_folders;
  static Owned<FcConfig> config;
  const std::lock_guard lock(mutex);
  std::vector<std::string> folders = font_folders();
  if (!config || folders != known_folders) {
    config = load_fonts(folders);
    known_folders = std::move(folders);
  }
  return Owned<FcConfig>(FcConfigReference(config.get()));
}

// --- FreeType ---------------------------------------------------------------

bool select_charmap(FT_FaceRec& face, int platform, int encoding) {
  for (int i = 0; i < face.num_charmaps; ++i) {
    const FT_CharMap map = face.charmaps[i];
    if (map->platform_id == platform &&
        (encoding < 0 || map->encoding_id == encoding) &&
        FT_Set_Charmap(&face, map) == 0) {
      return true;
    }
  }
  return false;
}

bool select_best_charmap(FT_FaceRec& face) {
  return FT_Select_Charmap(&face, FT_ENCODING_UNICODE) == 0 ||
         select_charmap(face, TT_PLATFORM_MICROSOFT, TT_MS_ID_UNICODE_CS) ||
         select_charmap(face, TT_PLATFORM_ISO, TT_ISO_ID_10646) ||
         select_charmap(face, TT_PLATFORM_APPLE_UNICODE, -1) ||
         select_charmap(face, TT_PLATFORM_MICROSOFT, TT_MS_ID_SYMBOL_CS) ||
         select_charmap(face, TT_PLATFORM_MACINTOSH, TT_MAC_ID_ROMAN) ||
         select_charmap(face, TT_PLATFORM_ISO, TT_ISO_ID_8859_1) ||
         select_charmap(face, TT_PLATFORM_ISO, TT_ISO_ID_7BIT_ASCII);
}

bool has_symbols(FT_FaceRec& face) {
  if (!face.charmap || face.charmap->platform_id != TT_PLATFORM_MICROSOFT ||
      face.charmap->encoding_id != TT_MS_ID_SYMBOL_CS) {
    return false;
  }
  FT_UInt glyph = 0;
  const FT_ULong first = FT_Get_First_Char(&face, &glyph);
  return glyph != 0 && first >= kSymbolPage;
}

// Those that the pattern asks for; malformed ones are passed over.
std::vector<hb_feature_t> read_features(const FcPattern& pattern) {
  std::vector<hb_feature_t> features;
  FcChar8* words = nullptr;
  if (FcPatternGetString(&pattern, FC_FONT_FEATURES, 0, &words) !=
      FcResultMatch) {
    return features;
  }
  std::istringstream list(from_fc(words));
  for (std::string word; std::getline(list, word, ';');) {
    hb_feature_t feature;
    if (hb_feature_from_string(word.c_str(), -1, &feature)) {
      features.push_back(feature);
    }
  }
  return features;
}

}  // namespace

FontCache FontCache::open(const FontFiles& files) {
  FontCache cache(files);
  cache.config_ = files.is_confined() ? load_confined_rules() : shared_config();
  cache.own_fonts_.reset(FcFontSetCreate());
  require(cache.own_fonts_ != nullptr);
  FT_Library library = nullptr;
  require(FT_Init_FreeType(&library) == 0);
  cache.library_.reset(library);
  if (files.is_confined()) cache.add_permitted_folders();
  return cache;
}

void FontCache::add_permitted_folders() {
  std::vector<std::string> folders = font_folders();
  FcStrList* const configured = FcConfigGetFontDirs(config_.get());
  require(configured != nullptr);
  while (const FcChar8* folder = FcStrListNext(configured)) {
    folders.emplace_back(from_fc(folder));
  }
  FcStrListDone(configured);
  std::set<std::string> files;
  for (const std::string& folder : folders) {
    for (std::string& file : files_.files_in(folder)) {
      files.insert(std::move(file));
    }
  }
  for (const std::string& file : files) add_font(file.c_str());
}

// The faces of the file, the named instances of each, and the face that varies
// between them, as FcFreeTypeQueryAll() has them.
bool FontCache::add_font(const char* path) {
  constexpr unsigned kVariable = 0x8000;
  const std::string bytes = files_.read(path);
  const int first = own_fonts_->nfont;
  long faces = 1;
  for (long i = 0; i < faces; ++i) {
    const Owned<FT_FaceRec> face = open_face(bytes, i);
    if (!face) break;
    faces = face->num_faces;
    const auto index = static_cast<unsigned>(i);
    const auto instances = static_cast<unsigned>(face->style_flags >> 16);
    add_pattern(*face, path, index);
    for (unsigned k = 1; k <= instances; ++k) {
      const long instance = i + (static_cast<long>(k) << 16);
      const Owned<FT_FaceRec> named = open_face(bytes, instance);
      if (named) add_pattern(*named, path, index + (k << 16));
    }
    if (FT_HAS_MULTIPLE_MASTERS(face.get())) {
      add_pattern(*face, path, index + (kVariable << 16));
    }
  }
  return own_fonts_->nfont > first;
}

void FontCache::add_pattern(FT_FaceRec& face, const char* path,
                            unsigned index) {
  errno = 0;
  Owned<FcPattern> font(
      FcFreeTypeQueryFace(&face, to_fc(path), index, nullptr));
  require(errno != ENOMEM);
  if (!font) return;
  require(FcConfigSubstitute(config_.get(), font.get(), FcMatchScan) &&
          FcFontSetAdd(own_fonts_.get(), font.get()));
  static_cast<void>(font.release());  // the set has it
}

const Font& FontCache::find(const std::string& name) {
  const auto known = fonts_.find(name);
  if (known != fonts_.end()) return known->second;
  return fonts_.emplace(name, load(name)).first->second;
}

Owned<FcPattern> FontCache::match(FcPattern& pattern) const {
  require(FcPatternAddBool(&pattern, FC_OUTLINE, FcTrue) &&
          FcPatternAddBool(&pattern, FC_SCALABLE, FcTrue) &&
          FcConfigSubstitute(config_.get(), &pattern, FcMatchPattern));
  FcDefaultSubstitute(&pattern);
  FcResult result = FcResultNoMatch;
  FcFontSet* sets[] = {FcConfigGetFonts(config_.get(), FcSetSystem),
                       FcConfigGetFonts(config_.get(), FcSetApplication),
                       own_fonts_.get()};
  Owned<FcPattern> found(FcFontSetMatch(config_.get(), sets,
                                        static_cast<int>(std::size(sets)),
                                        &pattern, &result));
  require(result != FcResultOutOfMemory && errno != ENOMEM);
  return found;
}

std::string FontCache::family_with(
    const std::vector<hb_codepoint_t>& letters) const {
  errno = 0;
  const Owned<FcCharSet> wanted(FcCharSetCreate());
  require(wanted != nullptr);
  for (const hb_codepoint_t letter : letters) {
    require(FcCharSetAddChar(wanted.get(), letter));
  }
  const Owned<FcPattern> pattern(FcPatternCreate());
  require(pattern != nullptr &&
          FcPatternAddCharSet(pattern.get(), FC_CHARSET, wanted.get()) &&
          FcPatternAddBool(pattern.get(), FC_COLOR, FcFalse));
  const Owned<FcPattern> matching = match(*pattern);
  FcCharSet* has = nullptr;
  FcBool is_picture = FcFalse;
  FcChar8* family = nullptr;
  if (!matching ||
      FcPatternGetCharSet(matching.get(), FC_CHARSET, 0, &has) !=
          FcResultMatch ||
      !FcCharSetIsSubset(wanted.get(), has) ||
      (FcPatternGetBool(matching.get(), FC_COLOR, 0, &is_picture) ==
           FcResultMatch &&
       is_picture) ||
      FcPatternGetString(matching.get(), FC_FAMILY, 0, &family) !=
          FcResultMatch) {
    return "";
  }
  return from_fc(family);
}

// Null where the bytes, which must outlive it, hold no such face.
Owned<FT_FaceRec> FontCache::open_face(const std::string& bytes,
                                       long index) const {
  FT_Face face = nullptr;
  const FT_Error fault = FT_New_Memory_Face(
      library_.get(), reinterpret_cast<const FT_Byte*>(bytes.data()),
      static_cast<FT_Long>(bytes.size()), index, &face);
  require(fault != FT_Err_Out_Of_Memory);
  return Owned<FT_FaceRec>(fault == 0 ? face : nullptr);
}

// What Fontconfig makes of a name.
struct FontCache::Match {
  std::string file;  // empty: there is no such font
  int index = 0;
  std::string substitution;  // a warning, or ""
  std::vector<hb_feature_t> features;
};

FontCache::Match FontCache::find_match(const std::string& name) const {
  Match result;
  const std::string wanted(trim(name));
  errno = 0;
  const Owned<FcPattern> pattern(
      FcNameParse(to_fc(wanted.empty() ? kDefaultFont : wanted.c_str())));
  require(errno != ENOMEM);
  if (!pattern) return result;
  const Owned<FcPattern> asked(FcPatternDuplicate(pattern.get()));
  require(asked != nullptr);
  const Owned<FcPattern> matching = match(*pattern);
  FcChar8* file = nullptr;
  if (!matching ||
      FcPatternGetString(matching.get(), FC_FILE, 0, &file) != FcResultMatch ||
      FcPatternGetInteger(matching.get(), FC_INDEX, 0, &result.index) !=
          FcResultMatch) {
    return result;
  }
  result.file = from_fc(file);
  result.substitution = describe_substitution(*asked, *pattern, *matching);
  result.features = read_features(*matching);
  return result;
}

// Among the same fonts a name means the same to all: pieces of a batch ask for
// one font again and again, and to find it takes longer than to set a word.
FontCache::Match FontCache::shared_match(const std::string& name) const {
  if (files_.is_confined() || own_fonts_->nfont > 0) return find_match(name);
  static std::mutex mutex;
  static Owned<FcConfig> config;
  static std::map<std::string, Match> matches;
  const std::lock_guard lock(mutex);
  // cppcheck-suppress mismatchingContainers ; two pointers to one type
  if (config.get() != config_.get()) {
    matches.clear();
    config.reset(FcConfigReference(config_.get()));
  }
  constexpr std::size_t kMost = 1000;
  if (matches.size() > kMost) matches.clear();
  const auto known = matches.find(name);
  if (known != matches.end()) return known->second;
  return matches.emplace(name, find_match(name)).first->second;
}

const Face& FontCache::find_face(const std::string& file, int index) {
  const auto known = faces_.find({file, index});
  if (known != faces_.end()) return known->second;
  auto bytes = bytes_.find(file);
  if (bytes == bytes_.end()) {
    bytes = bytes_.emplace(file, files_.read(file)).first;
  }
  return faces_.emplace(std::pair(file, index), load_face(bytes->second, index))
      .first->second;
}

// The bytes must outlive the face.
Face FontCache::load_face(const std::string& bytes, int index) const {
  Face result;
  result.outlines = open_face(bytes, index);
  FT_Face face = result.outlines.get();
  if (face == nullptr) return result;
  result.has_charmap = select_best_charmap(*face);
  if (FT_Set_Char_Size(face, 0, Face::kSize, kDotsPerInch, kDotsPerInch) != 0) {
    return result;
  }
  result.is_symbol = has_symbols(*face);
  result.shaper.reset(hb_ft_font_create(face, nullptr));
  require(result.shaper.get() != hb_font_get_empty());
  return result;
}

Font FontCache::load(const std::string& name) {
  Font font;
  font.complaint = fmt::format("Can't get font {}", name);
  Match match = shared_match(name);
  if (match.file.empty()) return font;
  const Face& face = find_face(match.file, match.index);
  if (face.outlines == nullptr) return font;
  if (face.shaper == nullptr) {
    font.complaint = fmt::format("Can't set font size for font {}", name);
    return font;
  }
  font.complaint = match.substitution;
  if (!face.has_charmap) {
    const auto words = [](const char* text) { return text ? text : ""; };
    font.complaint = fmt::format("Could not select a char map for font {}/{}'",
                                 words(face.outlines->family_name),
                                 words(face.outlines->style_name));
  }
  font.features = std::move(match.features);
  font.face = &face;
  return font;
}

}  // namespace lamina::text
