#include "cli/options/output_options.h"

#include "cli/command.h"
#include "cli/options/contradictions.h"
#include "cli/options/option_values.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {

void add_output_options(CLI::App& app, DesignOptions& options,
                        std::string& export_format) {
  app.add_option("--export-format", export_format)->type_name("format");
  add_choice(
      app, "--cli", {"binary", "ascii"}, [&options](const std::string& word) {
        options.cli_encoding = word == "ascii" ? slicer::CliEncoding::kAscii
                                               : slicer::CliEncoding::kBinary;
      });
  app.add_option("--printer", options.printer)->type_name("printer");
  add_choice(app, "--mirror", {"x", "y", "xy"},
             [&options](const std::string& axes) {
               options.mirrors_x = axes != "y";
               options.mirrors_y = axes != "x";
             });
  app.add_option("--report", options.report)->type_name("file");
  add_thin_width(app, options.settings.min_feature);
  add_layer_range(app, options.settings.written);
}

void choose_format(DesignOptions& options, const std::string& export_format,
                   const std::string& output) {
  const slicer::FormatChoice choice = slicer::choose_output_format(
      export_format.empty() ? output : export_format);
  if (!choice.format) {
    throw UsageError(choice.complaint, choice.is_known ? kFault : kUsageFault);
  }
  options.format = *choice.format;
  if (const char* contradiction = find_contradiction(options.settings)) {
    throw UsageError(contradiction);
  }
  if (const char* misfit = find_misfit(options)) throw UsageError(misfit);
}

}  // namespace lamina::cli
