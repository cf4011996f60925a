// lamina DESIGN: from a design to layers, or to the text of a stage before.

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/paths.h"
#include "base/similar.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/commands/watch.h"
#include "cli/options/design_options.h"
#include "cli/options/option_values.h"
#include "cli/options/output_pattern.h"
#include "cli/pieces/pieces.h"
#include "cli/process/exit_status.h"
#include "cli/report/run_report.h"
#include "compiler/request.h"
#include "slicer/dump/layer_dump.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/printer.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kCommonHelp =
    R"(lamina compiles OpenSCAD designs straight to the layers of a 3D printer.

Usage:
  lamina DESIGN... [-o FILE] [OPTION]...  slice .scad, .csg, meshes, CAD files
  lamina studio DESIGN                    change it in a browser, as it prints
  lamina serve --root FOLDER              quote its designs to other programs
  lamina batch DESIGN --table T -o NAMES  make a piece for every row of a table
  lamina plate DESIGN... -o PLATES        lay many pieces on plates
  lamina orient DESIGN                    find how it should lie
  lamina check FILE... [OPTION]...        say whether it would print
  lamina inspect FILE [OPTION]...         list layers, measure and weigh them
  lamina compare A B [OPTION]...          compare two files or designs
  lamina view FILE -o PICTURE.png         draw a layer file or a design
  lamina supports DESIGN -o NEW.scad      write it with supports, as a design
  lamina parts FILE                       list the parts of a CAD file or a 3MF
  lamina config [DESIGN]                  show your own defaults of options
  lamina preflight DESIGN --metal METAL   say what a casting house asks
  lamina sprue DESIGN -o NEW.scad         write it with sprues for casting
  lamina tree DESIGN... -o TREE.scad      set pieces on trunks, for flasks
  lamina printers                         list the printers that lamina knows
  lamina materials                        list its resins and metals

Output:
  -o FILE             the output, by its extension, or '-' for standard output;
                      for several designs a folder (out/) or a pattern
                      (out/{name}.slc) [ring.slc, or what --printer reads]
                        .slc             layers for wax and resin printers
                        .cli             Common Layer Interface
                        .svg             polygons per layer, or a 2D design
                        .png             a picture, or images in a folder
                        .sl1             images for Prusa's resin printers
                        .goo .ctb .zip   images for Elegoo, ChiTuBox, NanoDLP
                        .slices.3mf      a stack of slices
                        .layers.json     layers as JSON, in full precision
                        .csg .echo .ast .param  tree, echoes, syntax, parameters
  --printer P         a name of 'lamina printers', or a profile: fit, time
  --material M        likewise the resin or wax: exposure, weight, price
  --metal M           the metal that is cast from it: weight, price
  --price PRICES      of these: 60/l, 55/kg, 62.5/g, '1900 EUR/oz' (troy ounce)

Design:
  -D NAME=VALUE       set a variable of the design; may be repeated
  -p FILE -P SET      set its parameters from a file of the customizer
  --part NAME         slice one part of a CAD file or a 3MF ('lamina parts')
  --strict, --no-strict
                      treat warnings as errors, or not [batches and --root do]
  --watch             slice again whenever a file changes; Ctrl-C ends

Slicing (lengths in millimetres):
  --layer MM          thickness of a layer [0.05]
  --adaptive CUSP     adaptive layers, with steps on the surface of CUSP at most
  --axis AXIS         direction of building: z, x, y, -x, -y, -z, or auto: the
                      one that fits and has the fewest steps [z]
  --supports          add supports; =light for tips of 0.25 mm, =medium 0.3,
                      =heavy 0.4 or a diameter; =heavy,raft on a raft [medium]
  --hollow MM         hollow the part, with walls of MM and drains (--help-all)
  --sprue             add sprues for casting, as 'lamina sprue' does
  --scale FACTOR      enlarge it where castings shrink: 1.02, or X,Y,Z [1]
  --compensate MM     move contours inwards; foot=MMxLAYERS: first layers more;
                      bleed=MM: undersides up; 0.03,foot=0.1x3,bleed=0.05 [0]

