// JSON files as values, and what a program may do with such a value.

#include <cstddef>
#include <cstdint>

#include "csg/eval/builtin/json.h"
#include "csg/eval/value/text.h"
#include "tests/fuzz/input.h"

using namespace lamina;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  const csg::JsonResult result = csg::read_json(
      fuzz::write_input("input.json", fuzz::as_text(data, size)));
  fuzz::require(result.can_read, "a file that is there can be read");
  if (result.fault.empty()) csg::to_echo(result.value);
  return 0;
}
