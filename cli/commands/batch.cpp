// lamina batch: one design, a piece for every row of a table.

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/source.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/collect.h"
#include "cli/pieces/ledger.h"
#include "cli/pieces/piece_table.h"
#include "cli/pieces/pieces.h"
#include "cli/process/exit_status.h"
#include "cli/report/session.h"
#include "parser/loader.h"

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
                  the row, {row:/1000} that divided and rounded down, as in
                  out/{row:/1000}/{name}.slc
  --skip COLUMN   pass over a column; may be repeated
  --report FILE   what came of every piece: as JSON or, named .csv, as a table
  --shard K/N     make the K-th of N equal shares of the table alone
  --ledger FILE   append what came of every piece, a line each, as it is done
  --resume        pass over pieces that by the ledger were made from the same
                  design, row and options, and whose outputs are unchanged
  --collect LEDGER...
                  make nothing: say what by these ledgers is missing or failed
  -q, --quiet     say nothing but errors
  -h, --help      print this help

All other options of Output, Design, Slicing and Limits are those of
'lamina --help' and go for all pieces; cells go before -D. A piece that exceeds
--max-time or --max-memory ends the batch; pieces that are done stay.

Exit status: 0 all pieces are done, 1 a piece or the table is at fault, 2 usage,
130 interrupted.
)";

// Options that leave the bytes of an output as they are, or show in its name.
constexpr std::array<std::string_view, 12> kNeutralOptions = {
    "--table",   "-o",       "--skip",     "--shard",
    "--ledger",  "--resume", "--collect",  "--report",
    "--threads", "--quiet",  "--max-time", "--max-memory"};

Share parse_share(const std::string& text) {
  const std::size_t slash = text.find('/');
  const auto index = whole_number(std::string_view(text).substr(0, slash));
  const auto count =
      slash == std::string::npos
          ? std::nullopt
          : whole_number(std::string_view(text).substr(slash + 1));
  require(index && count && *index >= 1 && *index <= *count, "--shard",
          "a share was expected, such as 3/20, not '{}'", text);
  return {*index, *count};
}

class BatchCommand : public Command {
 public:
  std::string_view help() const override { return kBatchHelp; }

  void add_options(OptionList& options) override {
    options.word("design", table_.request.design.path).required();
    options.name("--table", "file", table_.table).required();
    options.name("-o", "pattern", table_.request.output.path).required();
    options.texts("--skip", "column", [this](const std::string& column) {
      table_.skipped.insert(column);
    });
    options.text("--shard", "share", [this](const std::string& text) {
      table_.share = parse_share(text);
    });
    const Option ledger = options.name("--ledger", "file", ledger_.path);
    options.flag("--resume", ledger_.resumes).needs(ledger);
    options.names("--collect", "ledger", ledgers_).excludes(ledger);
    add_output_options(options, table_.request, output_options_);
    add_design_options(options, table_.request, is_quiet_);
    add_slicing_options(options, table_.request);
    options_ = &options;
  }

  bool takes_settings() const override { return true; }

  void check() override {
    refuse_if(!table_.request.design.parameter_file.empty(),
              "batch takes values from --table, not from -p and -P");
    refuse_if(table_.request.output.path.find('{') == std::string::npos,
              "-o needs a pattern, such as 'out/{{name}}.slc' or "
              "'out/{{row}}.slc'");
    try {
      words_of_pattern(table_.request.output.path);
    } catch (const FileError& error) {
      throw RequestError(error.what());
    }
    table_.request.output.path =
        with_extension(table_.request, output_options_);
    OutputOptions output = output_options_;
    // A report of ledgers is none of layers.
    if (!ledgers_.empty()) output.report.clear();
    choose_format(table_.request, output, table_.request.output.path);
    table_.request.output.is_strict =
        table_.request.output.is_strict.value_or(true);
    refuse_if(ledger_.path == "-", "--ledger takes a file, not '-'");
    ledger_.asked = given_text(*options_, kNeutralOptions);
  }

  int run(const Context& context) override {
    Terminal terminal(is_quiet_);
    SourceStore sources;
    Diagnostics diagnostics([&](const Diagnostic& d) { terminal.show(d); });
    return run_caught(terminal, {&diagnostics}, [&] {
      const FileAccess& access = context.file_access();
      for (const std::string& folder : library_folders(access)) {
        ledger_.asked += fmt::format("library {}\n", folder);
      }
      context.expect_outputs({output_options_.report, ledger_.path});
      const auto pieces = open_table(table_, access, sources, diagnostics);
      if (diagnostics.has_errors()) return kFault;
      make_folder_of(output_options_.report, access);
      make_folder_of(ledger_.path, access);
      if (!ledgers_.empty()) {
        return collect_pieces(
            *pieces,
            {ledgers_, ledger_.asked, output_options_.report, is_quiet_},
            context);
      }
      return make(*pieces, context);
    });
  }

 private:
  int make(PieceSource& pieces, const Context& context) const {
    std::optional<Ledger> ledger;
    if (!ledger_.path.empty()) {
      ledger.emplace(ledger_, context.file_access());
    }
    return make_pieces(
        pieces,
        {"pieces", output_options_.report, table_.request.job.threads,
         is_quiet_, ledger ? &*ledger : nullptr},
        context);
  }

  TableOptions table_;
  LedgerOptions ledger_;
  std::vector<std::string> ledgers_;     // to collect
  const OptionList* options_ = nullptr;  // until check() is done
  OutputOptions output_options_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_batch_command() {
  return std::make_unique<BatchCommand>();
}

}  // namespace lamina::cli