Checks:
  --min-feature MM    report walls and gaps thinner than this
  --fail-on KINDS     write nothing if the print has islands, loose-parts,
                      overhangs, suction-cups, resin-traps or all of them
  --report FILE       write counts, times, tolerances and all findings as JSON

Messages:
  -q, --quiet         print errors only
  -h, --help          print this help
  --help-all          print all options: rare ones, limits, the paper's method
  -v, --version       print the version

)";

constexpr std::string_view kRareHelp =
    R"(More output:
  --export-format F   one of the formats above, whatever the output's name
  --mirror x|y|xy     mirror the images
  --cli ENCODING      binary or ascii .cli [binary]
  -d FILE             write what the output depends on, as a rule for make

More of the design:
  --language WORD     the OpenSCAD that the design is written for: 2021
                      (2021.01), 2026, or auto: 2026 if 2021.01 cannot parse it,
                      or if what runs does nothing there [auto]
  --check-parameters true|false
                      warn of arguments that a module does not take [true]
  --check-parameter-ranges true|false
                      warn of numbers out of range [false]
  --hardwarnings      stop at the first warning
  --seed N            seed of rands() where the design gives none [0]
  --render            set $preview to false, whatever the output
  --preview           undo --render
  --backend NAME, --enable FEATURE
                      change nothing: openscad's scripts give them

More of slicing:
  --orient X,Y,Z|best|N
                      what of the design points up, as 'lamina orient' finds
                      it; best or N searches in the run and takes the first or
                      N-th of that list
  --turn DEG          turn the design about the axis, anticlockwise seen from
                      above [0]
  --place-on-bed      put the lowest point of the design at height 0
  --hollow-closing MM leave places of cavities solid that a ball of this radius
                      does not reach [0]
  --drain none|MM|X,Y,Z,MM
                      drains of --hollow: none, how wide, or where in the
                      design; several may be given [two each, 1.2 mm wide in
                      parts up to 40 mm, else 2]
  --drain-plug        add what drains take away, to be glued in again
  --support-on LINES  support only what these lines of the design make: 12, or
                      lib.scad:12, separated by commas
  --no-support-on LINES
                      add no supports to what these lines make
  --max-layer MM      greatest thickness of adaptive layers [4 times --layer]
  --heights Z1,Z2,... cut at exactly these heights (ascending) instead
  --layers A:B        write layers A to B only, numbered as 'lamina inspect'
                      does; A: and :B are open ends
  --chordal-error MM  greatest distance of facets from curves where $fn does not
                      say [$fa and $fs decide; for CAD files 0.01]
  --decimate MM       remove triangles of imported meshes, such as scans, within
                      this distance
  --tolerance MM      write the fewest vertices within this distance of the
                      contour; 0 writes all [0.001]
  --ray auto|MM       distance of the rays; speed only, except for
                      --contour paper [auto]
  --self-supporting MM
                      how far a layer may stand out over the one below before
                      it counts as an overhang [as far as a surface of 45° does]
  --threads N         number of threads [as many as the machine has]

Files (for designs that strangers write; see docs/usage.md):
  --root FOLDER       read and write in this folder only, links resolved
  --allow-read FOLDER
                      with --root: read in this folder, too; may be repeated
  --no-import         refuse import(), surface(), dxf_dim(), dxf_cross() and
                      font files

Limits (an exceeded one is an error; see docs/usage.md for all):
  --max-memory SIZE   memory in use: bytes, or with K, M, G or % of what the
                      machine has [80%]
  --max-time SECONDS  time by the clock, for each design, piece or run under
                      --watch [none]
  --max-depth N       nested calls of functions and modules [300000]
  --max-leaves N      parts of the design, once all loops have run [10000000]

For comparison, the method of Zeng et al. 2011:
  --contour MODE      faithful: exact contours; paper: linked rays [faithful]
  --boxes MODE        with paper: local or global depth images [local]
  --sampler KIND      with paper: scanline, or gl (drawn by OpenGL, by depth
                      peeling, as published) [scanline]

