#pragma once
// XML documents. Entities that a document defines itself are not expanded, so
// none can be made to grow; no other file is read.

#include <new>
#include <string>
#include <string_view>

#include <pugixml.hpp>

#include "csg/import/format_error.h"

namespace lamina::csg {

// What pugixml would take several times the memory of is refused.
constexpr std::size_t kMostXmlBytes = std::size_t{1} << 31;

// throws  FormatError, whose message begins with `format`
inline void parse_xml(std::string_view bytes, const std::string& format,
                      pugi::xml_document& document) {
  if (bytes.size() > kMostXmlBytes) throw FormatError(format + " is too large");
  const pugi::xml_parse_result result =
      document.load_buffer(bytes.data(), bytes.size());
  if (result) return;
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  throw FormatError(format + " byte " + std::to_string(result.offset) + ", " +
                    result.description());
}

// The name without a namespace's prefix.
inline std::string_view local_name(const pugi::xml_node& node) {
  const std::string_view name = node.name();
  return name.substr(name.rfind(':') + 1);
}

// Calls visit(child) for each child element of that name.
template <typename Visit>
void for_each_child(const pugi::xml_node& node, std::string_view name,
                    Visit visit) {
  for (const pugi::xml_node child : node.children()) {
    if (local_name(child) == name) visit(child);
  }
}

}  // namespace lamina::csg
