// Fonts that a design brings along: text set and measured with them.
//
// The bytes are the only font there is, so that every text takes it.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/diagnostic.h"
#include "base/file/file_access.h"
#include "csg/text/typesetter.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

void set_and_measure(text::Typesetter& typesetter, Diagnostics& diagnostics,
                     const char* direction) {
  csg::TextParams params;
  params.text = "Ab\u00c1 bAA";
  params.font = "Lamina";
  params.direction = direction;
  for (const auto& polygon :
       typesetter.outline(params, {.count = 4}, {}, diagnostics)) {
    for (const Vec2& point : polygon) {
      fuzz::require(std::isfinite(point.x) && std::isfinite(point.y),
                    "letters are finite");
    }
  }
  std::vector<std::string> warnings;
  typesetter.measure_text(params, warnings);
  typesetter.measure_font(params, warnings);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const std::string path =
      fuzz::write_input("input.ttf", fuzz::as_text(data, size));
  // Fontconfig's rules would be read anew for each input.
  static const std::string rules =
      fuzz::write_input("fonts.conf", "<fontconfig/>");
  setenv("FONTCONFIG_FILE", rules.c_str(), 1);

  Diagnostics diagnostics;
  FileAccess::Limits limits;
  limits.root = std::filesystem::path(path).parent_path().string();
  const FileAccess access = FileAccess::within(limits);
  text::Typesetter typesetter({LAMINA_MODULES}, diagnostics, access);
  typesetter.add_fonts({path});
  for (const char* direction : {"ltr", "ttb"}) {
    set_and_measure(typesetter, diagnostics, direction);
  }
  return 0;
}
