#include "cli/options/output_options.h"

#include "cli/options/contradictions.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "slicer/formats/output_format.h"

namespace lamina::cli {

void add_output_options(CLI::App& app, compiler::Request& request,
                        OutputOptions& options) {
  app.add_option("--export-format", options.export_format)->type_name("format");
  add_choice(
      app, "--cli", {"binary", "ascii"}, [&request](const std::string& word) {
        request.cli_encoding = word == "ascii" ? slicer::CliEncoding::kAscii
                                               : slicer::CliEncoding::kBinary;
      });
  app.add_option("--printer", request.printer)->type_name("printer");
  add_choice(app, "--mirror", {"x", "y", "xy"},
             [&request](const std::string& axes) {
               request.mirrors_x = axes != "y";
               request.mirrors_y = axes != "x";
             });
  app.add_option("--report", options.report)->type_name("file");
  add_thin_width(app, request.settings.min_feature);
  add_layer_range(app, request.settings.written);
}

void choose_format(compiler::Request& request, const OutputOptions& options,
                   const std::string& output) {
  const slicer::FormatChoice choice = slicer::choose_output_format(
      options.export_format.empty() ? output : options.export_format);
  if (!choice.format) {
    throw UsageError(choice.complaint, choice.is_known ? kFault : kUsageFault);
  }
  request.format = *choice.format;
  refuse_contradictions(request.settings);
  refuse_misfits(request, !options.report.empty());
}

}  // namespace lamina::cli
