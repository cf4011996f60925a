#include "csg/cad/detail/loss.h"

#include <cstddef>
#include <string_view>
#include <utility>
#include <vector>

#include <IGESData_IGESEntity.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepBasic_NamedUnit.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_SolidModel.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <fmt/format.h>

namespace lamina::cad {
namespace {

using Entity = Handle(Standard_Transient);

// The number of an IGES entity's type; 0 for one of STEP.
int iges_type(const Entity& entity) {
  const auto iges = Handle(IGESData_IGESEntity)::DownCast(entity);
  return iges.IsNull() ? 0 : iges->TypeNumber();
}

bool is_solid(const Entity& entity) {
  constexpr int kIgesSolid = 186;
  return entity->IsKind(STANDARD_TYPE(StepShape_SolidModel)) ||
         entity->IsKind(STANDARD_TYPE(StepShape_ShellBasedSurfaceModel)) ||
         iges_type(entity) == kIgesSolid;
}

bool is_face(const Entity& entity) {
  const int type = iges_type(entity);
  constexpr int kBoundedSurface = 143;
  constexpr int kTrimmedSurface = 144;
  constexpr int kIgesFace = 510;
  return entity->IsKind(STANDARD_TYPE(StepShape_FaceSurface)) ||
         type == kBoundedSurface || type == kTrimmedSurface ||
         type == kIgesFace;
}

// Whether shapes, their places or their units may depend on it. Colours, notes,
// tolerances and who approved what do not count.
bool concerns_shapes(const Entity& entity) {
  if (const int type = iges_type(entity); type != 0) {
    // Geometry is numbered 100 to 199 and 500 to 599.
    constexpr int kHundred = 100;
    return type / kHundred == 1 || type / kHundred == 5;
  }
  const std::string_view name = entity->DynamicType()->Name();
  return name.starts_with("StepGeom_") || name.starts_with("StepShape_") ||
         name.starts_with("StepRepr_") ||
         name.starts_with("StepBasic_Product") ||
         entity->IsKind(STANDARD_TYPE(StepBasic_NamedUnit));
}

struct Count {
  std::size_t lost = 0;
  std::size_t all = 0;

  void add(bool is_lost) {
    ++all;
    if (is_lost) ++lost;
  }
};

}  // namespace

std::string loss_of(const XSControl_WorkSession& session) {
  const Handle(Interface_InterfaceModel) model = session.Model();
  const auto& transferred = session.TransferReader()->TransientProcess();
  Count solids;
  Count faces;
  Count entities;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity& entity = model->Value(i);
    const bool has_face =
        TopExp_Explorer(TransferBRep::ShapeResult(transferred, entity),
                        TopAbs_FACE)
            .More();
    if (is_solid(entity)) solids.add(!has_face);
    if (is_face(entity)) faces.add(!has_face);
    if (concerns_shapes(entity)) {
      const auto check = transferred->Check(entity);
      entities.add(model->IsErrorEntity(i) ||
                   (!check.IsNull() && check->HasFailed()));
    }
  }
  std::vector<std::string> losses;
  for (const auto& [count, what] :
       {std::pair(solids, "solids"),
        {faces, "faces"},
        {entities, "entities of shapes or units"}}) {
    if (count.lost == 0) continue;
    losses.push_back(fmt::format("{} of {} {}", count.lost, count.all, what));
  }
  if (losses.empty()) return "";
  return fmt::format("OpenCASCADE can't use {}", fmt::join(losses, ", "));
}

}  // namespace lamina::cad
