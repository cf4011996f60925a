#include "cli/options/user_settings.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <sstream>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/diagnostic.h"
#include "base/similar.h"
#include "base/text.h"
#include "compiler/validate.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {
namespace {

namespace fs = std::filesystem;

// `output` is a format: what is written where -o does not say it.
constexpr std::string_view kOutput = "output";

constexpr std::string_view kPrice = "price";  // of materials

constexpr std::array<std::string_view, 10> kNames = {
    "printer", "material", "metal",       kPrice,       "layer",
    kOutput,   "scale",    "min-feature", "compensate", "fail-on"};

std::string user_folder() {
  if (const char* folder = std::getenv("XDG_CONFIG_HOME");
      folder != nullptr && *folder != '\0') {
    return folder;
  }
  const char* const home = std::getenv("HOME");
  return home == nullptr ? "" : (fs::path(home) / ".config").string();
}

// A profile beside the file of settings is meant, wherever lamina runs.
std::string in_folder_of(const std::string& file, const std::string& value) {
  const bool is_profile =
      value.ends_with(".json") && fs::path(value).is_relative();
  return is_profile ? (fs::path(file).parent_path() / value).string() : value;
}

// No value where the line is empty or a comment.
std::optional<UserSetting> read_line(const std::string& file, unsigned number,
                                     const std::string& line) {
  const std::string_view text =
      trim(std::string_view(line).substr(0, line.find('#')));
  if (text.empty()) return std::nullopt;
  const std::string place = fmt::format("{}:{}", file, number);
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string_view name = trim(text.substr(0, equals));
  const std::string value(trim(text.substr(std::min(equals + 1, text.size()))));
  const auto* const known = std::ranges::find(kNames, name);
  if (known == kNames.end()) {
    const std::string hint = did_you_mean(name, kNames);
    throw FileError(fmt::format(
        "{}: there is no setting '{}'; {}", place, name,
        hint.empty() ? fmt::format("settings are {}", fmt::join(kNames, ", "))
                     : hint));
  }
  if (value.empty()) {
    throw FileError(fmt::format("{}: '{} = VALUE' was expected", place, name));
  }
  return UserSetting{*known, in_folder_of(file, value), place};
}

// What was given for an option; empty where it was not.
std::string given_word(const OptionList& options, std::string_view name) {
  for (const GivenOption& option : options.given()) {
    if (option.name == name && !option.words.empty()) return option.words[0];
  }
  return {};
}

bool makes_layers(const OptionList& options) {
  if (!given_word(options, "--dump").empty()) return false;
  const std::string format = given_word(options, "--export-format");
  const auto choice = slicer::choose_output_format(
      format.empty() ? given_word(options, "-o") : format);
  return !choice.format || slicer::is_of_layers(*choice.format);
}

}  // namespace

std::vector<std::string> settings_files(const std::string& design) {
  std::vector<std::string> files;
  const std::string folder = user_folder();
  if (!folder.empty()) {
    files.push_back((fs::path(folder) / "lamina" / "config").string());
  }
  if (!design.empty()) {
    files.push_back((fs::path(design).parent_path() / "lamina.conf").string());
  }
  return files;
}

std::vector<UserSetting> read_user_settings(
    const std::vector<std::string>& files, const FileAccess& access) {
  std::vector<UserSetting> settings;
  for (const std::string& file : files) {
    const auto text = access.read_regular(file);
    if (!text) continue;
    std::istringstream lines(*text);
    unsigned number = 0;
    for (std::string line; std::getline(lines, line);) {
      if (auto setting = read_line(file, ++number, line)) {
        settings.push_back(std::move(*setting));
      }
    }
  }
  return settings;
}

std::string first_file(const OptionList& options) {
  for (const GivenOption& option : options.given()) {
    if (!option.name.starts_with('-')) return option.words.front();
  }
  return {};
}

void apply_user_settings(const std::vector<UserSetting>& settings,
                         OptionList& options) {
  if (!makes_layers(options)) return;
  const std::string output = given_word(options, "-o");
  const bool says_format = output == "-" || fs::path(output).has_extension();
  // In the order of the alphabet: materials come before their prices.
  std::map<std::string_view, const UserSetting*> last;
  for (const UserSetting& setting : settings) last[setting.name] = &setting;
  for (const auto& [name, setting] : last) {
    if (name == kOutput && says_format) continue;
    if (name == kPrice && given_word(options, "--material").empty() &&
        given_word(options, "--metal").empty()) {
      continue;
    }
    const std::string option =
        name == kOutput ? "--export-format" : fmt::format("--{}", name);
    try {
      options.set_default(option, setting->value);
    } catch (const compiler::RequestError& error) {
      throw FileError(fmt::format("{}: {}", setting->place, error.what()));
    }
  }
}

}  // namespace lamina::cli
