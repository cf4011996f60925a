#include "tests/serve/shop/random_offers.h"

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "parser/loader.h"
#include "serve/run/messages.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;
using support::Choices;

template <std::size_t kCount>
auto one_of(const std::array<const char*, kCount>& words, Choices& choices) {
  return std::string(words[choices.below(kCount)]);
}

std::string random_text(std::uint32_t most, Choices& choices) {
  std::string text;
  for (std::uint32_t i = choices.below(most + 1); i > 0; --i) {
    text += one_of<6>({"a", "b", "Z", " ", "é", "1"}, choices);
  }
  return text;
}

// With few decimals, in [-20, 20].
double random_number(Choices& choices) {
  return std::round(choices.between(-200, 200)) / 10;
}

std::string random_range(Choices& choices) {
  const double least = random_number(choices);
  const double greatest = least + std::abs(random_number(choices)) + 1;
  switch (choices.below(3)) {
    case 0:
      return fmt::format("[{}:{}]", least, greatest);
    case 1:
      return fmt::format("[{}]", std::abs(greatest));
    default:
      return fmt::format("[{}:{}:{}]",
                         choices.below(2) == 0 ? std::round(least) : least,
                         one_of<10>({"0.05", "0.1", "0.25", "0.5", "0.75", "1",
                                     "2", "0.3", "0.001", "1.5"},
                                    choices),
                         greatest);
  }
}

std::string random_list(Choices& choices) {
  return one_of<8>({"[1, 2, 5]", "[1:small, 2.5:large]", "[small, large]",
                    "[s:small, l:large]", "[1, two]", "[1, 1, 2]",
                    "[0.1, 0.2, -3]", "[one]"},
                   choices);
}

std::string random_assignment(Choices& choices) {
  switch (choices.below(5)) {
    case 0:
      return choices.below(2) == 0 ? "true;" : "false;";
    case 1:
      return fmt::format(
          "{}; // {}", random_number(choices),
          choices.below(4) == 0 ? random_list(choices) : random_range(choices));
    case 2:
      return fmt::format("{}; {}", random_number(choices),
                         one_of<3>({"", "// 0.25", "// 0"}, choices));
    case 3:
      return fmt::format("\"{}\"; {}", random_text(6, choices),
                         choices.below(2) == 0
                             ? "// " + random_list(choices)
                             : one_of<3>({"", "// 3", "// 8"}, choices));
    default: {
      std::string vector = fmt::format("[{}", random_number(choices));
      for (std::uint32_t i = choices.below(4); i > 0; --i) {
        vector += fmt::format(", {}", random_number(choices));
      }
      return vector + "]; " +
             (choices.below(2) == 0 ? "// " + random_range(choices) : "");
    }
  }
}

// On a limit, on a step, or next to one.
double near_number(const Json& parameter, Choices& choices) {
  if (!parameter.contains("max")) return random_number(choices);
  const double least = parameter["min"].get<double>();
  const double greatest = parameter["max"].get<double>();
  const double step = parameter["step"].get<double>();
  const double steps = std::floor((greatest - least) / step);
  const double count = std::floor(choices.between(-1, steps + 2));
  const double on_step = least + count * step;
  constexpr double kFar = std::numeric_limits<double>::infinity();
  switch (choices.below(8)) {
    case 0:
      return greatest;
    case 1:
      return std::nextafter(choices.below(2) == 0 ? least : greatest, kFar);
    case 2:
      return std::nextafter(choices.below(2) == 0 ? least : greatest, -kFar);
    case 3:
      return on_step + step / 2;
    case 4:
      return on_step + step * 1e-5;
    case 5:
      return std::nextafter(on_step, choices.below(2) == 0 ? kFar : -kFar);
    case 6:  // as a person writes it
      return std::stod(fmt::format("{:.3f}", on_step));
    default:
      return on_step;
  }
}

Json random_value(const Json& parameter, Choices& choices) {
  const Json& own = parameter["initial"];
  switch (choices.below(12)) {
    case 0:
      return own;
    case 1:
      return random_text(9, choices);
    case 2:
      return choices.below(2) == 0;
    case 3:
      return random_number(choices);
    default:
      break;
  }
  if (parameter.contains("options")) {
    const Json& options = parameter["options"];
    return options[choices.below(static_cast<std::uint32_t>(options.size()))]
                  ["value"];
  }
  if (own.is_string()) return random_text(9, choices);
  if (own.is_boolean()) return choices.below(2) == 0;
  if (own.is_number()) return near_number(parameter, choices);
  Json list = Json::array();
  const bool fits = choices.below(8) > 0;
  for (std::size_t i = fits ? own.size() : choices.below(6); i > 0; --i) {
    list.push_back(near_number(parameter, choices));
  }
  return list;
}

ast::Program program_of(const std::string& text, SourceStore& sources,
                        Diagnostics& diagnostics) {
  Loader loader(sources, diagnostics, {});
  return loader.load_text("design.scad", text);
}

}  // namespace

ReadDesign::ReadDesign(const std::string& text)
    : program_(program_of(text, sources_, diagnostics_)) {}

Json ReadDesign::parameters() const { return serve::parameters_of(program_); }

std::string random_design(Choices& choices) {
  std::string design;
  for (std::uint32_t i = 0; i <= choices.below(6); ++i) {
    if (choices.below(4) == 0) design += "/* [Stone] */\n";
    if (choices.below(3) == 0) design += "// what it is\n";
    design += fmt::format("p{} = {}\n", i, random_assignment(choices));
  }
  return design;
}

Json random_values(const Json& parameters, Choices& choices) {
  Json values = Json::object();
  for (const Json& parameter : parameters) {
    if (choices.below(3) > 0) continue;
    values[parameter["name"].get<std::string>()] =
        random_value(parameter, choices);
  }
  if (choices.below(20) == 0) values["q"] = 1;
  return values;
}

}  // namespace lamina::shop
