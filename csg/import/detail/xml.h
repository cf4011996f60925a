#pragma once
// Elements of XML documents, and what is wrong with those that are none.

#include <string_view>

#include <fmt/format.h>
#include <pugixml.hpp>

#include "base/file/format_error.h"
#include "base/file/xml.h"

namespace lamina::csg {

// throws  FormatError, whose message begins with `format`; std::bad_alloc
inline void parse_xml(std::string_view bytes, std::string_view format,
                      pugi::xml_document& document) {
  if (const auto fault = load_xml(bytes, document)) {
    throw FormatError(
        fmt::format("{} byte {}, {}", format, fault->place, fault->words));
  }
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
