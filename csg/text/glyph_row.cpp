#include "csg/text/detail/glyph_row.h"

#include <cstdint>
#include <iterator>
#include <new>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace lamina::text {
namespace {

constexpr hb_codepoint_t kPageSize = 0x100;

// HarfBuzz reads malformed UTF-8 as a replacement character.
constexpr hb_codepoint_t kReplacement = 0xFFFD;

void move_to_symbol_page(hb_buffer_t* buffer, const std::string& text,
                         std::vector<Message>& messages) {
  unsigned count = 0;
  hb_glyph_info_t* characters = hb_buffer_get_glyph_infos(buffer, &count);
  for (unsigned i = 0; i < count; ++i) {
    hb_codepoint_t& character = characters[i].codepoint;
    if (character == kReplacement) {
      messages.push_back(
          {Severity::kWarning,
           fmt::format("Ignoring text with invalid UTF-8 encoding: \"{}\"",
                       text)});
      hb_buffer_set_length(buffer, 0);
      return;
    }
    if (character < kPageSize) character += kSymbolPage;
  }
}

// A string for C, which ends at its first zero.
std::string to_c(std::string_view text) {
  return std::string(text.substr(0, text.find('\0')));
}

// The letters of a text as they stand in a buffer that is not yet shaped.
std::vector<Letter> letters_of(hb_buffer_t* buffer) {
  unsigned count = 0;
  const hb_glyph_info_t* infos = hb_buffer_get_glyph_infos(buffer, &count);
  std::vector<Letter> letters;
  letters.reserve(count);
  for (unsigned i = 0; i < count; ++i) {
    letters.push_back({infos[i].codepoint, infos[i].cluster});
  }
  return letters;
}

Owned<hb_buffer_t> shape_text(const csg::TextParams& params, const Font& font,
                              std::vector<Letter>& letters,
                              std::vector<Message>& messages) {
  const std::string text = to_c(params.text);
  Owned<hb_buffer_t> owned(hb_buffer_create());
  hb_buffer_t* buffer = owned.get();
  hb_buffer_set_direction(
      buffer, hb_direction_from_string(to_c(params.direction).c_str(), -1));
  hb_buffer_set_script(buffer,
                       hb_script_from_string(to_c(params.script).c_str(), -1));
  hb_buffer_set_language(
      buffer, hb_language_from_string(to_c(params.language).c_str(), -1));
  hb_buffer_add_utf8(buffer, text.c_str(), -1, 0, -1);
  letters = letters_of(buffer);
  if (font.face->is_symbol) move_to_symbol_page(buffer, text, messages);
  if (!hb_shape_full(font.face->shaper.get(), buffer, font.features.data(),
                     static_cast<unsigned>(font.features.size()), nullptr) ||
      !hb_buffer_allocation_successful(buffer)) {
    throw std::bad_alloc();
  }
  return owned;
}

// Null where the font has no such glyph, or only a picture of it.
OwnedGlyph load_glyph(const Font& font, FT_UInt index) {
  FT_Glyph glyph = nullptr;
  FT_Error fault =
      FT_Load_Glyph(font.face->outlines.get(), index, FT_LOAD_DEFAULT);
  if (fault == 0) fault = FT_Get_Glyph(font.face->outlines->glyph, &glyph);
  if (fault == FT_Err_Out_Of_Memory) throw std::bad_alloc();
  if (fault != 0) return nullptr;
  OwnedGlyph owned(glyph);
  return glyph->format == FT_GLYPH_FORMAT_OUTLINE ? std::move(owned) : nullptr;
}

// Variation selectors and the like say how others look.
bool is_drawn(hb_codepoint_t character) {
  constexpr hb_codepoint_t kFirstSelector = 0xFE00;
  constexpr hb_codepoint_t kLastSelector = 0xFE0F;
  return hb_unicode_general_category(hb_unicode_funcs_get_default(),
                                     character) !=
             HB_UNICODE_GENERAL_CATEGORY_FORMAT &&
         !(kFirstSelector <= character && character <= kLastSelector);
}

bool can_draw(const Font& font, hb_codepoint_t character) {
  const bool is_moved = font.face->is_symbol && character < kPageSize;
  hb_codepoint_t glyph = 0;
  return hb_font_get_nominal_glyph(
             font.face->shaper.get(),
             is_moved ? character + kSymbolPage : character, &glyph) &&
         load_glyph(font, glyph);
}

// Letters that the font cannot draw, each once.
//
// clusters  where the letters of a glyph begin, for all glyphs
// torn      where they begin for glyphs that say nothing of their letters
std::vector<Letter> missing_letters(const std::vector<Letter>& letters,
                                    const std::set<std::uint32_t>& clusters,
                                    const std::set<std::uint32_t>& torn,
                                    const Font& font) {
  std::vector<Letter> missing;
  std::set<hb_codepoint_t> seen;
  for (const Letter& letter : letters) {
    const auto next = clusters.upper_bound(letter.at);
    if (next == clusters.begin() || !torn.contains(*std::prev(next))) continue;
    if (seen.insert(letter.code).second && is_drawn(letter.code) &&
        !can_draw(font, letter.code)) {
      missing.push_back(letter);
    }
  }
  return missing;
}

// From the whole numbers of FreeType and HarfBuzz.
Vec2 to_vec(double x, double y) { return Vec2(x, y) / double{Face::kSize}; }

Box box_of(FT_Glyph glyph) {
  FT_BBox box;
  FT_Glyph_Get_CBox(glyph, FT_GLYPH_BBOX_GRIDFIT, &box);
  return {to_vec(static_cast<double>(box.xMin), static_cast<double>(box.yMin)),
          to_vec(static_cast<double>(box.xMax), static_cast<double>(box.yMax))};
}

}  // namespace

GlyphRow shape(const csg::TextParams& params, const Font& font,
               std::vector<Message>& messages) {
  GlyphRow row;
  const Owned<hb_buffer_t> buffer =
      shape_text(params, font, row.letters, messages);
  unsigned count = 0;
  const hb_glyph_info_t* infos =
      hb_buffer_get_glyph_infos(buffer.get(), &count);
  const hb_glyph_position_t* places =
      hb_buffer_get_glyph_positions(buffer.get(), &count);
  row.is_horizontal =
      HB_DIRECTION_IS_HORIZONTAL(hb_buffer_get_direction(buffer.get()));
  std::set<std::uint32_t> clusters;
  std::set<std::uint32_t> torn;
  for (unsigned i = 0; i < count; ++i) {
    Glyph glyph;
    glyph.outline = load_glyph(font, infos[i].codepoint);
    clusters.insert(infos[i].cluster);
    if (infos[i].codepoint == 0 || !glyph.outline) {
      torn.insert(infos[i].cluster);
    }
    if (!glyph.outline) {
      messages.push_back(
          {Severity::kPlain,
           fmt::format("Could not load glyph {} for char at index {} in text "
                       "'{}'",
                       infos[i].codepoint, i, params.text)});
      continue;
    }
    glyph.box = box_of(glyph.outline.get());
    glyph.shift =
        shrink(params.rules) * to_vec(places[i].x_offset, places[i].y_offset);
    glyph.advance = shrink(params.rules) * params.spacing *
                    to_vec(places[i].x_advance, places[i].y_advance);
    row.glyphs.push_back(std::move(glyph));
  }
  if (!torn.empty())
    row.missing = missing_letters(row.letters, clusters, torn, font);
  return row;
}

}  // namespace lamina::text
