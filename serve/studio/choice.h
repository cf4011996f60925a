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
#include "serve/run/names.h"

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

// The job that a request asks for.
JobChoice job_of(const compiler::Request& request);

// The request that the choice makes of the studio's own. The path of the design
// is that of `base`.
//
// throws  NameError for what is not among the names, compiler::RequestError
//         where numbers are beyond their limits
compiler::Request request_of(const Choice& choice,
                             const compiler::Request& base,
                             const serve::Names& names);

}  // namespace lamina::studio
