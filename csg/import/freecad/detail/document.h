#pragma once
// The document in a FreeCAD file: objects with names and properties.
//
// An .FCStd is a ZIP archive. Document.xml lists the objects, each with a type
// ("Part::Box"), a name that is its own, a label that the user gave, and its
// properties: the parameters, links to other objects by name, and the result as
// a boundary representation in an entry of its own. Values that expressions
// compute are stored as numbers, so nothing is computed anew here.
// GuiDocument.xml, which a file that a script saved lacks, says what is shown.

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <pugixml.hpp>

#include "base/file/zip.h"
#include "base/vec.h"

namespace lamina::csg::freecad {

// A part of an object that a property names: `Sketch`, "V_Axis".
struct SubLink {
  std::string_view object;             // empty: none
  std::vector<std::string_view> subs;  // without empty ones
};

// An object that another stands for, or an object in it.
struct ObjectLink {
  std::string_view file;    // that holds it; empty: this one
  std::string_view object;  // empty: none
  // From it to what is meant, each name followed by a dot: "Body.Pad.". What
  // follows the last dot is a face or an edge.
  std::string_view path;
};

// Views of the document's texts. The readers of properties give nothing where
// the object lacks the property, and throw FormatError where its value is
// malformed: no finite number, or one beyond plane::kGreatestCoordinate.
class Object {
 public:
  Object(pugi::xml_node data, std::string_view name, std::string_view type);

  std::string_view name() const { return name_; }
  std::string_view type() const { return type_; }
  std::string_view label() const { return label_; }
  bool is_a(std::string_view type) const { return type_ == type; }
  bool is_visible() const { return is_visible_; }
  void set_visible(bool is_visible) { is_visible_ = is_visible; }

  // Whether FreeCAD gave it an extension whose type has this in it.
  bool has_extension(std::string_view type) const;
  // Whether it has a shape that FreeCAD computes anew and does not store.
  bool has_transient_shape() const;

  // The element that holds the value, null if there is none.
  pugi::xml_node value(std::string_view property) const;

  std::optional<double> find_number(std::string_view property) const;
  double number(std::string_view property, double fallback) const {
    return find_number(property).value_or(fallback);
  }
  // Throws FormatError where there is none.
  double number(std::string_view property) const;
  // Which value of an enumeration, from 0.
  int choice(std::string_view property) const;
  bool flag(std::string_view property) const;
  std::string_view text(std::string_view property) const;
  std::optional<Vec3> vector(std::string_view property) const;
  // The identity where there is none.
  Mat4 placement(std::string_view property = "Placement") const;
  // The linked object's name; empty: none. A link into another file counts as
  // none.
  std::string_view link(std::string_view property) const;
  std::vector<std::string_view> links(std::string_view property) const;
  SubLink sub_link(std::string_view property) const;
  ObjectLink object_link(std::string_view property) const;
  // The archive's entry that a property is in; empty: none.
  std::string_view file(std::string_view property) const;

 private:
  std::string_view name_;
  std::string_view type_;
  std::string_view label_;
  pugi::xml_node properties_;
  bool is_visible_ = true;
};

// An attribute as a number, under the same terms.
double read_number(const pugi::xml_node& element, const char* attribute);

class Document {
 public:
  // bytes  must stay as long as the document
  //
  // throws  FormatError; plane::LimitExceeded
  explicit Document(std::string_view bytes);

  // Warnings of what the file names and is not an object all the same.
  const std::vector<std::string>& warnings() const { return warnings_; }

  const std::vector<Object>& objects() const { return objects_; }
  // Null where there is none.
  const Object* find(std::string_view name) const;
  // By its name or, where none has that name, the first of that label.
  const Object* find_part(std::string_view name_or_label) const;

  // The entry with the boundary that the file stores for the object, in the
  // frame of what holds it; empty where it has none, or one without faces.
  // Throws FormatError where the archive lacks it.
  std::string_view boundary_entry(const Object& object) const;

  // Whether that boundary is one of solids, and as text, so that it says so.
  bool has_stored_solid(const Object& object) const;

  // Whether the file says what is shown; one that a script saved does not.
  bool has_view() const { return !view_.document_element().empty(); }

  // Lists that stand in an entry of their own. Throw FormatError where it is
  // not what such a list is.
  std::vector<Mat4> placements_of(const Object& object,
                                  std::string_view property) const;
  std::vector<Vec3> vectors_of(const Object& object,
                               std::string_view property) const;

  // The bytes of an entry, unpacked anew. Throws FormatError likewise.
  std::string unpack(std::string_view entry) const;

 private:
  // What is known of an entry with a boundary.
  struct Boundary {
    bool has_faces = false;
    bool has_solids = false;
  };

  const Boundary& look_into(std::string_view entry) const;
  void read_objects();
  // Little-endian: their number, and so many values of `width` numbers each.
  std::vector<double> numbers_of(std::string_view entry,
                                 std::size_t width) const;
  void read_visibility();

  ZipArchive archive_;
  pugi::xml_document document_;
  pugi::xml_document view_;
  std::vector<Object> objects_;
  std::map<std::string_view, std::size_t> by_name_;
  std::vector<std::string> warnings_;
  // The entries that were looked into: each is unpacked for it once.
  mutable std::map<std::string_view, Boundary> boundaries_;
};

}  // namespace lamina::csg::freecad
