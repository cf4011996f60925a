#include "compiler/tasks/stones.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <initializer_list>
#include <string_view>

#include "base/text.h"

namespace lamina::compiler {
namespace {

constexpr double kCaratsPerCube = 0.6 * 0.0061;  // of a diameter in mm

// Words of a name or a text, in small letters: "stoneDiameter", "stone_d" and
// "Stone d" have two.
std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> words;
  char before = ' ';
  for (const char c : text) {
    const auto letter = static_cast<unsigned char>(c);
    const bool begins = std::isalpha(static_cast<unsigned char>(before)) == 0 ||
                        (std::isupper(letter) != 0 &&
                         std::islower(static_cast<unsigned char>(before)) != 0);
    before = c;
    if (std::isalpha(letter) == 0) continue;
    if (begins) words.emplace_back();
    words.back() += static_cast<char>(std::tolower(letter));
  }
  return words;
}

bool has_word(std::string_view text,
              std::initializer_list<std::string_view> wanted) {
  return std::ranges::any_of(words_of(text), [&](std::string_view word) {
    return std::ranges::any_of(wanted, [&](std::string_view one) {
      return word == one || (word.starts_with(one) && word.ends_with('s') &&
                             word.size() == one.size() + 1);
    });
  });
}

bool names_stone(std::string_view text) {
  return has_word(
      text, {"stone", "gem", "gemstone", "diamond", "brilliant", "carat"});
}

bool is_about_stones(const CustomizerEntry& entry) {
  const std::string& words = entry.comment.description;
  return names_stone(entry.name) || names_stone(entry.comment.group) ||
         (names_stone(words) && has_word(words, {"diameter", "carat"}));
}

bool begins_with(std::string_view text, std::string_view word) {
  const std::vector<std::string> words = words_of(text);
  return !words.empty() && words.front() == word;
}

bool is_diameter(const CustomizerEntry& entry) {
  return has_word(entry.name, {"diameter"}) || entry.name.ends_with("_d") ||
         begins_with(entry.comment.description, "diameter");
}

bool is_weight(const CustomizerEntry& entry) {
  const std::string& words = entry.comment.description;
  return has_word(entry.name, {"carat"}) ||
         (begins_with(words, "weight") && has_word(words, {"carat"}));
}

StoneParameter read_stone(const CustomizerEntry& entry) {
  StoneParameter stone = {entry};
  const std::optional<double> number = parse_number(entry.value);
  if (!number || !(*number > 0)) return stone;
  if (is_diameter(entry)) {
    stone.diameter = number;
    stone.carats = brilliant_carats(*number);
  } else if (is_weight(entry)) {
    stone.carats = number;
    stone.diameter = brilliant_diameter(*number);
  }
  return stone;
}

}  // namespace

std::vector<StoneParameter> find_stones(
    std::span<const CustomizerEntry> parameters) {
  std::vector<StoneParameter> stones;
  for (const CustomizerEntry& entry : parameters) {
    if (is_about_stones(entry)) stones.push_back(read_stone(entry));
  }
  return stones;
}

double brilliant_carats(double diameter) {
  return kCaratsPerCube * diameter * diameter * diameter;
}

double brilliant_diameter(double carats) {
  return std::cbrt(carats / kCaratsPerCube);
}

}  // namespace lamina::compiler
