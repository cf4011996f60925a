#pragma once
// What a page asks for: the body of its requests (docs/studio.md), and the
// request of the compiler that it means.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "compiler/request.h"
#include "parser/customizer/parameter_set.h"

namespace lamina::studio {

// A body that is not what docs/studio.md says.
struct ChoiceError : Error {
  using Error::Error;
};

// What of the job the page can change. Names are empty where nothing is chosen.
struct JobChoice {
  double layer_thickness = 0;  // [mm]
  double min_feature = 0;      // [mm]; 0: thin places are not searched for
  bool has_supports = false;
  std::string printer;
  std::string material;
  std::string metal;
};

struct Choice {
  std::string client;
  std::uint64_t number = 0;
  std::string design;
  ParameterSet values;  // that differ from the design's own
  JobChoice job;
  std::string form;         // key of the form that the page has
  std::optional<double> z;  // of the layer in view, above the bed [mm]
  std::string format;       // of POST /output; else empty
  std::string key;          // of POST /source, to write; else empty
};

// Throws ChoiceError.
Choice read_choice(std::string_view json);

// What the page may name: nothing else of a choice reaches the file system.
struct Names {
  std::vector<std::string> designs;
  std::vector<std::string> printers;
  std::vector<std::string> materials;
  std::vector<std::string> metals;
  std::vector<std::string> formats;  // extensions
};

// The request with lamina's own names of its printer, material and metal, where
// they are not profiles. Throws FileError where there are none such.
compiler::Request with_known_names(compiler::Request request,
                                   const FileAccess& access);

// The job that a request asks for.
JobChoice job_of(const compiler::Request& request);

// The names that lamina knows, and those that `request` has: profiles, too.
Names known_names(const compiler::Request& request,
                  std::vector<std::string> designs);

// The request that the choice makes of the studio's own. The path of the design
// is that of `base`.
//
// throws  ChoiceError for what is not among the names, compiler::RequestError
//         where numbers are beyond their limits
compiler::Request request_of(const Choice& choice,
                             const compiler::Request& base, const Names& names);

}  // namespace lamina::studio
