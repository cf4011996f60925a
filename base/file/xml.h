#pragma once
// XML documents. Entities that a document defines itself are not expanded, so
// none can be made to grow; no other file is read.

#include <cstddef>
#include <new>
#include <optional>
#include <string_view>

#include <pugixml.hpp>

namespace lamina {

// Larger files are refused: pugixml takes several times their memory.
constexpr std::size_t kMostXmlBytes = std::size_t{1} << 31;

struct XmlFault {
  std::size_t place = 0;  // of the byte where it is
  std::string_view words;
};

// Makes `document` of the bytes.
//
// options  of pugixml, what it keeps of a document
// returns  why they are none
// throws   std::bad_alloc
inline std::optional<XmlFault> load_xml(
    std::string_view bytes, pugi::xml_document& document,
    unsigned options = pugi::parse_default) {
  if (bytes.size() > kMostXmlBytes) return {{0, "the file is too large"}};
  const pugi::xml_parse_result result =
      document.load_buffer(bytes.data(), bytes.size(), options);
  if (result.status == pugi::status_out_of_memory) throw std::bad_alloc();
  if (result) return std::nullopt;
  return {{static_cast<std::size_t>(result.offset), result.description()}};
}

// A name of an element or attribute without the prefix of its namespace.
inline std::string_view local_name(std::string_view name) {
  return name.substr(name.rfind(':') + 1);
}
inline std::string_view local_name(const pugi::xml_node& node) {
  return local_name(std::string_view(node.name()));
}

// Calls visit(child) for each child element of that name, whatever its prefix.
template <typename Visit>
void for_each_child(const pugi::xml_node& node, std::string_view name,
                    Visit visit) {
  for (const pugi::xml_node child : node.children()) {
    if (local_name(child) == name) visit(child);
  }
}

}  // namespace lamina