Looking inside (see docs/wrong-contour.md):
  --dump STAGE        instead of layers, write one layer as text, or to a .svg
                      file as a drawing: its scene (leaves and their Boolean),
                      chains (sections of leaves), events (of the sweep), or
                      contours
  --at Z              the layer: the one that holds this height

)";

constexpr std::string_view kHelpEnd =
    R"(Examples:
  lamina ring.scad                        ring.slc, layers of 0.05 mm
  lamina ring.scad -o wax.slc --layer 0.025 -D size=54
  lamina inspect ring.slc                 is it sound? how much wax?

Exit status: 0 done, 1 the design or a file is at fault, 2 usage,
130 interrupted.
)";

// A word that looks like no file but much like a command, or is one that does
// not come first.
void refuse_misspelt_command(const std::string& word) {
  std::vector<std::string_view> commands;
  commands.reserve(std::size(kNamedCommands));
  for (const NamedCommand& named : kNamedCommands) {
    commands.push_back(named.name);
    refuse_if(word == named.name,
              "the command '{0}' stands before the files (a file: ./{0})",
              word);
  }
  if (word.find_first_of("./") != std::string::npos) return;
  const std::string hint = did_you_mean(word, commands);
  refuse_if(!hint.empty(), "there is no command '{0}'; {1} (a file: ./{0})",
            word, hint);
}

// As a shell reads it: in quotes where it has to be.
std::string shell_word(const std::string& word) {
  constexpr std::string_view kPlain =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789"
      "-_./=,:+%@";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string::npos) {
    return word;
  }
  std::string quoted = "'";
  for (const char letter : on_one_line(word)) {
    quoted += letter == '\'' ? "'\\''" : std::string(1, letter);
  }
  return quoted + "'";
}

// The given options that check has, too, each behind a blank.
std::string check_words(const std::vector<GivenOption>& given) {
  OptionList known;
  const std::unique_ptr<Command> check = make_check_command();
  check->add_options(known);
  std::string words;
  for (const GivenOption& option : given) {
    if (option.name == "--quiet" || !known.find(option.name)) continue;
    for (const std::string& word : option.words) {
      words += " " + option.name;
      if (option.has_value) words += " " + shell_word(word);
    }
  }
  return words;
}

class SliceCommand : public Command {
 public:
  std::string_view help() const override {
    static const std::string all =
        fmt::format("{}{}{}", kCommonHelp, kRareHelp, kHelpEnd);
    return all;
  }
  std::string_view short_help() const override {
    static const std::string common =
        fmt::format("{}{}", kCommonHelp, kHelpEnd);
    return common;
  }

  void add_options(OptionList& options) override {
    options.words("design", designs_);
    options.all_help();
    options.name("-o", "file", request_.output.path);
    options.name("-d", "file", request_.output.dependencies);
    options.flag("--watch", watches_);
    const auto& stages = slicer::kDumpStages;
    options.choice("--dump", {stages.begin(), stages.end()},
                   [this, &stages](const std::string& stage) {
                     request_.output.dump = static_cast<slicer::DumpStage>(
                         std::ranges::find(stages, stage) - stages.begin());
                   });
    options.text("--at", "height", [this](const std::string& text) {
      request_.output.dump_height = require_within("--at", text);
    });
    add_output_options(options, request_, output_);
    add_design_options(options, request_, is_quiet_);
    add_slicing_options(options, request_);
    options.on_read([this, &options] { given_ = options.given(); });
  }

  bool takes_settings() const override { return true; }

  void check() override {
    refuse_if(designs_.empty(), "no design was given");
    for (const std::string& design : designs_) {
      refuse_misspelt_command(design);
      refuse_layers(design);
    }
    if (request_.output.dump) return check_dump();
    // "ring.png/", of a folder of images, is not a folder for several outputs.
    std::string& output = request_.output.path;
    if (output.ends_with('/') && !is_folder()) output.pop_back();
    refuse_if(request_.output.path == "-" && output_.export_format.empty(),
              "-o - needs --export-format");
    refuse_if(watches_ && (designs_.size() > 1 || request_.output.path == "-"),
              "--watch needs one design and a file to write");
    refuse_if(
        std::ranges::find(designs_, "-") != designs_.end() &&
            (designs_.size() > 1 || watches_ || request_.output.path.empty()),
        "a design from standard input (-) stands alone and needs -o");
    if (designs_.size() > 1) return check_several();
    request_.design.path = designs_.front();
    request_.output.path = output_of(request_.design.path);
    choose_format(request_, output_, request_.output.path);
  }

