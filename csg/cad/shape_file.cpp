#include "csg/cad/detail/shape_file.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <BinTools.hxx>
#include <BinTools_ShapeSet.hxx>
#include <IGESControl_Reader.hxx>
#include <Interface_InterfaceModel.hxx>
#include <STEPControl_Reader.hxx>
#include <StepBasic_Product.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_ProductDefinitionFormation.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentationItem.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <StepRepr_ShapeRepresentationRelationship.hxx>
#include <StepShape_ShapeDefinitionRepresentation.hxx>
#include <StepShape_ShapeRepresentation.hxx>
#include <StepShape_SolidModel.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopExp_Explorer.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include "csg/cad/detail/loss.h"

namespace lamina::cad {
namespace {

std::istringstream stream_of(std::string_view bytes) {
  return std::istringstream(std::string(bytes));
}

// --- Names in STEP -----------------------------------------------------------

using Names = std::map<const Standard_Transient*, std::string>;

std::string text_of(const Handle(TCollection_HAsciiString) & text) {
  return text.IsNull() ? std::string() : text->ToCString();
}

template <typename Entity, typename Visit>
void for_each(const Interface_InterfaceModel& model, const Visit& visit) {
  for (int i = 1; i <= model.NbEntities(); ++i) {
    const Handle(Entity) entity = Handle(Entity)::DownCast(model.Value(i));
    if (!entity.IsNull()) visit(entity);
  }
}

// The name of the product that a representation shows; empty if it has none.
std::string product_name(const StepShape_ShapeDefinitionRepresentation& shown) {
  const auto property = shown.Definition().PropertyDefinition();
  if (property.IsNull()) return {};
  const auto product = property->Definition().ProductDefinition();
  if (product.IsNull() || product->Formation().IsNull() ||
      product->Formation()->OfProduct().IsNull()) {
    return {};
  }
  return text_of(product->Formation()->OfProduct()->Name());
}

// A product has a representation, which may only stand for the one that has the
// solids.
Names names_of_representations(const Interface_InterfaceModel& model) {
  Names names;
  for_each<StepShape_ShapeDefinitionRepresentation>(
      model, [&](const auto& shown) {
        if (shown->UsedRepresentation().IsNull()) return;
        names[shown->UsedRepresentation().get()] = product_name(*shown);
      });
  for_each<StepRepr_ShapeRepresentationRelationship>(
      model, [&](const auto& pair) {
        const Standard_Transient* const one = pair->Rep1().get();
        const Standard_Transient* const two = pair->Rep2().get();
        if (one == nullptr || two == nullptr) return;
        if (names.contains(one) && !names.contains(two)) {
          names[two] = names[one];
        } else if (names.contains(two) && !names.contains(one)) {
          names[one] = names[two];
        }
      });
  return names;
}

Names names_of_items(const Interface_InterfaceModel& model) {
  const Names of_representations = names_of_representations(model);
  Names names;
  for_each<StepShape_ShapeRepresentation>(model, [&](const auto& shown) {
    const auto found = of_representations.find(shown.get());
    if (found == of_representations.end()) return;
    for (int i = 1; i <= shown->NbItems(); ++i) {
      names[shown->ItemsValue(i).get()] = found->second;
    }
  });
  return names;
}

void name_solids(XSControl_WorkSession& session, ShapeFile& file) {
  const Handle(Interface_InterfaceModel)& model = session.Model();
  const auto& transferred = session.TransferReader()->TransientProcess();
  const Names products = names_of_items(*model);
  for_each<StepShape_SolidModel>(*model, [&](const auto& entity) {
    const auto product = products.find(entity.get());
    const std::string own = text_of(entity->Name());
    const std::string name =
        product == products.end() || product->second.empty() ? own
                                                             : product->second;
    if (name.empty()) return;
    const TopoDS_Shape made = TransferBRep::ShapeResult(transferred, entity);
    for (TopExp_Explorer at(made, TopAbs_SOLID); at.More(); at.Next()) {
      file.name_of_solid.Bind(at.Current().Located(TopLoc_Location()),
                              static_cast<int>(file.names.size()));
    }
    file.names.push_back(name);
  });
}

// --- Readers -----------------------------------------------------------------

ShapeFile read_step(std::string_view bytes) {
  STEPControl_Reader reader;
  std::istringstream stream = stream_of(bytes);
  if (reader.ReadStream("", stream) != IFSelect_RetDone) {
    throw Unreadable{"STEP that is no exchange structure of ISO 10303-21"};
  }
  reader.TransferRoots();
  ShapeFile file;
  file.shape = reader.OneShape();
  file.loss = loss_of(reader);
  name_solids(*reader.WS(), file);
  return file;
}

// OpenCASCADE reads IGES from a path, or from standard input where the path is
// empty. This process has no other use for that, and no path is in its way.
void put_into_standard_input(std::string_view bytes) {
  ::close(STDIN_FILENO);
  // Takes the least number that is free: that of standard input.
  const int file = ::memfd_create("iges", 0);
  if (file != STDIN_FILENO) throw std::bad_alloc();
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written <= 0) throw std::bad_alloc();
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  ::lseek(file, 0, SEEK_SET);
}

ShapeFile read_iges(std::string_view bytes) {
  constexpr std::size_t kColumn = 73;
  if (bytes.size() < kColumn || bytes[kColumn - 1] != 'S') {
    throw Unreadable{"IGES whose first line has no S in column 73"};
  }
  put_into_standard_input(bytes);
  IGESControl_Reader reader;
  if (reader.ReadFile("") != IFSelect_RetDone) {
    throw Unreadable{"IGES without its sections"};
  }
  reader.TransferRoots();
  return {reader.OneShape(), {}, {}, loss_of(reader)};
}

// Which of the shapes of a binary file is meant stands at its end: as
// OpenCASCADE writes it, or, in three numbers, as FreeCAD does.
TopoDS_Shape read_binary(std::istringstream& stream, std::size_t size) {
  constexpr std::size_t kFreeCadEnd = 12;
  BinTools_ShapeSet shapes;
  shapes.Read(stream);
  TopoDS_Shape shape;
  const auto at = static_cast<std::size_t>(std::max<long>(stream.tellg(), 0));
  if (at + kFreeCadEnd != size) {
    shapes.ReadSubs(shape, stream, shapes.NbShapes());
    return shape;
  }
  int number = 0;
  int place = 0;
  int orientation = 0;
  BinTools::GetInteger(stream, number);
  BinTools::GetInteger(stream, place);
  BinTools::GetInteger(stream, orientation);
  if (number < 1 || number > shapes.NbShapes()) return shape;
  shape = shapes.Shape(number);
  shape.Location(shapes.Locations().Location(place));
  shape.Orientation(orientation == TopAbs_REVERSED ? TopAbs_REVERSED
                                                   : TopAbs_FORWARD);
  return shape;
}

TopoDS_Shape read_text(std::istringstream& stream) {
  TopoDS_Shape shape;
  BRepTools::Read(shape, stream, BRep_Builder());
  return shape;
}

// Both begin with words of their own, the text behind others of a drawing.
ShapeFile read_brep(std::string_view bytes) {
  constexpr std::string_view kText = "CASCADE Topology V";
  constexpr std::string_view kBinary = "Open CASCADE Topology V";
  constexpr std::size_t kHead = 200;
  const std::string_view head = bytes.substr(0, kHead);
  const bool is_binary = head.find(kBinary) != std::string_view::npos;
  if (!is_binary && head.find(kText) == std::string_view::npos) {
    throw Unreadable{"BREP that does not begin with 'CASCADE Topology'"};
  }
  std::istringstream stream = stream_of(bytes);
  // OpenCASCADE does not look whether it read anything, and may wait for a word
  // for ever.
  stream.exceptions(std::ios::failbit | std::ios::badbit);
  try {
    return {is_binary ? read_binary(stream, bytes.size()) : read_text(stream),
            {},
            {},
            {}};
  } catch (const std::ios::failure&) {
    throw Unreadable{"BREP that ends too early, or has words for numbers"};
  }
}

}  // namespace

ShapeFile read_shape(std::string_view bytes, Format format) {
  ShapeFile file;
  switch (format) {
    case Format::kStep:
      file = read_step(bytes);
      break;
    case Format::kIges:
      file = read_iges(bytes);
      break;
    case Format::kBrep:
      file = read_brep(bytes);
      break;
  }
  if (file.shape.IsNull()) throw Unreadable{"file without a shape"};
  return file;
}

}  // namespace lamina::cad
