// lamina parts: what a file of several parts holds.

#include "compiler/parts.h"

#include <algorithm>
#include <string>

#include <fmt/format.h>

#include "base/diagnostic.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kPartsHelp =
    R"(Usage: lamina parts FILE

Lists the parts of a FreeCAD file or a 3MF: the name and the label, either of
which --part takes, what each is, and whether the file shows it. 'lamina
FILE --part NAME' slices one part alone, shown or hidden.

  -h, --help  print this help
)";

class PartsCommand : public Command {
 public:
  std::string_view help() const override { return kPartsHelp; }

  void add_options(OptionList& options) override {
    options.word("file", path_).required();
  }

  void check() override {
    if (compiler::has_parts(path_)) return;
    throw compiler::RequestError(fmt::format(
        "parts lists those of a .FCStd or .3mf, not of '{}'", path_));
  }

  int run(const Context& context) override {
    context.expect_outputs({"-"});
    try {
      print_out(table(
          compiler::parts_of(path_, context.temporary_files.file_access())));
    } catch (const Error& fault) {
      print_error(caret_text(fault.diagnostic()));
      return kFault;
    }
    return kDone;
  }

 private:
  static std::string table(const std::vector<compiler::FilePart>& parts) {
    std::size_t name_width = 4;
    std::size_t label_width = 5;
    for (const compiler::FilePart& part : parts) {
      name_width = std::max(name_width, part.name.size());
      label_width = std::max(label_width, part.label.size());
    }
    std::string text = fmt::format("{:<{}}  {:<{}}  shown   what\n", "name",
                                   name_width, "label", label_width);
    for (const compiler::FilePart& part : parts) {
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
