#include "slicer/machine/detail/profile.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

#include "base/diagnostic.h"
#include "base/similar.h"
#include "base/text.h"

namespace lamina::slicer::detail {
namespace {

using Json = nlohmann::json;

// Names that a message lists, at most.
constexpr std::size_t kMostListed = 6;

// A known profile and what it is called, its name first.
struct Known {
  Json json;
  std::vector<std::string> names;

  bool is_called(const std::string& name) const {
    return std::ranges::any_of(
        names, [&](const std::string& own) { return is_same_name(own, name); });
  }
  bool has_words_of(const std::string& name) const {
    return has_words(fmt::format("{}", fmt::join(names, " ")), name);
  }
};

std::vector<Known> read_known(std::span<const std::string_view> texts) {
  std::vector<Known> all;
  for (const std::string_view text : texts) {
    Json json = Json::parse(text);
    std::vector<std::string> names = read_lines(json, "also");
    names.insert(names.begin(),
                 {read_line(json, "name"), read_line(json, "title")});
    all.push_back({std::move(json), std::move(names)});
  }
  return all;
}

// "it could be elegoo-mars-4, elegoo-mars-4-dlp or …"
std::string several_text(std::string_view kind, const std::string& name,
                         const std::vector<const Known*>& found) {
  std::string text = "it could be ";
  const std::size_t count = std::min(found.size(), kMostListed);
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_last = i + 1 == found.size();
    text += fmt::format("{}{}",
                        i == 0    ? ""
                        : is_last ? " or "
                                  : ", ",
                        found[i]->names[0]);
  }
  if (count == found.size()) return text;
  return text + fmt::format(" or {} more ('lamina {}s {}' lists them)",
                            found.size() - count, kind, name);
}

}  // namespace

void require_members(const Json& json,
                     std::initializer_list<std::string_view> known) {
  for (const auto& [member, value] : json.items()) {
    if (std::ranges::find(known, member) != known.end()) continue;
    const std::string hint = did_you_mean(member, {known.begin(), known.end()});
    throw std::runtime_error(fmt::format("there is no member '{}'{}{}", member,
                                         hint.empty() ? "" : "; ", hint));
  }
}

std::string read_line(const Json& json, const char* member,
                      std::optional<std::string> otherwise) {
  if (otherwise && !json.contains(member)) return *std::move(otherwise);
  return on_one_line(json.at(member).get<std::string>());
}

std::vector<std::string> read_lines(const Json& json, const char* member) {
  std::vector<std::string> lines;
  if (!json.contains(member)) return lines;
  for (const Json& text : json.at(member)) {
    lines.push_back(on_one_line(text.get<std::string>()));
  }
  return lines;
}

double read_number(const Json& json, const char* member, double least,
                   double greatest, double otherwise) {
  if (!json.contains(member)) return otherwise;
  const double number = json.at(member).get<double>();
  if (number >= least && number <= greatest) return number;
  throw std::runtime_error(fmt::format("{} is from {:g} to {:g}, not {:g}",
                                       member, least, greatest, number));
}

void read_profile(std::string_view kind, const std::string& name_or_file,
                  std::span<const std::string_view> known,
                  const FileAccess& access,
                  const std::function<void(const Json&)>& read) {
  const auto fail = [&](std::string_view fault) {
    throw FileError(
        fmt::format("Can't use {} '{}': {}", kind, name_or_file, fault));
  };
  const std::vector<Known> all = read_known(known);
  for (const Known& profile : all) {
    if (profile.is_called(name_or_file)) return read(profile.json);
  }
  if (!name_or_file.ends_with(".json")) {
    std::vector<const Known*> found;
    std::vector<std::string_view> names;
    for (const Known& profile : all) {
      if (profile.has_words_of(name_or_file)) found.push_back(&profile);
      names.emplace_back(profile.names[0]);
    }
    if (found.size() == 1) return read(found[0]->json);
    if (found.size() > 1) fail(several_text(kind, name_or_file, found));
    const std::string hint = did_you_mean(name_or_file, names);
    fail(
        fmt::format("{}{}'lamina {}s' lists those that lamina knows, and a "
                    "file of your own ends in .json",
                    hint, hint.empty() ? "" : " ", kind));
  }
  access.require(name_or_file);
  const std::optional<std::string> text = access.read(name_or_file);
  if (!text || text->empty()) fail("no such file");
  try {
    read(Json::parse(*text));
  } catch (const Json::exception& error) {
    // "[json.exception.…] words"
    const std::string_view words = error.what();
    fail(words.substr(words.find("] ") + 2));
  } catch (const FileError&) {
    throw;
  } catch (const std::runtime_error& error) {
    fail(error.what());
  }
}

}  // namespace lamina::slicer::detail
