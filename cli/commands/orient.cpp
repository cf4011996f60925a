// lamina orient: how a part should lie.

#include "compiler/tasks/orient.h"

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/options/design_options.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/stage_text.h"
#include "compiler/validate.h"

namespace lamina::cli {
namespace {

using nlohmann::json;

constexpr std::string_view kOrientHelp =
    R"(Usage: lamina orient DESIGN [-o FILE] [OPTION]...

Judges hundreds of directions in which DESIGN can be built, each by its islands,
overhangs and suction cups, the best also by the supports that it would need, and
lists those that no other beats in everything. Slice with the --orient of the
one you like.

  -o FILE             write the list as a page with pictures (.html) or JSON
                      (.json)
  --directions N      how many are judged, 20 to 10000 [300]
  --supports          how thick the tips of supports are, as for slicing
  -q, --quiet         print errors only
  -h, --help          print this help

All options of Design and Slicing are those of 'lamina --help'.
)";

class OrientCommand : public Command {
 public:
  std::string_view help() const override { return kOrientHelp; }

  void add_options(OptionList& options) override {
    options.word("design", request_.design.path).required();
    options.name("-o", "file", output_);
    options.whole("--directions", directions_, 20, 10000);
    add_machine_options(options, request_);
    add_print_options(options, request_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
  }

  bool takes_settings() const override { return true; }

  void check() override {
    refuse_if(!output_.empty() && !output_.ends_with(".html") &&
                  !output_.ends_with(".json"),
              "orient writes .html or .json; '{}' is neither", output_);
    refuse_if(request_.job.cusp > 0 || !request_.job.heights.empty(),
              "orient compares layers of one thickness");
    refuse_if(request_.geometry.up || request_.geometry.axis != "z",
              "orient finds what --axis or --orient would say");
    // Its sizes; the design itself is judged without supports.
    sizes_ = request_.supports;
    request_.supports.reset();
    compiler::validate(request_);
  }

  int run(const Context& context) override {
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs({output_});
      compiler::OrientOptions options;
      options.sizes = sizes_;
      if (directions_) options.directions = *directions_;
      options.on_progress = session.compilation.on_progress;
      const auto found =
          compiler::find_orientations(session.compilation, options);
      if (!found) return kFault;
      session.terminal.progress().erase();
      if (!is_quiet_) print_out(table_of(*found));
      if (!output_.empty()) {
        compiler::write_file(
            output_,
            output_.ends_with(".json") ? json_of(*found) : page_of(*found),
            context.temporary_files);
      }
      return kDone;
    });
  }

 private:
  // "-0.25,0.5,0.829": as exact as a tenth of a degree.
  static std::string words_of(Vec3 up) {
    std::string words;
    for (int i = 0; i < 3; ++i) {
      const double value = std::round(up[i] * 1000) / 1000 + 0.0;
      words += fmt::format("{}{:g}", i > 0 ? "," : "", value);
    }
    return words;
  }

  static std::string row_of(const compiler::JudgedDirection& one,
                            std::string_view first) {
    return fmt::format(
        "{:>7} {:>7} {:>8} {:>10.4g} {:>10.4g} {:>8} {:>6.4g}  {}\n",
        fmt::format("{:.2f}", one.height), one.islands, one.contacts,
        one.contact_area, one.support_volume, one.unheld, one.cups, first);
  }

  std::string table_of(const compiler::OrientResult& found) const {
    std::string text = fmt::format(
        "{} judged; supports planned for the best; each below is better than "
        "all others in something\n"
        " height islands contacts  touch mm² resin mm³   unheld   cups  "
        "--orient\n"
        "     mm                                                    mm³\n",
        counted(found.judged, "direction"));
    for (const auto& one : found.listed) text += row_of(one, words_of(one.up));
    return text + row_of(found.drawn, "0,0,1 (as drawn)");
  }

  static json json_row(const compiler::JudgedDirection& one) {
    return {{"orient", {one.up.x, one.up.y, one.up.z}},
            {"height_mm", one.height},
            {"layers", one.layers},
            {"islands", one.islands},
            {"overhang_mm2", one.overhang},
            {"cups_mm3", one.cups},
            {"contacts", one.contacts},
            {"contact_area_mm2", one.contact_area},
            {"support_volume_mm3", one.support_volume},
            {"unheld", one.unheld},
            {"seconds", one.seconds}};
  }

  static std::string json_of(const compiler::OrientResult& found) {
    json rows = json::array();
    for (const auto& one : found.listed) rows.push_back(json_row(one));
    return json_text({{"judged", found.judged},
                      {"drawn", json_row(found.drawn)},
                      {"listed", std::move(rows)}});
  }

  static std::string card_of(const compiler::JudgedDirection& one,
                             std::string_view title) {
    std::string facts = fmt::format(
        "{:.2f} mm high, {} contacts ({:.3g} mm²), {:.4g} mm³ of supports",
        one.height, one.contacts, one.contact_area, one.support_volume);
    if (one.cups > 0) facts += fmt::format(", cups of {:.3g} mm³", one.cups);
    if (one.unheld > 0) facts += fmt::format(", {} unheld", one.unheld);
    if (one.seconds > 0) {
      facts += fmt::format(", {:.1f} h", one.seconds / 3600);
    }
    return fmt::format(
        "<figure>{}<figcaption><code>--orient {}</code>{}<br>{}</figcaption>"
        "</figure>\n",
        one.picture, words_of(one.up), title, facts);
  }

  static std::string page_of(const compiler::OrientResult& found) {
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\">"
        "<title>Orientations</title><style>body{font:14px sans-serif;margin:"
        "1.5em}main{display:grid;gap:1.5em;grid-template-columns:repeat("
        "auto-fill,minmax(15em,1fr))}figure{margin:0;border:1px solid #ccc;"
        "border-radius:8px;padding:1em}svg{width:100%;height:14em}figcaption"
        "{margin-top:.5em}</style></head><body><main>\n";
    for (const auto& one : found.listed) page += card_of(one, "");
    return page + card_of(found.drawn, " (as drawn)") +
           "</main></body></html>\n";
  }

  compiler::Request request_;
  std::optional<slicer::SupportSizes> sizes_;
  std::string output_;
  std::optional<unsigned> directions_;
  bool is_quiet_ = false;
};

}  // namespace

std::unique_ptr<Command> make_orient_command() {
  return std::make_unique<OrientCommand>();
}

}  // namespace lamina::cli
