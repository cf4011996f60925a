#include "csg/import/detail/modifier_parts.h"

#include <optional>
#include <string_view>

#include "csg/import/detail/text_lines.h"
#include "csg/import/detail/xml.h"

namespace lamina::csg {
namespace {

constexpr const char* kPrusaSlicer = "Metadata/Slic3r_PE_model.config";
constexpr const char* kBambuStudio = "Metadata/model_settings.config";

// The value of a <metadata> of that key.
std::string_view metadata_of(const pugi::xml_node& node, std::string_view key) {
  std::string_view value;
  for_each_child(node, "metadata", [&](const pugi::xml_node& metadata) {
    if (metadata.attribute("key").value() == key) {
      value = metadata.attribute("value").value();
    }
  });
  return value;
}

template <typename Visit>
void for_each_object(const ZipArchive& archive, const char* name,
                     const Visit& visit) {
  const auto bytes = archive.read(name);
  if (!bytes) return;
  pugi::xml_document document;
  parse_xml(*bytes, "3MF", document);
  for_each_child(document.document_element(), "object", visit);
}

// Files of before 2.6 have a mark for modifiers alone.
bool is_model_part(const pugi::xml_node& volume) {
  const std::string_view type = metadata_of(volume, "volume_type");
  return metadata_of(volume, "modifier") != "1" &&
         (type.empty() || type == "ModelPart");
}

}  // namespace

ModifierParts read_modifier_parts(const ZipArchive& archive) {
  ModifierParts parts;
  const auto take_name = [&](const pugi::xml_node& object) {
    const std::string_view name = metadata_of(object, "name");
    if (!name.empty()) parts.names[object.attribute("id").value()] = name;
  };
  for_each_object(archive, kPrusaSlicer, [&](const pugi::xml_node& object) {
    take_name(object);
    for_each_child(object, "volume", [&](const pugi::xml_node& volume) {
      if (is_model_part(volume)) return;
      const auto first =
          to_number<std::uint32_t>(volume.attribute("firstid").value());
      const auto last =
          to_number<std::uint32_t>(volume.attribute("lastid").value());
      if (!first || !last) return;
      parts.triangles[object.attribute("id").value()].push_back(
          {*first, *last});
      ++parts.count;
    });
  });
  for_each_object(archive, kBambuStudio, [&](const pugi::xml_node& object) {
    take_name(object);
    for_each_child(object, "part", [&](const pugi::xml_node& part) {
      const std::string_view type = part.attribute("subtype").value();
      if (type.empty() || type == "normal_part") return;
      parts.components.insert(
          {object.attribute("id").value(), part.attribute("id").value()});
      ++parts.count;
    });
  });
  return parts;
}

}  // namespace lamina::csg
