// FreeCAD files, to the CSG tree and its text.
//
// Compressed bytes are hard to change with sense, so an input that is no
// archive is taken for the Document.xml of one.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include <zlib.h>

#include "base/file/format_error.h"
#include "base/file/zip.h"
#include "csg/csg_printer.h"
#include "csg/import/freecad/freecad_file.h"
#include "csg/limits.h"
#include "tests/fuzz/input.h"

using namespace lamina;

namespace {

void append_number(std::uint32_t number, int bytes, std::string& text) {
  for (int i = 0; i < bytes; ++i) {
    text += static_cast<char>(number >> (8 * i) & 0xFF);
  }
}

// What a local header and the directory say alike of an entry.
std::string describe(std::string_view name, std::string_view contents) {
  std::string text;
  append_number(20, 2, text);  // version; no flags, method, time
  text.append(8, '\0');
  const auto size = static_cast<std::uint32_t>(contents.size());
  append_number(static_cast<std::uint32_t>(
                    crc32(0, reinterpret_cast<const Bytef*>(contents.data()),
                          static_cast<uInt>(size))),
                4, text);
  append_number(size, 4, text);
  append_number(size, 4, text);
  append_number(static_cast<std::uint32_t>(name.size()), 2, text);
  append_number(0, 2, text);
  return text;
}

// An archive of one entry that is not compressed.
std::string store(std::string_view name, std::string_view contents) {
  const std::string about = describe(name, contents);
  std::string text = "PK\3\4" + about;
  text.append(name).append(contents);
  const auto directory = static_cast<std::uint32_t>(text.size());
  text += "PK\1\2";
  append_number(20, 2, text);
  text += about;
  text.append(14, '\0');  // comment, disk, attributes, offset
  text += name;
  const auto size = static_cast<std::uint32_t>(text.size()) - directory;
  text += "PK\5\6";
  append_number(0, 4, text);
  append_number(1, 2, text);
  append_number(1, 2, text);
  append_number(size, 4, text);
  append_number(directory, 4, text);
  append_number(0, 2, text);
  return text;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data,
                                      std::size_t size) {
  std::string bytes(fuzz::as_text(data, size));
  if (!ZipArchive::is_zip(bytes)) {
    bytes = store("Document.xml", bytes);
  }
  csg::Tree tree;
  tree.arena = std::make_shared<Arena>();
  csg::FreecadOptions options;
  options.most_leaves = 1000;
  options.boundary_text = [](std::string_view, std::string_view name) {
    return std::string(name);
  };
  try {
    const csg::FreecadModel model =
        csg::read_freecad(bytes, options, *tree.arena);
    csg::Node root;
    root.op = csg::Group{};
    root.children = model.nodes;
    tree.root = &root;
    csg::print_csg(tree, root);
  } catch (const FormatError&) {
  } catch (const plane::LimitExceeded&) {
  }
  return 0;
}
