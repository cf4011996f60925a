#include "csg/cad/detail/loss.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

#include <IGESBasic_SingularSubfigure.hxx>
#include <IGESBasic_SubfigureDef.hxx>
#include <IGESData_IGESEntity.hxx>
#include <IGESSolid_SolidInstance.hxx>
#include <Interface_Check.hxx>
#include <Interface_EntityIterator.hxx>
#include <Interface_Graph.hxx>
#include <Interface_InterfaceModel.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepData_UndefinedEntity.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_MappedItem.hxx>
#include <StepRepr_NextAssemblyUsageOccurrence.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationMap.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <StepRepr_ShapeRepresentationRelationship.hxx>
#include <StepShape_ContextDependentShapeRepresentation.hxx>
#include <StepShape_FaceSurface.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShellBasedSurfaceModel.hxx>
#include <StepShape_SolidModel.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS_Shape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_Reader.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/format.h>

namespace lamina::cad {
namespace {

using Entity = Handle(Standard_Transient);
using Entities = std::set<const Standard_Transient*>;

template <typename Kind>
Handle(Kind) as(const Entity& entity) {
  return Handle(Kind)::DownCast(entity);
}

// The number of an IGES entity's type; 0 for one of STEP.
int iges_type(const Entity& entity) {
  const auto iges = as<IGESData_IGESEntity>(entity);
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

// --- Parts and their instances -----------------------------------------------

// The part, or the instance of one in an assembly, whose shape it is.
Entity owner_of(const Handle(StepRepr_PropertyDefinition) & shape) {
  if (shape.IsNull() ||
      !shape->IsKind(STANDARD_TYPE(StepRepr_ProductDefinitionShape))) {
    return {};
  }
  const Entity part = shape->Definition().ProductDefinition();
  return part.IsNull() ? shape->Definition().ProductDefinitionRelationship()
                       : part;
}

// What the file says of its parts, beside how they are transferred.
struct Assembly {
  Entities shown;   // parts and instances that have a shape
  Entities mapped;  // representations that stand elsewhere, and their parts

  // Instances of a part that is mapped need no place of their own.
  bool shows(const Entity& owner) const {
    const auto use = as<StepRepr_NextAssemblyUsageOccurrence>(owner);
    return shown.contains(owner.get()) ||
           (!use.IsNull() && !use->RelatedProductDefinition().IsNull() &&
            mapped.contains(use->RelatedProductDefinition().get()));
  }
};

Assembly find_assembly(const Interface_InterfaceModel& model,
                       const Entities& concerned) {
  Assembly found;
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const auto item = as<StepRepr_MappedItem>(model.Value(i));
    if (!concerned.contains(item.get()) || item->MappingSource().IsNull()) {
      continue;
    }
    found.mapped.insert(item->MappingSource()->MappedRepresentation().get());
  }
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Entity& entity = model.Value(i);
    if (const auto part = as<StepShape_ShapeDefinitionRepresentation>(entity);
        !part.IsNull()) {
      const Entity owner = owner_of(part->Definition().PropertyDefinition());
      found.shown.insert(owner.get());
      if (found.mapped.contains(part->UsedRepresentation().get())) {
        found.mapped.insert(owner.get());
      }
    } else if (const auto instance =
                   as<StepShape_ContextDependentShapeRepresentation>(entity);
               !instance.IsNull()) {
      found.shown.insert(
          owner_of(instance->RepresentedProductRelation()).get());
    }
  }
  return found;
}

// What an instance is an instance of.
struct Origin {
  bool is_instance = false;
  Entity entity;  // null where the file lacks it
};

Origin origin_of(const Entity& entity) {
  if (const auto item = as<StepRepr_MappedItem>(entity); !item.IsNull()) {
    const auto map = item->MappingSource();
    return {true, map.IsNull() ? Entity() : map->MappedRepresentation()};
  }
  if (const auto use = as<StepRepr_NextAssemblyUsageOccurrence>(entity);
      !use.IsNull()) {
    return {true, use->RelatedProductDefinition()};
  }
  if (const auto use = as<IGESBasic_SingularSubfigure>(entity); !use.IsNull()) {
    return {true, use->Subfigure()};
  }
  if (const auto use = as<IGESSolid_SolidInstance>(entity); !use.IsNull()) {
    return {true, use->Entity()};
  }
  return {};
}

// --- Entities on which shapes depend -----------------------------------------

// Where the shapes of a STEP begin: what gives a part its shape, or an instance
// its place. Shapes of dimensions and tolerances do not count.
bool begins_shapes(const Entity& entity) {
  if (const auto shown = as<StepShape_ShapeDefinitionRepresentation>(entity);
      !shown.IsNull()) {
    const auto what = shown->Definition().PropertyDefinition();
    return what.IsNull() ||
           what->IsKind(STANDARD_TYPE(StepRepr_ProductDefinitionShape));
  }
  return entity->IsKind(
             STANDARD_TYPE(StepShape_ContextDependentShapeRepresentation)) ||
         entity->IsKind(STANDARD_TYPE(StepRepr_NextAssemblyUsageOccurrence)) ||
         entity->IsKind(
             STANDARD_TYPE(StepRepr_ShapeRepresentationRelationship));
}

// Whether shapes of an IGES may depend on it.
bool is_iges_shape(const Entity& entity) {
  // Geometry is numbered 100 to 199 and 500 to 599, what repeats it is not.
  constexpr int kHundred = 100;
  constexpr int kSubfigure = 308;
  constexpr int kSubfigureInstance = 408;
  constexpr int kSolidInstance = 430;
  const int type = iges_type(entity);
  return type / kHundred == 1 || type / kHundred == 5 || type == kSubfigure ||
         type == kSubfigureInstance || type == kSolidInstance;
}

// All that shapes, their places or their units may depend on. What a part is
// called, its dimensions, tolerances and other properties do not count.
Entities find_concerned(XSControl_Reader& reader) {
  const Interface_Graph& graph =
      reader.WS()->TransferReader()->TransientProcess()->Graph();
  Entities found;
  std::vector<Entity> open;
  const auto visit = [&](const Entity& entity) {
    if (!entity->IsKind(STANDARD_TYPE(StepBasic_ProductDefinition)) &&
        found.insert(entity.get()).second) {
      open.push_back(entity);
    }
  };
  const Handle(Interface_InterfaceModel) model = reader.Model();
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity& entity = model->Value(i);
    if (begins_shapes(entity)) visit(entity);
    if (is_iges_shape(entity)) found.insert(entity.get());
  }
  // A STEP may have no parts, only shapes.
  const int roots = found.empty() ? reader.NbRootsForTransfer() : 0;
  for (int i = 1; i <= roots; ++i) visit(reader.RootForTransfer(i));
  while (!open.empty()) {
    const Entity entity = open.back();
    open.pop_back();
    for (auto next = graph.Shareds(entity); next.More(); next.Next()) {
      visit(next.Value());
    }
  }
  return found;
}

