// lamina printers and lamina materials: what the program knows of them.

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/ranges.h>

#include "base/similar.h"
#include "base/text.h"
#include "cli/commands/commands.h"
#include "cli/process/exit_status.h"
#include "cli/process/streams.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::cli {
namespace {

constexpr std::string_view kPrintersHelp =
    R"(Usage: lamina printers [WORD]... [--all]

Lists the printers that lamina knows, or those whose name has these words
('lamina printers elegoo saturn'): the names for --printer, which takes a part of
a name as well ('mars 3'), what they build in millimetres, the pixels of their
panels, and the file that they read. Where lamina does not write it, UVtools
converts what lamina writes. --printer takes a profile of your own as well (see
docs/formats.md).

  --all       all that is known of them, with the source
  -h, --help  print this help
)";

constexpr std::string_view kMaterialsHelp =
    R"(Usage: lamina materials [WORD]... [--all]

Lists the resins and metals that lamina knows, or those whose name has these
words ('lamina materials gold'): the names for --material and --metal, their
density in g/cm³, and of resins the printers for which an exposure is known.
Prices are yours: see --price. --material and --metal take a profile of your own
as well (see docs/formats.md).

  --all       all that is known of them, with the sources
  -h, --help  print this help
)";

// Those with all words in their name, title or other names.
template <typename Profile>
std::vector<Profile> with_words(std::vector<Profile> profiles,
                                const std::string& words) {
  std::erase_if(profiles, [&](const Profile& profile) {
    std::string names = profile.name + ' ' + profile.title;
    if constexpr (requires { profile.also; }) {
      names += fmt::format(" {}", fmt::join(profile.also, " "));
    }
    return !words.empty() && !has_words(names, words);
  });
  return profiles;
}

// A command that lists profiles.
template <typename Profile>
class ListCommand : public Command {
 public:
  void add_options(OptionList& options) override {
    options.words("word", words_);
    options.flag("--all", is_all_);
  }
  int run(const Context& /*context*/) override {
    const std::string words = fmt::format("{}", fmt::join(words_, " "));
    const std::vector<Profile> found = with_words(known(), words);
    if (found.empty()) {
      print_error(fmt::format("error: no name has '{}'\n", on_one_line(words)));
      return kFault;
    }
    print_out(is_all_ ? paragraphs(found) : table(found));
    return kDone;
  }

 private:
  virtual std::vector<Profile> known() const = 0;
  virtual std::string table(const std::vector<Profile>& profiles) const = 0;
  virtual std::string paragraph(const Profile& profile) const = 0;

  std::string paragraphs(const std::vector<Profile>& profiles) const {
    std::string text;
    for (const Profile& profile : profiles) {
      text += fmt::format("{}: {}\n{}", profile.name, profile.title,
                          paragraph(profile));
    }
    return text;
  }

  std::vector<std::string> words_;
  bool is_all_ = false;
};

class PrintersCommand : public ListCommand<slicer::Printer> {
 public:
  std::string_view help() const override { return kPrintersHelp; }

 private:
  std::vector<slicer::Printer> known() const override {
    return slicer::known_printers();
  }

  // "143 x 90 x 175", each with so many digits at most; "-" is not known.
  static std::string volume(const slicer::Printer& printer, int digits) {
    const Vec3 size = printer.build_volume();
    return fmt::format(
        "{:.{}g} x {:.{}g} x {}", size.x, digits, size.y, digits,
        std::isfinite(size.z) ? fmt::format("{:.{}g}", size.z, digits) : "-");
  }

  static std::string pixels(const slicer::Printer& printer) {
    return printer.has_panel()
               ? fmt::format("{} x {}", printer.width, printer.height)
               : "-";
  }

  std::string table(
      const std::vector<slicer::Printer>& printers) const override {
    std::string text = fmt::format("{:<27}  {:<17}  {:<12}  reads\n", "printer",
                                   "builds mm", "pixels");
    for (const slicer::Printer& printer : printers) {
      text += fmt::format(
          "{:<27}  {:<17}  {:<12}  {}\n", printer.name, volume(printer, 3),
          pixels(printer),
          printer.reads.empty() ? "-" : "." + printer.reads.front());
    }
    return text;
  }

  std::string paragraph(const slicer::Printer& printer) const override {
    std::string text = fmt::format("  builds {} mm", volume(printer, 6));
    if (printer.has_panel()) {
      text += fmt::format(", {} pixels of {:g} x {:g} mm", pixels(printer),
                          printer.pixel.x, printer.pixel.y);
    }
    if (printer.move_seconds > 0) {
      text += fmt::format("\n  takes {:g} s for a layer besides its exposure",
                          printer.move_seconds);
    }
    if (!printer.reads.empty()) {
      text += fmt::format("\n  reads .{}", fmt::join(printer.reads, ", ."));
    }
    const std::string complaint =
        slicer::complaint_of_printer(printer.title, printer.reads);
    if (!complaint.empty()) text += fmt::format("\n  {}", complaint);
    return text + fmt::format("\n  source: {}\n", printer.source);
  }
};

class MaterialsCommand : public ListCommand<slicer::Material> {
 public:
  std::string_view help() const override { return kMaterialsHelp; }

 private:
  std::vector<slicer::Material> known() const override {
    return slicer::known_materials();
  }

  // The printers that a resin has exposures for, each once.
  static std::vector<std::string> printers(const slicer::Material& material) {
    std::vector<std::string> names;
    for (const slicer::KnownExposure& known : material.exposures) {
      if (std::ranges::find(names, known.printer) == names.end()) {
        names.push_back(known.printer);
      }
    }
    return names;
  }

  std::string table(
      const std::vector<slicer::Material>& materials) const override {
    std::string text = fmt::format("{:<28}  {:>5}  {}\n", "material", "g/cm³",
                                   "exposures for");
    for (const slicer::Material& material : materials) {
      const std::vector<std::string> names = printers(material);
      std::string first = names.empty() ? "-" : names.front();
      if (names.size() > 1) {
        first += fmt::format(" and {} more", names.size() - 1);
      }
      text += fmt::format("{:<28}  {:>5}  {}\n", material.name,
                          material.density, first);
    }
    return text;
  }

  std::string paragraph(const slicer::Material& material) const override {
    std::string text = fmt::format("  {:g} g/cm³", material.density);
    if (!material.also.empty()) {
      text += fmt::format("; also {}", fmt::join(material.also, ", "));
    }
    for (const slicer::KnownExposure& known : material.exposures) {
      text += fmt::format("\n  {:g} s, first layers {:g} s: {}, {:g} mm ({})",
                          known.exposure.layer, known.exposure.first,
                          known.printer, known.layer_thickness, known.source);
    }
    return text + fmt::format("\n  source: {}\n", material.source);
  }
};

}  // namespace

std::unique_ptr<Command> make_printers_command() {
  return std::make_unique<PrintersCommand>();
}

std::unique_ptr<Command> make_materials_command() {
  return std::make_unique<MaterialsCommand>();
}

}  // namespace lamina::cli
