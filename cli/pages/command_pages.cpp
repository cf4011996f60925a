#include "cli/pages/command_pages.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <sstream>

#include "cli/commands/commands.h"
#include "cli/options/common_options.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/material.h"
#include "slicer/machine/printer.h"

namespace lamina::cli {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  std::string part;
  while (std::getline(stream, part, separator)) parts.push_back(part);
  return parts;
}

std::string without_blanks(const std::string& text) {
  return text.substr(std::min(text.find_first_not_of(' '), text.size()));
}

// An entry's text in one line, without tables and without the default.
std::string in_one_line(const HelpEntry& entry) {
  std::string text;
  for (const std::string& line : entry.text) {
    if (line.starts_with(' ')) break;
    text += (text.empty() ? "" : " ") + line;
  }
  return text.substr(0, text.find(" ["));
}

// Fills in what the help says of the option; false where it says nothing.
bool read_entry(const std::vector<HelpBlock>& help, OptionPage& page) {
  for (const HelpBlock& block : help) {
    for (const HelpEntry& entry : block.entries) {
      for (const NamedValue& option : entry.options) {
        if (option.name != page.names.back()) continue;
        page.value = option.value;
        page.text = in_one_line(entry);
        return true;
      }
    }
  }
  return false;
}

// The words of a choice, "{a,b}" at the end of what its value is called; those
// that the help names, "auto|MM"; printers, materials and formats.
std::vector<std::string> words_of(const std::string& type,
                                  const std::string& value) {
  if (type == "printer") {
    std::vector<std::string> names;
    for (const slicer::Printer& printer : slicer::known_printers()) {
      names.push_back(printer.name);
    }
    return names;
  }
  if (type == "material" || type == "metal") {
    std::vector<std::string> names;
    for (const slicer::Material& material : slicer::known_materials()) {
      if (type == "metal" && !material.is_metal()) continue;
      names.push_back(material.name);
    }
    return names;
  }
  if (type == "format") return slicer::written_extensions();
  const std::size_t open = type.find('{');
  if (open != std::string::npos && type.ends_with('}')) {
    return split(type.substr(open + 1, type.size() - open - 2), ',');
  }
  if (value.find('|') == std::string::npos) return {};
  std::vector<std::string> words = split(value, '|');
  std::erase_if(words, [](const std::string& word) {
    return std::any_of(word.begin(), word.end(), [](unsigned char letter) {
      return std::isupper(letter) != 0;
    });
  });
  return words;
}

OptionPage option_page(const OptionFacts& option,
                       const std::vector<HelpBlock>& help,
                       const std::vector<HelpBlock>& main_help) {
  OptionPage page;
  page.names = option.names;
  if (!read_entry(help, page)) read_entry(main_help, page);
  page.has_value = option.has_value;
  if (!page.has_value) return page;
  page.may_repeat = option.may_repeat;
  page.words = words_of(option.value, page.value);
  page.is_file = option.value == "file";
  return page;
}

// By what the usage calls the first word: DESIGN; FILE.slc; FILE, of layers or
// a design; anything else is a mesh, too.
std::vector<std::string> extensions_of(const std::string& usage) {
  if (usage.find(" DESIGN") != std::string::npos) return {"scad", "csg"};
  const std::size_t dot = usage.find("FILE.");
  if (dot != std::string::npos) {
    const std::size_t begin = dot + 5;
    return {usage.substr(begin, usage.find_first_of(" ]", begin) - begin)};
  }
  std::vector<std::string> extensions = {"slc",  "cli",  "svg",
                                         "json", "scad", "csg"};
  if (usage.find(" FILE") == std::string::npos) {
    extensions.insert(extensions.end(),
                      {"stl", "off", "obj", "amf", "3mf", "dxf", "step", "stp",
                       "iges", "igs", "brep", "brp", "FCStd"});
  }
  return extensions;
}

// "  lamina inspect FILE.slc [OPTION]...     check a layer file and list it",
// where the text may stand on a line of its own below.
void read_usage(const std::vector<HelpBlock>& main_help, CommandPage& page) {
  const std::string begin =
      page.name.empty() ? "  lamina " : "  lamina " + page.name + " ";
  const std::vector<std::string> lines = lines_below(main_help, "Usage");
  const auto usage = std::find_if(
      lines.begin(), lines.end(),
      [&](const std::string& line) { return line.starts_with(begin); });
  if (usage == lines.end()) return;
  const std::size_t end = std::min(usage->find("  ", 2), usage->size());
  page.extensions = extensions_of(usage->substr(0, end));
  page.text = without_blanks(usage->substr(end));
  if (page.text.empty() && usage + 1 != lines.end()) {
    page.text = without_blanks(*(usage + 1));
  }
}

CommandPage command_page(const std::string& name, Command& command,
                         const std::vector<HelpBlock>& main_help) {
  OptionList options;
  command.add_options(options);
  ProcessLimits limits;
  FileAccess::Limits access;
  add_common_options(options, limits, access);
  CommandPage page;
  page.name = name;
  page.help = read_help(command.help());
  read_usage(main_help, page);
  for (const OptionFacts& option : options.facts()) {
    page.options.push_back(option_page(option, page.help, main_help));
  }
  return page;
}

}  // namespace

std::vector<CommandPage> command_pages() {
  std::vector<CommandPage> pages;
  const std::unique_ptr<Command> slice = make_slice_command();
  const std::vector<HelpBlock> main_help = read_help(slice->help());
  pages.push_back(command_page("", *slice, main_help));
  for (const NamedCommand& named : kNamedCommands) {
    const std::unique_ptr<Command> command = named.make();
    pages.push_back(command_page(std::string(named.name), *command, main_help));
  }
  return pages;
}

void replace(std::string& frame, std::string_view mark,
             std::string_view content) {
  for (std::size_t at = frame.find(mark); at != std::string::npos;
       at = frame.find(mark, at + content.size())) {
    frame.replace(at, mark.size(), content);
  }
}

}  // namespace lamina::cli
