#pragma once
// Parameter sets: values for the parameters of a design, in a file of
// OpenSCAD's customizer.
//
//     {"parameterSets": {"wide": {"width": "12", "name": "Ada"}}}
//
// A value is a text. A parameter that is a string takes it as it is, one that
// is true or false takes true, false, 1 or 0, any other takes it in the
// notation of the customizer's comments if that gives a value of its own type,
// and keeps its own else.
//
// So says OpenSCAD 2021.01. In language 2026 only what customizer.h's
// ParameterRule describes can be set: numbers are moved into their range, texts
// cut to their length, and what is not a choice is left out. In both languages
// a warning names each value that the design does not get as the set has it.
//
// Departures from OpenSCAD 2021.01: a set that the file lacks is an error, not
// the design's own values; and only variables whose value is a literal, or
// arithmetic on literals, can be set.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "parser/ast.h"
#include "parser/language.h"

namespace lamina {

struct ParameterValue {
  std::string name;
  std::string text;
  bool is_single = true;  // else a list or an object, whose text is empty
};

// In the order of the file.
using ParameterSet = std::vector<ParameterValue>;

// The sets of a file, in the order in which they stand there. A batch makes a
// piece of each, so the file is read once, and what is kept of it takes no more
// memory than its text does.
class ParameterSets {
 public:
  // Throws FileError where the file cannot be read or is no JSON, AccessError
  // where it may not be read.
  static ParameterSets read(const std::string& path,
                            const FileAccess& access = kAllFiles);

  std::size_t size() const { return sets_.size(); }
  const std::string& name_of(std::size_t index) const {
    return sets_[index].name;
  }

  // Both throw FileError where what has the name is not a set. Of several sets
  // of one name, the name means the first.
  ParameterSet values_of(std::size_t index) const;
  ParameterSet values_of(std::string_view name) const;

 private:
  class Reader;
  struct Set {
    std::string name;
    std::size_t begin = 0;   // its first value; the next set's is the end
    bool is_object = false;  // else it is not a set
  };
  struct Value {
    std::uint32_t name = 0;  // in names_
    bool is_single = true;
    std::size_t text_end = 0;  // in texts_; it begins where the one before ends
  };

  explicit ParameterSets(std::string path) : path_(std::move(path)) {}
  [[noreturn]] void refuse(std::string_view name) const;

  std::string path_;
  std::vector<std::string> names_;  // of parameters, each once
  std::string texts_;
  std::vector<Value> values_;
  std::vector<Set> sets_;
};

// What a value is that the design does not get as the set has it.
enum class Misfit : std::uint8_t { kWarning, kError };

// Sets the variables of `program` to the values of `set`.
//
// returns  false where a value cannot be used; that is reported, and the values
//          before it stay set
bool apply_parameter_set(const ParameterSet& set, ast::Program& program,
                         Language language, Diagnostics& diagnostics,
                         Misfit misfit = Misfit::kWarning);

}  // namespace lamina
