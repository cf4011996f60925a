#pragma once
// Profiles of printers and materials: JSON objects, those that lamina knows and
// the user's own.

#include <functional>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file/file_access.h"

namespace lamina::slicer::detail {

// The texts of the files in slicer/machine/printers and materials, in
// alphabetical order of their names.
extern const std::span<const std::string_view> kPrinterProfiles;
extern const std::span<const std::string_view> kMaterialProfiles;

// Throws std::runtime_error where the object has a member that is none of
// these.
void require_members(const nlohmann::json& json,
                     std::initializer_list<std::string_view> known);

// A text as one line: it stands in lines of other files and of messages. Throws
// where it is absent, unless there is `otherwise`.
std::string read_line(const nlohmann::json& json, const char* member,
                      std::optional<std::string> otherwise = {});

// A list of such texts; empty where it is absent.
std::vector<std::string> read_lines(const nlohmann::json& json,
                                    const char* member);

// A number from `least` to `greatest`; `otherwise` where it is absent. Throws
// std::runtime_error.
double read_number(const nlohmann::json& json, const char* member, double least,
                   double greatest, double otherwise);

// Reads the profile that lamina knows by that name or title, or else the text
// of a file that ends in .json, or else the one known profile whose name or
// title has the words. Throws as find_printer() does; so do faults that `read`
// throws as std::runtime_error or nlohmann::json::exception.
//
// kind  "printer" or "material", for messages
void read_profile(std::string_view kind, const std::string& name_or_file,
                  std::span<const std::string_view> known,
                  const FileAccess& access,
                  const std::function<void(const nlohmann::json&)>& read);

}  // namespace lamina::slicer::detail
