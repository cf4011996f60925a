#pragma once
// A JSON file of some members and a list, which may be too long to be held: its
// elements are written as they come. The members are known last and yet stand
// first, where people look.

#include <cstdint>
#include <string>
#include <string_view>

#include <nlohmann/json_fwd.hpp>

#include "base/file/output_file.h"

namespace lamina::cli {

// An element as add() takes it.
std::string list_element(const nlohmann::ordered_json& json);

class JsonList {
 public:
  // Throws FileError, as do all that follow.
  JsonList(const std::string& path, TemporaryFiles& temporary_files)
      : file_(OutputFile::open(path, temporary_files)) {}

  // element  of list_element()
  void add(std::string_view element);

  // Writes the members, the list as the last one, and gives the file its name.
  void commit(nlohmann::ordered_json members, const std::string& list_name);

 private:
  OutputFile file_;
  std::uint64_t count_ = 0;
};

}  // namespace lamina::cli
