// lamina parts: what a file of several parts holds.

#include <algorithm>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/file/format_error.h"
#include "base/file/module.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/run_report.h"
#include "compiler/request.h"
#include "compiler/validate.h"
#include "csg/cad/cad_reader.h"
#include "csg/import/freecad/freecad_file.h"
#include "csg/import/mesh_file.h"
#include "plane/limits.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kPartsHelp =
    R"(Usage: lamina parts FILE

Lists the parts of a file of a CAD program or a 3MF: the name and the label,
either of which --part takes, what each is, and whether the file shows it.
'lamina FILE --part NAME' slices one part alone, shown or hidden.

  -h, --help  print this help
)";

struct Part {
  std::string name;   // for --part; so is the label
  std::string label;  // what its author calls it; empty: nothing else
  std::string what;   // "Part::Box", "12 triangles"
  bool is_shown = true;
};

// Solids have numbers, and the names of products, of which several may be one.
std::vector<Part> read_solids(std::string_view bytes, cad::Format format) {
  Diagnostics diagnostics;
  cad::Reader reader(module_folders(), diagnostics);
  std::vector<Part> parts;
  for (cad::Body& body : reader.read(bytes, format, {}).bodies) {
    Box3 box;
    box.add(std::span<const Vec3>(body.mesh.vertices));
    parts.push_back({std::to_string(parts.size() + 1), std::move(body.name),
                     size_text(box.size())});
  }
  return parts;
}

std::vector<Part> read_parts(const std::string& path, std::string_view bytes) {
  const csg::ImportFormat format = csg::import_format_of_file(path);
  std::vector<Part> parts;
  if (format == csg::ImportFormat::kFcstd) {
    for (csg::FreecadPart& part : csg::freecad_parts(bytes)) {
      const bool has_label = part.label != part.name;
      parts.push_back({std::move(part.name), has_label ? part.label : "",
                       std::move(part.type), part.is_visible});
    }
    return parts;
  }
  if (csg::is_cad(format)) return read_solids(bytes, cad::format_of(format));
  for (const csg::ThreemfPart& part : csg::threemf_parts(bytes)) {
    parts.push_back({part.id, part.name,
                     part.triangles == 0
                         ? "made of others"
                         : counted(part.triangles, "triangle", "triangles"),
                     part.count > 0});
  }
  return parts;
}

// Throws FileError where the file cannot be read or is broken.
std::vector<Part> parts_of(const std::string& path, const FileAccess& access) {
  access.require(path);
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    throw FileError(fmt::format("Can't open input file '{}'!", path));
  }
  std::string fault;
  try {
    return read_parts(path, *bytes);
  } catch (const FormatError& error) {
    fault = error.what();
  } catch (const plane::LimitExceeded& error) {
    fault = error.diagnostic().message;
  }
  throw FileError(fmt::format("{}, reading '{}'", on_one_line(fault), path));
}

class PartsCommand : public Command {
 public:
  std::string_view help() const override { return kPartsHelp; }

  void add_options(OptionList& options) override {
    options.word("file", path_).required();
  }

  void check() override {
    if (compiler::has_parts(path_)) return;
    throw compiler::RequestError(fmt::format(
        "parts lists those of a CAD file or a 3MF; '{}' is neither", path_));
  }

  int run(const Context& context) override {
    context.expect_outputs({"-"});
    try {
      print_out(table(parts_of(path_, context.temporary_files.file_access())));
    } catch (const Error& fault) {
      print_error(caret_text(fault.diagnostic()));
      return kFault;
    }
    return kDone;
  }

 private:
  static std::string table(const std::vector<Part>& parts) {
    std::size_t name_width = 4;
    std::size_t label_width = 5;
    for (const Part& part : parts) {
      name_width = std::max(name_width, part.name.size());
      label_width = std::max(label_width, part.label.size());
    }
    std::string text = fmt::format("{:<{}}  {:<{}}  shown   what\n", "name",
                                   name_width, "label", label_width);
    for (const Part& part : parts) {
      text += fmt::format("{:<{}}  {:<{}}  {:<6}  {}\n", on_one_line(part.name),
                          name_width, on_one_line(part.label), label_width,
                          part.is_shown ? "yes" : "no", on_one_line(part.what));
    }
    return text;
  }

  std::string path_;
};

}  // namespace

std::unique_ptr<Command> make_parts_command() {
  return std::make_unique<PartsCommand>();
}

}  // namespace lamina::cli
