// lamina orient: how a part should lie.

#include "compiler/orient.h"

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
#include "cli/options/option_values.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "cli/report/run_report.h"
#include "cli/report/session.h"
#include "compiler/stage_text.h"
#include "compiler/validate.h"
#include "slicer/picture/front_picture.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::json;

constexpr std::string_view kOrientHelp =
    R"(Usage: lamina orient DESIGN [-o FILE] [OPTION]...

Judges hundreds of directions in which DESIGN can be built, each by its islands,
overhangs and suction cups, the best also by the supports that it would need, and
lists those that no other beats in everything. Slice with the --orient of the
one you like. Ctrl-C lists what has been judged until then; a second one ends.

  -o FILE             write the list as a page with pictures (.html) or JSON
                      (.json)
  --directions N      how many are judged, 20 to 10000 [300]
  --supports          how thick the tips of supports are, as for slicing
  -q, --quiet         print errors only
  -h, --help          print this help

All options of Design and Slicing are those of 'lamina --help', but for those
that say how the design lies, --adaptive and --heights.
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
    // What has no say in which direction is good.
    for (const char* name :
         {"--metal", "--price", "--min-feature", "--fail-on"}) {
      options.remove(name);
    }
  }

  bool takes_settings() const override { return true; }

  void check() override {
    require_page_or_json("orient", output_);
    refuse_layers(request_.design.path);
    refuse_if(request_.job.cusp > 0 || !request_.job.heights.empty(),
              "orient compares layers of one thickness");
    refuse_if(request_.geometry.up ||
                  request_.geometry.searched_direction > 0 ||
                  request_.geometry.axis != "z" || request_.geometry.turn != 0,
              "orient finds what --axis, --orient or --turn would say");
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
      options.on_progress = [&](std::uint64_t done, std::uint64_t all) {
        ProgressLine& line = session.terminal.progress();
        if (done == 1) line.begin(all, "directions");
        line.show(done);
      };
      if (output_.ends_with(".html")) options.draw = slicer::front_svg;
      options.should_stop = [&] { return context.interrupt.asks_to_end(); };
      const auto found =
          compiler::find_orientations(session.compilation, options);
      context.interrupt.stop_asking();
      if (!found) return kFault;
      session.terminal.progress().erase();
      if (found->listed.empty()) return kInterrupted;
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
  // What supports would be is not known where none were planned.
  static std::string row_of(const compiler::JudgedDirection& one,
                            bool has_visible, std::string_view last) {
    const auto planned = [&](auto figure) {
      return one.is_planned ? fmt::format("{:.4g}", static_cast<double>(figure))
                            : "-";
    };
    return fmt::format(
        "{:>7.2f} {:>7} {:>8} {:>10}{} {:>10} {:>8} {:>6.4g}  {}\n", one.height,
        one.islands, planned(one.contacts), planned(one.contact_area),
        has_visible ? fmt::format(" {:>8}", planned(one.visible_area)) : "",
        planned(one.support_volume), planned(one.unheld), one.cups, last);
  }

  std::string judged_line(const compiler::OrientResult& found) const {
    if (!found.is_stopped) {
      return fmt::format(
          "{} judged; supports planned for the best; each below is better than "
          "all others in something\n",
          counted(found.judged, "direction"));
    }
    const compiler::OrientOptions usual;
    return fmt::format(
        "interrupted: {} of {} directions judged, supports planned for {}; "
        "each below is better than all others in something\n",
        found.judged, directions_.value_or(usual.directions), found.planned);
  }

  std::string table_of(const compiler::OrientResult& found) const {
    const bool has_visible = found.has_visible;
    std::string text =
        judged_line(found) +
        fmt::format(
            " height islands contacts  touch mm²{} resin mm³   unheld  "
            " cups  --orient\n"
            "     mm                              {}                   "
            "   mm³\n",
            has_visible ? " seen mm²" : "", has_visible ? "         " : "");
    for (const auto& one : found.listed) {
      text += row_of(one, has_visible, compiler::direction_text(one.up));
    }
    if (found.drawn) {
      text += row_of(*found.drawn, has_visible, "0,0,1 (as drawn)");
    }
    return text;
  }

  static Json json_row(const compiler::JudgedDirection& one) {
    Json row = {{"orient", {one.up.x, one.up.y, one.up.z}},
                {"height_mm", one.height},
                {"islands", one.islands},
                {"overhang_mm2", one.overhang},
                {"cups_mm3", one.cups}};
    if (!one.is_planned) return row;
    row.update({{"layers", one.layers},
                {"contacts", one.contacts},
                {"contact_area_mm2", one.contact_area},
                {"seen_area_mm2", one.visible_area},
                {"support_volume_mm3", one.support_volume},
                {"unheld", one.unheld},
                {"seconds", one.seconds}});
    return row;
  }

  static std::string json_of(const compiler::OrientResult& found) {
    Json rows = Json::array();
    for (const auto& one : found.listed) rows.push_back(json_row(one));
    return json_text({{"judged", found.judged},
                      {"planned", found.planned},
                      {"interrupted", found.is_stopped},
                      {"drawn", found.drawn ? json_row(*found.drawn) : Json()},
                      {"listed", std::move(rows)}});
  }

  static std::string card_of(const compiler::JudgedDirection& one,
                             std::string_view title) {
    std::string facts = fmt::format("{:.2f} mm high", one.height);
    if (one.is_planned) {
      facts += fmt::format(", {} contacts ({:.3g} mm²), {:.4g} mm³ of supports",
                           one.contacts, one.contact_area, one.support_volume);
    }
    if (one.cups > 0) facts += fmt::format(", cups of {:.3g} mm³", one.cups);
    if (one.unheld > 0) facts += fmt::format(", {} unheld", one.unheld);
    if (one.seconds > 0) {
      facts += fmt::format(", {:.1f} h", one.seconds / 3600);
    }
    return fmt::format(
        "<figure>{}<figcaption><code>--orient {}</code>{}<br>{}</figcaption>"
        "</figure>\n",
        one.picture, compiler::direction_text(one.up), title, facts);
  }

  std::string page_of(const compiler::OrientResult& found) const {
    std::string page =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">"
        "<meta name=\"viewport\" content=\"width=device-width\">"
        "<title>Orientations</title><style>body{font:14px sans-serif;margin:"
        "1.5em}main{display:grid;gap:1.5em;grid-template-columns:repeat("
        "auto-fill,minmax(15em,1fr))}figure{margin:0;border:1px solid #ccc;"
        "border-radius:8px;padding:1em}svg{width:100%;height:14em}figcaption"
        "{margin-top:.5em}</style></head><body><main>\n";
    for (const auto& one : found.listed) page += card_of(one, "");
    if (found.drawn) page += card_of(*found.drawn, " (as drawn)");
    page += "</main>";
    if (found.is_stopped) page += "<p>" + judged_line(found) + "</p>";
    return page + "</body></html>\n";
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