  int run(const Context& context) override {
    if (designs_.size() > 1) return run_several(context);
    Session session(request_, is_quiet_, context);
    return session.run([&] {
      context.expect_outputs(
          {request_.output.path, request_.output.dependencies, output_.report});
      make_folder_of(request_.output.path, context.file_access());
      if (watches_) {
        compile_and_watch(request_, closing(), is_quiet_, context);
      }
      return compile_and_report(session, closing());
    });
  }

 private:
  Closing closing() const {
    return {output_.report, [this] {
              return fmt::format("lamina check {}{}",
                                 shell_word(display_path(request_.design.path)),
                                 check_words(given_));
            }};
  }

  // A name such as "ring.png/" is that of an output that is a folder.
  bool is_folder() const {
    const std::string& output = request_.output.path;
    return output.ends_with('/') &&
           !slicer::choose_output_format(output.substr(0, output.size() - 1))
                .format;
  }

  bool is_pattern() const {
    return request_.output.path.find("{name}") != std::string::npos;
  }

  std::string output_of(const std::string& design) const {
    if (request_.output.path.empty()) {
      return std::filesystem::path(design).replace_extension(
          usual_extension(request_, output_));
    }
    if (is_folder()) {
      return fmt::format("{}{}.{}", request_.output.path, stem(design),
                         usual_extension(request_, output_));
    }
    const std::string path = with_extension(request_, output_);
    if (!is_pattern()) return path;
    return fill_pattern(path, [&](const std::string& word) {
      return word == "name" ? stem(design) : fmt::format("{{{}}}", word);
    });
  }

  // A dump goes to standard output where no file is named.
  void check_dump() {
    std::string& path = request_.output.path;
    if (path.empty()) path = "-";
    refuse_if(designs_.size() > 1 || watches_,
              "--dump needs one design, and no --watch");
    refuse_if(!output_.report.empty(), "--report needs layers");
    refuse_if(!output_.export_format.empty() ||
                  !(path == "-" || slicer::is_named(path, ".txt") ||
                    slicer::is_named(path, ".svg")),
              "--dump writes text, to standard output or .txt, or a drawing, "
              "to .svg");
    request_.design.path = designs_.front();
    compiler::validate(request_);
  }

  void check_several() {
    refuse_if(
        !request_.output.path.empty() && !is_folder() && !is_pattern(),
        "-o names one file; for several designs give it a folder, such as "
        "'out/', or a pattern, such as 'out/{{name}}.slc'");
    refuse_if(!request_.output.dependencies.empty(), "-d needs one design");
    choose_format(request_, output_, output_of(designs_.front()));
  }

  int run_several(const Context& context) {
    std::vector<Piece> pieces;
    for (const std::string& design : designs_) {
      Piece& piece = pieces.emplace_back();
      piece.request = request_;
      piece.request.design.path = design;
      piece.request.output.path = output_of(design);
      piece.name = display_path(design);
      piece.prefix = fmt::format("{}: ", short_name(piece.name));
      piece.number = pieces.size();
    }
    Terminal terminal(is_quiet_);
    return run_caught(terminal, {}, [&] {
      for (const Piece& piece : pieces) {
        context.expect_outputs({piece.request.output.path});
      }
      context.expect_outputs({output_.report});
      make_folder_of(output_.report, context.file_access());
      PieceList list(std::move(pieces));
      return make_pieces(
          list, {"designs", output_.report, request_.job.threads, is_quiet_},
          context);
    });
  }

  std::vector<std::string> designs_;
  std::vector<GivenOption> given_;
  compiler::Request request_;  // of each
  bool is_quiet_ = false;
  OutputOptions output_;
  bool watches_ = false;
};

}  // namespace

std::unique_ptr<Command> make_slice_command() {
  return std::make_unique<SliceCommand>();
}

}  // namespace lamina::cli
