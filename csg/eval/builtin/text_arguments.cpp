#include "csg/eval/builtin/text_arguments.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "base/letter_case.h"
#include "base/utf8.h"
#include "csg/eval/builtin/conversions.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

// --- Scripts ----------------------------------------------------------------
// The script of a text ("Latn", "Arab"), which `.csg` shows, decides the
// direction of writing.

struct ScriptBlock {
  std::uint32_t first;
  std::uint32_t last;
  std::string_view script;
};

// Letters by the blocks that Unicode gives to scripts, in rising order.
constexpr ScriptBlock kBlocks[] = {
    {0x41, 0x5A, "Latn"},       {0x61, 0x7A, "Latn"},
    {0xAA, 0xAA, "Latn"},       {0xBA, 0xBA, "Latn"},
    {0xC0, 0xD6, "Latn"},       {0xD8, 0xF6, "Latn"},
    {0xF8, 0x2B8, "Latn"},      {0x370, 0x373, "Grek"},
    {0x375, 0x37D, "Grek"},     {0x37F, 0x3FF, "Grek"},
    {0x400, 0x52F, "Cyrl"},     {0x531, 0x58F, "Armn"},
    {0x591, 0x5F4, "Hebr"},     {0x600, 0x604, "Arab"},
    {0x606, 0x60B, "Arab"},     {0x60D, 0x61A, "Arab"},
    {0x61E, 0x61E, "Arab"},     {0x620, 0x63F, "Arab"},
    {0x641, 0x64A, "Arab"},     {0x656, 0x6FF, "Arab"},
    {0x700, 0x74F, "Syrc"},     {0x750, 0x77F, "Arab"},
    {0x780, 0x7BF, "Thaa"},     {0x900, 0x950, "Deva"},
    {0x955, 0x963, "Deva"},     {0x966, 0x97F, "Deva"},
    {0x980, 0x9FF, "Beng"},     {0xA00, 0xA7F, "Guru"},
    {0xA80, 0xAFF, "Gujr"},     {0xB00, 0xB7F, "Orya"},
    {0xB80, 0xBFF, "Taml"},     {0xC00, 0xC7F, "Telu"},
    {0xC80, 0xCFF, "Knda"},     {0xD00, 0xD7F, "Mlym"},
    {0xD80, 0xDFF, "Sinh"},     {0xE01, 0xE3A, "Thai"},
    {0xE40, 0xE5B, "Thai"},     {0xE80, 0xEFF, "Laoo"},
    {0xF00, 0xFFF, "Tibt"},     {0x1000, 0x109F, "Mymr"},
    {0x10A0, 0x10FF, "Geor"},   {0x1100, 0x11FF, "Hang"},
    {0x1200, 0x139F, "Ethi"},   {0x13A0, 0x13FF, "Cher"},
    {0x1780, 0x17FF, "Khmr"},   {0x1800, 0x18AF, "Mong"},
    {0x1E00, 0x1EFF, "Latn"},   {0x1F00, 0x1FFF, "Grek"},
    {0x2C60, 0x2C7F, "Latn"},   {0x2E80, 0x2FD5, "Hani"},
    {0x3005, 0x3007, "Hani"},   {0x3021, 0x3029, "Hani"},
    {0x3041, 0x3096, "Hira"},   {0x30A1, 0x30FA, "Kana"},
    {0x30FD, 0x30FF, "Kana"},   {0x3131, 0x318E, "Hang"},
    {0x3400, 0x4DBF, "Hani"},   {0x4E00, 0x9FFF, "Hani"},
    {0xAC00, 0xD7A3, "Hang"},   {0xF900, 0xFAD9, "Hani"},
    {0xFB00, 0xFB06, "Latn"},   {0xFB1D, 0xFB4F, "Hebr"},
    {0xFB50, 0xFDFF, "Arab"},   {0xFE70, 0xFEFC, "Arab"},
    {0xFF21, 0xFF3A, "Latn"},   {0xFF41, 0xFF5A, "Latn"},
    {0x20000, 0x2FA1D, "Hani"},
};

