#include "csg/import/freecad/detail/document.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <glm/gtc/quaternion.hpp>

#include "base/file/format_error.h"
#include "base/file/xml.h"
#include "base/text.h"
#include "csg/limits.h"

namespace lamina::csg::freecad {
namespace {

ZipArchive open_archive(std::string_view bytes) {
  if (!ZipArchive::is_zip(bytes)) {
    throw FormatError("FCStd, expected a ZIP archive");
  }
  ZipArchive archive = ZipArchive::open(bytes);
  constexpr double kSlack = 1 << 20;
  const double most =
      std::min(kMostUnpackedBytes,
               kSlack + kMostSwelling * static_cast<double>(bytes.size()));
  if (archive.unpacked_bytes() > most) {
    throw plane::LimitExceeded(fmt::format(
        "FCStd of {} bytes unpacks to {:.7g}, at most {:.7g} can be",
        bytes.size(), archive.unpacked_bytes(), most));
  }
  return archive;
}

// Before anything is made of it: elements take several times their text.
void require_few_parts(std::string_view bytes, std::string_view entry) {
  const auto count = static_cast<std::size_t>(std::count_if(
      bytes.begin(), bytes.end(), [](char c) { return c == '<' || c == '='; }));
  if (count <= kMostXmlParts) return;
  throw plane::LimitExceeded(
      fmt::format("FCStd {} has {} elements and attributes, at most {} can be",
                  entry, count, kMostXmlParts));
}

void parse_xml(std::string_view bytes, std::string_view entry,
               pugi::xml_document& document) {
  require_few_parts(bytes, entry);
  if (const auto fault = load_xml(bytes, document)) {
    throw FormatError(
        fmt::format("FCStd {} byte {}, {}", entry, fault->place, fault->words));
  }
}

// A rotation by a right angle becomes one of whole numbers: quaternions leave
// 2e-16 in the place of 0.
double without_dust(double entry) {
  constexpr double kDust = 1e-15;
  const double whole = std::round(entry);
  return std::abs(entry - whole) < kDust ? whole : entry;
}

// turn  need not be of unit length; where it is 0 nothing is turned
Mat4 make_placement(const glm::dquat& turn, Vec3 shift) {
  Mat4 matrix(1);
  constexpr double kLeastNorm = 1e-7;
  if (const double norm = glm::length(turn); norm > kLeastNorm) {
    matrix = glm::mat4_cast(turn / norm);
  }
  for (int column = 0; column < 3; ++column) {
    for (int row = 0; row < 3; ++row) {
      matrix[column][row] = without_dust(matrix[column][row]);
    }
  }
  matrix[3] = Vec4(shift, 1);
  return matrix;
}

Mat4 read_placement(const pugi::xml_node& value) {
  return make_placement({read_number(value, "Q3"), read_number(value, "Q0"),
                         read_number(value, "Q1"), read_number(value, "Q2")},
                        {read_number(value, "Px"), read_number(value, "Py"),
                         read_number(value, "Pz")});
}

// Whether the boundary is one of more than points and curves. As text it names
// each shape's kind on a line of its own, "Fa" for a face; the binary form is
// not looked into.
bool has_faces(std::string_view boundary) {
  constexpr std::string_view kBinary = "Open CASCADE Topology";
  if (boundary.substr(0, 100).find(kBinary) != std::string_view::npos) {
    return true;
  }
  return boundary.find("\nFa") != std::string_view::npos;
}

}  // namespace

double read_number(const pugi::xml_node& element, const char* attribute) {
  const std::string_view text = element.attribute(attribute).value();
  const auto number = parse_number(text);
  if (!number) {
    throw FormatError(
        fmt::format("FCStd, expected a number in {} of a {}, not '{}'",
                    attribute, element.name(), text));
  }
  if (plane::is_too_far(*number)) {
    throw FormatError(fmt::format("FCStd, {} of a {} is {:g}, beyond 1e9",
                                  attribute, element.name(), *number));
  }
  return *number;
}

// --- Object -----------------------------------------------------------------

Object::Object(pugi::xml_node data, std::string_view name,
               std::string_view type)
    : name_(name), type_(type), properties_(data.child("Properties")) {
  label_ = text("Label");
  if (label_.empty()) label_ = name_;
  is_visible_ = !value("Visibility") || flag("Visibility");
}

bool Object::has_extension(std::string_view type) const {
  const auto extensions =
      properties_.parent().child("Extensions").children("Extension");
  return std::any_of(extensions.begin(), extensions.end(),
                     [&](const pugi::xml_node& extension) {
                       const std::string_view found =
                           extension.attribute("type").value();
                       return found.find(type) != std::string_view::npos;
                     });
}

bool Object::has_transient_shape() const {
  const auto transient = properties_.children("_Property");
  return std::any_of(
      transient.begin(), transient.end(), [](const pugi::xml_node& property) {
        return property.attribute("name").value() == std::string_view("Shape");
      });
}

pugi::xml_node Object::value(std::string_view property) const {
  for (const pugi::xml_node child : properties_.children("Property")) {
    if (child.attribute("name").value() == property) {
      return child.first_child();
    }
  }
  return {};
}

std::optional<double> Object::find_number(std::string_view property) const {
  const pugi::xml_node element = value(property);
  if (!element) return std::nullopt;
  return read_number(element, "value");
}

double Object::number(std::string_view property) const {
  const auto number = find_number(property);
  if (number) return *number;
  throw FormatError(
      fmt::format("FCStd, {} '{}' has no {}", type_, label_, property));
}

int Object::choice(std::string_view property) const {
  return static_cast<int>(number(property, 0));
}

bool Object::flag(std::string_view property) const {
  return value(property).attribute("value").as_bool();
}

std::string_view Object::text(std::string_view property) const {
  return value(property).attribute("value").value();
}

std::optional<Vec3> Object::vector(std::string_view property) const {
  const pugi::xml_node element = value(property);
  if (!element) return std::nullopt;
  return Vec3(read_number(element, "valueX"), read_number(element, "valueY"),
              read_number(element, "valueZ"));
}

Mat4 Object::placement(std::string_view property) const {
  const pugi::xml_node element = value(property);
  return element ? read_placement(element) : Mat4(1);
}

std::string_view Object::link(std::string_view property) const {
  const ObjectLink link = object_link(property);
  return link.file.empty() ? link.object : std::string_view();
}

std::vector<std::string_view> Object::links(std::string_view property) const {
  std::vector<std::string_view> names;
  for (const pugi::xml_node link : value(property).children("Link")) {
    const pugi::xml_attribute target = link.attribute("value");
    names.emplace_back((target ? target : link.attribute("obj")).value());
  }
  return names;
}

SubLink Object::sub_link(std::string_view property) const {
  const pugi::xml_node element = value(property);
  SubLink link;
  link.object = element.attribute("value").value();
  for (const pugi::xml_node sub : element.children("Sub")) {
    const std::string_view name = sub.attribute("value").value();
    if (!name.empty()) link.subs.push_back(name);
  }
  return link;
}

ObjectLink Object::object_link(std::string_view property) const {
  const pugi::xml_node element = value(property);
  const char* const name =
      element.name() == std::string_view("XLink") ? "name" : "value";
  ObjectLink link;
  link.file = element.attribute("file").value();
  link.object = element.attribute(name).value();
  link.path = element.attribute("sub").value();
  if (link.path.empty()) {
    link.path = element.child("Sub").attribute("value").value();
  }
  return link;
}

std::string_view Object::file(std::string_view property) const {
  return value(property).attribute("file").value();
}

// --- Document ---------------------------------------------------------------

Document::Document(std::string_view bytes) : archive_(open_archive(bytes)) {
  const auto text = archive_.read("Document.xml");
  if (!text) throw FormatError("FCStd holds no 'Document.xml'");
  parse_xml(*text, "Document.xml", document_);
  read_objects();
  if (const auto view = archive_.read("GuiDocument.xml")) {
    parse_xml(*view, "GuiDocument.xml", view_);
    read_visibility();
  }
}

void Document::read_objects() {
  const pugi::xml_node root = document_.document_element();
  std::map<std::string_view, std::string_view> types;
  for (const pugi::xml_node object : root.child("Objects").children("Object")) {
    types[object.attribute("name").value()] = object.attribute("type").value();
  }
  std::vector<std::string_view> repeated;
  std::vector<std::string_view> without_type;
  for (const pugi::xml_node data :
       root.child("ObjectData").children("Object")) {
    const std::string_view name = data.attribute("name").value();
    const auto type = types.find(name);
    if (type == types.end()) {
      without_type.push_back(name);
    } else if (by_name_.try_emplace(name, objects_.size()).second) {
      objects_.emplace_back(data, name, type->second);
    } else {
      repeated.push_back(name);
    }
  }
  std::vector<std::string_view> without_data;
  for (const auto& [name, type] : types) {
    if (!by_name_.contains(name)) without_data.push_back(name);
  }
  const auto warn = [&](std::string_view what,
                        const std::vector<std::string_view>& names) {
    if (names.empty()) return;
    warnings_.push_back(
        fmt::format("{}: '{}'", what, fmt::join(names, "', '")));
  };
  warn("left out, as the file has no type of them", without_type);
  warn("left out, as the file has no data of them", without_data);
  warn("left out, as others have their names", repeated);
}

void Document::read_visibility() {
  const pugi::xml_node providers =
      view_.document_element().child("ViewProviderData");
  for (const pugi::xml_node view : providers.children("ViewProvider")) {
    const auto found = by_name_.find(view.attribute("name").value());
    if (found == by_name_.end()) continue;
    for (const pugi::xml_node property :
         view.child("Properties").children("Property")) {
      if (property.attribute("name").value() ==
          std::string_view("Visibility")) {
        objects_[found->second].set_visible(
            property.first_child().attribute("value").as_bool());
      }
    }
  }
}

std::vector<double> Document::numbers_of(std::string_view entry,
                                         std::size_t width) const {
  if (entry.empty()) return {};
  const std::string bytes = unpack(entry);
  std::uint32_t count = 0;
  if (bytes.size() >= sizeof count) {
    std::memcpy(&count, bytes.data(), sizeof count);
  }
  if (bytes.size() != sizeof count + count * width * sizeof(double)) {
    throw FormatError(fmt::format(
        "FCStd, '{}' is not as long as its {} values need", entry, count));
  }
  std::vector<double> numbers(count * width);
  std::memcpy(numbers.data(), bytes.data() + sizeof count,
              numbers.size() * sizeof(double));
  for (const double number : numbers) {
    if (!std::isfinite(number) || plane::is_too_far(number)) {
      throw FormatError(
          fmt::format("FCStd, a number in '{}' is beyond 1e9", entry));
    }
  }
  return numbers;
}

std::vector<Mat4> Document::placements_of(const Object& object,
                                          std::string_view property) const {
  const std::vector<double> n = numbers_of(object.file(property), 7);
  std::vector<Mat4> placements;
  for (std::size_t i = 0; i < n.size(); i += 7) {
    placements.push_back(make_placement(
        {n[i + 6], n[i + 3], n[i + 4], n[i + 5]}, {n[i], n[i + 1], n[i + 2]}));
  }
  return placements;
}

std::vector<Vec3> Document::vectors_of(const Object& object,
                                       std::string_view property) const {
  const std::vector<double> n = numbers_of(object.file(property), 3);
  std::vector<Vec3> vectors;
  for (std::size_t i = 0; i < n.size(); i += 3) {
    vectors.emplace_back(n[i], n[i + 1], n[i + 2]);
  }
  return vectors;
}

const Object* Document::find(std::string_view name) const {
  const auto found = by_name_.find(name);
  return found == by_name_.end() ? nullptr : &objects_[found->second];
}

const Object* Document::find_part(std::string_view name_or_label) const {
  if (const Object* const object = find(name_or_label)) return object;
  const auto found = std::find_if(
      objects_.begin(), objects_.end(),
      [&](const Object& object) { return object.label() == name_or_label; });
  return found == objects_.end() ? nullptr : &*found;
}

std::string_view Document::boundary_entry(const Object& object) const {
  const std::string_view entry = object.file("Shape");
  if (entry.empty()) return {};
  return look_into(entry).has_faces ? entry : std::string_view();
}

bool Document::has_stored_solid(const Object& object) const {
  const std::string_view entry = object.file("Shape");
  return !entry.empty() && look_into(entry).has_solids;
}

const Document::Boundary& Document::look_into(std::string_view entry) const {
  const auto found = boundaries_.find(entry);
  if (found != boundaries_.end()) return found->second;
  const std::string bytes = unpack(entry);
  const Boundary boundary = {has_faces(bytes),
                             bytes.find("\nSo") != std::string::npos};
  return boundaries_.try_emplace(entry, boundary).first->second;
}

std::string Document::unpack(std::string_view entry) const {
  auto bytes = archive_.read(std::string(entry));
  if (!bytes) throw FormatError(fmt::format("FCStd holds no '{}'", entry));
  return *std::move(bytes);
}

}  // namespace lamina::csg::freecad
