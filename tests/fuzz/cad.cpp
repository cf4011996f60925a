#include "tests/fuzz/cad.h"

#include <cmath>
#include <new>

#include "base/diagnostic.h"
#include "base/file/format_error.h"
#include "csg/limits.h"
#include "tests/fuzz/input.h"

namespace lamina::fuzz {

void read_part(std::string_view bytes, cad::Format format) {
  constexpr unsigned kMostSeconds = 2;
  Diagnostics diagnostics;
  cad::Reader reader({LAMINA_MODULES}, diagnostics, kMostSeconds);
  try {
    const cad::Part part = reader.read(bytes, format, {.chordal_error = 0.1});
    for (const cad::Body& body : part.bodies) {
      for (const Vec3& p : body.mesh.vertices) {
        require(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z),
                "vertices are finite");
      }
      for (const auto& triangle : body.mesh.triangles) {
        for (const std::uint32_t corner : triangle) {
          require(corner < body.mesh.vertices.size(), "corners are vertices");
        }
      }
    }
  } catch (const FormatError&) {
  } catch (const plane::LimitExceeded&) {
  } catch (const std::bad_alloc&) {
  }
}

}  // namespace lamina::fuzz