// Whether it relates a shape to one of triangles, which OpenCASCADE can't read.
bool is_tessellated(const Entity& entity, const Interface_Graph& graph) {
  if (!entity->IsKind(
          STANDARD_TYPE(StepRepr_ShapeRepresentationRelationship))) {
    return false;
  }
  for (auto next = graph.Shareds(entity); next.More(); next.Next()) {
    const auto unknown = as<StepData_UndefinedEntity>(next.Value());
    if (!unknown.IsNull() && !unknown->IsComplex() &&
        std::string_view(unknown->StepType()).starts_with("TESSELLATED_")) {
      return true;
    }
  }
  return false;
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

std::string loss_of(XSControl_Reader& reader) {
  const Handle(Interface_InterfaceModel) model = reader.Model();
  const auto& transferred = reader.WS()->TransferReader()->TransientProcess();
  const auto has_face = [&](const Entity& entity) {
    return TopExp_Explorer(TransferBRep::ShapeResult(transferred, entity),
                           TopAbs_FACE)
        .More();
  };
  const Entities concerned = find_concerned(reader);
  const Assembly assembly = find_assembly(*model, concerned);
  // Triangles are a copy where each part has a shape besides.
  const bool has_shapes = std::all_of(
      assembly.shown.begin(), assembly.shown.end(), [&](const auto* owner) {
        return owner == nullptr ||
               !owner->IsKind(STANDARD_TYPE(StepBasic_ProductDefinition)) ||
               has_face(owner);
      });
  Count parts;
  Count instances;
  Count solids;
  Count faces;
  Count entities;
  for (int i = 1; i <= model->NbEntities(); ++i) {
    const Entity& entity = model->Value(i);
    if (const Entity owner = owner_of(as<StepRepr_PropertyDefinition>(entity));
        !owner.IsNull()) {
      parts.add(!assembly.shows(owner));
    }
    if (is_solid(entity)) solids.add(!has_face(entity));
    if (is_face(entity)) faces.add(!has_face(entity));
    if (!concerned.contains(entity.get()) ||
        (has_shapes && is_tessellated(entity, transferred->Graph()))) {
      continue;
    }
    if (const Origin origin = origin_of(entity); origin.is_instance) {
      instances.add(!has_face(entity) &&
                    (origin.entity.IsNull() || has_face(origin.entity)));
    }
    const auto check = transferred->Check(entity);
    entities.add(model->IsErrorEntity(i) ||
                 (!check.IsNull() && check->HasFailed()));
  }
  // OpenCASCADE does not always know in which entity a reference leads nowhere.
  if (entities.lost == 0) {
    entities.lost = static_cast<std::size_t>(model->GlobalCheck()->NbFails());
  }
  std::vector<std::string> losses;
  for (const auto& [count, what] :
       {std::pair(parts, "shapes of parts"),
        {instances, "instances"},
        {solids, "solids"},
        {faces, "faces"},
        {entities, "entities of shapes or units"}}) {
    if (count.lost == 0) continue;
    losses.push_back(fmt::format("{} of {} {}", count.lost, count.all, what));
  }
  if (losses.empty()) return "";
  return fmt::format("OpenCASCADE can't use {}", fmt::join(losses, ", "));
}

}  // namespace lamina::cad
