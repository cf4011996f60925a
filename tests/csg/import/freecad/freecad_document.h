#pragma once
// FreeCAD files for tests, made from a few words.

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/base/file/zip_writer.h"

namespace lamina::csg {

// <Property name="…">value</Property>
inline std::string property(const std::string& name, const std::string& value) {
  return fmt::format("<Property name=\"{}\">{}</Property>", name, value);
}
inline std::string number(const std::string& name, const std::string& value) {
  return property(name, fmt::format("<Float value=\"{}\"/>", value));
}
inline std::string flag(const std::string& name, bool is_set) {
  return property(name, fmt::format("<Bool value=\"{}\"/>", is_set));
}
inline std::string link(const std::string& name, const std::string& target) {
  return property(name, fmt::format("<Link value=\"{}\"/>", target));
}
inline std::string links(const std::string& name,
                         const std::vector<std::string>& targets) {
  std::string list;
  for (const std::string& target : targets) {
    list += fmt::format("<Link value=\"{}\"/>", target);
  }
  return property(name, "<LinkList>" + list + "</LinkList>");
}
inline std::string placement_at_x(const std::string& x) {
  return property("Placement",
                  fmt::format("<PropertyPlacement Px=\"{}\" Py=\"0\" Pz=\"0\" "
                              "Q0=\"0\" Q1=\"0\" Q2=\"0\" Q3=\"1\"/>",
                              x));
}
inline std::string vector(const std::string& name, const std::string& x,
                          const std::string& y, const std::string& z) {
  return property(name, fmt::format("<PropertyVector valueX=\"{}\" "
                                    "valueY=\"{}\" valueZ=\"{}\"/>",
                                    x, y, z));
}
inline std::string extension(const std::string& type) {
  return fmt::format("<Extensions><Extension type=\"{}\"/></Extensions>", type);
}
inline std::string label(const std::string& text) {
  return property("Label", fmt::format("<String value=\"{}\"/>", text));
}
inline std::string shape(const std::string& entry) {
  return property("Shape", fmt::format("<Part file=\"{}\"/>", entry));
}

// The texts and entries of a file.
class FreecadDocument {
 public:
  // extensions  see extension()
  FreecadDocument& add(const std::string& type, const std::string& name,
                       const std::string& properties,
                       const std::string& extensions = "") {
    objects_ += fmt::format("<Object type=\"{}\" name=\"{}\"/>", type, name);
    data_ += fmt::format(
        "<Object name=\"{}\">{}<Properties>{}</Properties></Object>", name,
        extensions, properties);
    return *this;
  }
  FreecadDocument& box(const std::string& name, const std::string& length = "3",
                       const std::string& more = "") {
    return add("Part::Box", name,
               number("Length", length) + number("Width", "4") +
                   number("Height", "5") + more);
  }
  FreecadDocument& entry(const std::string& name, const std::string& bytes) {
    entries_.emplace_back(name, bytes);
    return *this;
  }

  std::string xml() const {
    return "<?xml version='1.0' encoding='utf-8'?><Document "
           "SchemaVersion=\"4\">"
           "<Objects>" +
           objects_ + "</Objects><ObjectData>" + data_ +
           "</ObjectData></Document>";
  }
  std::string bytes() const {
    std::vector<std::pair<std::string, std::string>> entries = {
        {"Document.xml", xml()}};
    entries.insert(entries.end(), entries_.begin(), entries_.end());
    return make_zip(entries);
  }

 private:
  std::string objects_;
  std::string data_;
  std::vector<std::pair<std::string, std::string>> entries_;
};

}  // namespace lamina::csg