std::string_view script_of(std::uint32_t c) {
  const auto* block =
      std::upper_bound(std::begin(kBlocks), std::end(kBlocks), c,
                       [](std::uint32_t value, const ScriptBlock& b) {
                         return value < b.first;
                       });
  if (block == std::begin(kBlocks)) return {};
  --block;
  return c <= block->last ? block->script : std::string_view();
}

// Four letters, the first one capital, as in ISO 15924.
std::string normalized(std::string_view asked) {
  std::string tag = lower_case(asked.substr(0, 4));
  tag.resize(4, ' ');
  tag[0] = upper_case(tag[0]);
  return tag;
}

// Returns the ISO 15924 tag: the one asked for, else that of the text's
// characters; empty where these have no script (digits, blanks) or several.
std::string text_script(std::string_view text, std::string_view asked) {
  if (!asked.empty()) return normalized(asked);
  std::string_view script;
  while (!text.empty()) {
    const std::string_view one = script_of(first_code_point(text));
    if (!one.empty()) {
      if (!script.empty() && one != script) return {};
      script = one;
    }
    text.remove_prefix(
        std::min<std::size_t>(utf8_length(text[0]), text.size()));
  }
  return std::string(script);
}

// Returns "ltr", "rtl", "ttb" or "btt": as asked, else by the script.
std::string_view text_direction(std::string_view script,
                                std::string_view asked) {
  constexpr std::string_view kDirections[] = {"ltr", "rtl", "ttb", "btt"};
  for (const std::string_view direction : kDirections) {
    if (!asked.empty() && lower_case(asked[0]) == direction[0]) {
      return direction;
    }
  }
  const bool is_right_to_left = script == "Arab" || script == "Hebr" ||
                                script == "Syrc" || script == "Thaa";
  return is_right_to_left ? "rtl" : "ltr";
}

// --- Arguments --------------------------------------------------------------

// The size without an argument. An em is 100/72 of it.
constexpr double kDefaultSize = 10;
constexpr double kSizePerEm = 0.72;

double read_size(const TextArguments& arguments) {
  const Value& em = arguments.find("em");
  const Value& size = arguments.find("size");
  if (em.is_undef()) return number_or(size, kDefaultSize);
  if (!size.is_undef()) {
    arguments.warn(fmt::format("{}: \"size\" ignored when \"em\" is set",
                               arguments.caller));
  }
  return em.number_or_zero() * kSizePerEm;
}

}  // namespace

void check_types(const TextArguments& arguments) {
  const auto check = [&](std::string_view name, Type expected) {
    const Value& value = arguments.find(name);
    if (value.is_undef() || value.type() == expected) return;
    arguments.warn(fmt::format(
        "{}(..., {}={}) Invalid type: expected {}, found {}", arguments.caller,
        name, to_echo(value), type_name(expected), type_name(value.type())));
  };
  // In the order of OpenSCAD's messages.
  check("size", Type::kNumber);
  check("em", Type::kNumber);
  check("text", Type::kString);
  check("spacing", Type::kNumber);
  for (const char* name :
       {"font", "direction", "language", "script", "halign", "valign"}) {
    check(name, Type::kString);
  }
}

TextParams read_text(const TextArguments& arguments, std::string& script) {
  const auto read = [&](std::string_view name, std::string_view fallback) {
    return string_or(arguments.find(name), fallback);
  };
  const bool is_2021 = arguments.language == Language::k2021;
  TextParams params;
  params.size = read_size(arguments);
  params.text = read("text", "");
  params.spacing = number_or(arguments.find("spacing"), 1);
  params.font = read("font", "");
  script = text_script(params.text, read("script", ""));
  params.script = script;
  params.direction = text_direction(script, read("direction", ""));
  params.language = read("language", "en");
  params.halign = read("halign", is_2021 ? "left" : "default");
  params.valign = read("valign", is_2021 ? "baseline" : "default");
  params.rules = arguments.language;
  return params;
}

}  // namespace lamina::csg
