// lamina batch: one design, a piece for every row of a table.

#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base/source.h"
#include "cli/commands/commands.h"
#include "cli/commands/piece_table.h"
#include "cli/commands/pieces.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/report/session.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kBatchHelp =
    R"(Usage: lamina batch DESIGN --table TABLE -o PATTERN [OPTION]...

Makes a piece for every row of a table: the header of a .csv file names
variables of the design, every row gives their values. Of a .json file of
OpenSCAD's customizer, every parameter set is a piece. A bad row never stops
the rest. A piece with a warning is not written, unless --no-strict.

  --table TABLE   the table: .csv (with commas, semicolons or tabs) or .json
  -o PATTERN      the outputs: {name} or any other column, {row} the number of
                  the row, as in out/{name}.slc
  --skip COLUMN   pass over a column; may be repeated
  --report FILE   what came of every piece: as JSON or, named .csv, as a table
  -q, --quiet     say nothing but errors
  -h, --help      print this help

All other options of Output, Design, Slicing and Limits are those of
'lamina --help' and go for all pieces; cells go before -D. A piece that exceeds
--max-time or --max-memory ends the batch; pieces that are done stay.

Exit status: 0 all pieces are done, 1 a piece or the table is at fault, 2 usage,
130 interrupted.
)";

class BatchCommand : public Command {
 public:
  std::string_view help() const override { return kBatchHelp; }

  void add_options(CLI::App& app) override {
    app.add_option("design", table_.request.design)->required();
    app.add_option("--table", table_.table)->type_name("file")->required();
    app.add_option("-o", table_.request.output)
        ->type_name("pattern")
        ->required();
    make_repeatable(app.add_option("--skip", skipped_)->type_name("column"));
    add_output_options(app, table_.request, output_options_);
    add_design_options(app, table_.request, is_quiet_);
    add_slicing_options(app, table_.request);
  }

  void check() override {
    refuse_if(!table_.request.parameter_file.empty(),
              "batch takes values from --table, not from -p and -P");
    refuse_if(table_.request.output.find('{') == std::string::npos,
              "-o needs a pattern, such as 'out/{{name}}.slc' or "
              "'out/{{row}}.slc'");
    choose_format(table_.request, output_options_, table_.request.output);
    table_.request.is_strict = table_.request.is_strict.value_or(true);
    table_.skipped.insert(skipped_.begin(), skipped_.end());
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    SourceStore sources;
    Diagnostics diagnostics([&](const Diagnostic& d) { terminal.show(d); });
    return run_caught(terminal, diagnostics, [&] {
      const std::vector<Piece> pieces =
          read_pieces(table_, context.file_access(), sources, diagnostics);
      if (diagnostics.has_errors()) return kFault;
      return make_pieces(pieces,
                         {"pieces", output_options_.report,
                          table_.request.settings.threads, is_quiet_},
                         context);
    });
  }

 private:
  TableOptions table_;
  std::vector<std::string> skipped_;
  OutputOptions output_options_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_batch_command() {
  return std::make_unique<BatchCommand>();
}

}  // namespace lamina::cli
