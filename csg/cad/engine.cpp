// The module: STEP, IGES and BREP by OpenCASCADE.

#include "csg/cad/detail/engine.h"

#include <exception>
#include <new>
#include <string>
#include <vector>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>
#include <Standard_OutOfMemory.hxx>
#include <fmt/format.h>

#include "csg/cad/detail/shape_file.h"
#include "csg/cad/detail/solids.h"
#include "csg/cad/detail/tessellation.h"

namespace lamina::cad {
namespace {

// Keeps the solids of that name, or the one of that number.
void keep_asked(std::string_view asked, std::vector<Solid>& solids) {
  std::size_t number = 0;
  std::erase_if(solids, [&](const Solid& solid) {
    ++number;
    return solid.name != asked && std::to_string(number) != asked;
  });
  if (solids.empty()) {
    throw Unreadable{fmt::format("there is no part '{}'", asked)};
  }
}

Part make_part(std::string_view bytes, Format format, const Fineness& fineness,
               std::optional<std::string_view> asked) {
  if (fineness.chordal_error < kLeastChordalError) {
    throw Unreadable{fmt::format(
        "OpenCASCADE keeps no chordal error of {:.3g} mm, only {:g} "
        "mm and more: the part is scaled too much",
        fineness.chordal_error, kLeastChordalError)};
  }
  const ShapeFile file = read_shape(bytes, format);
  Part part;
  if (!file.loss.empty()) part.warnings.push_back(file.loss);
  std::vector<Solid> solids = find_solids(file, fineness.chordal_error, part);
  if (asked) keep_asked(*asked, solids);
  for (const Solid& solid : solids) {
    part.bodies.push_back(
        {solid.name, tessellate(solid, fineness, part.warnings)});
  }
  return part;
}

class OpenCascade : public Engine {
 public:
  Result read(std::string_view bytes, Format format, const Fineness& fineness,
              std::optional<std::string_view> asked) noexcept override {
    // Nobody reads what it says, and to say it takes time.
    try {
      Message::DefaultMessenger()->ChangePrinters().Clear();
      return {.part = make_part(bytes, format, fineness, asked)};
    } catch (const Unreadable& fault) {
      return {.outcome = Outcome::kBroken, .reason = fault.reason};
    } catch (const TooManyTriangles& fault) {
      return {.outcome = Outcome::kTooManyTriangles,
              .triangles = fault.triangles};
    } catch (const Standard_OutOfMemory&) {
      return {.outcome = Outcome::kNoMemory};
    } catch (const std::bad_alloc&) {
      return {.outcome = Outcome::kNoMemory};
    } catch (const Standard_Failure& fault) {
      return {.outcome = Outcome::kBroken,
              .reason = std::string("OpenCASCADE fails on this file: ") +
                        fault.GetMessageString()};
    } catch (const std::exception& fault) {
      return {.outcome = Outcome::kBroken, .reason = fault.what()};
    }
  }
};

}  // namespace
}  // namespace lamina::cad

extern "C" __attribute__((visibility("default"))) lamina::cad::Engine*
lamina_make_cad_engine(int version) noexcept {
  static lamina::cad::OpenCascade engine;
  return version == lamina::cad::kEngineVersion ? &engine : nullptr;
}
