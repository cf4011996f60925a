#include "slicer/machine/detail/profile.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/similar.h"
#include "base/text.h"

namespace lamina::slicer::detail {
namespace {

using Json = nlohmann::json;

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
  std::vector<std::string> names;
  for (const std::string_view text : known) {
    const Json json = Json::parse(text);
    names.push_back(json.at("name").get<std::string>());
    if (names.back() == name_or_file) return read(json);
  }
  if (!name_or_file.ends_with(".json")) {
    const std::vector<std::string_view> views(names.begin(), names.end());
    const std::string hint = did_you_mean(name_or_file, views);
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
