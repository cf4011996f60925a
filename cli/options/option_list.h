#pragma once
// The options of a command: their names, what they set, and how the words of
// the command line are read into them. Only option_list.cpp knows CLI11, which
// does the reading, since its headers take seconds to compile.
//
// Reading throws RequestError, which names the option, where a value is faulty.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "slicer/slice/settings.h"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace lamina::cli {

// One of them, to say more of it.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  const Option& required() const;
  // It may be given more than once, each time with one value.
  const Option& repeatable() const;
  // The other one must, or must not, be given with it.
  const Option& needs(const Option& other) const;
  const Option& needs(const std::string& name) const;
  const Option& excludes(const Option& other) const;
  const Option& in_group(const std::string& group) const;

 private:
  CLI::Option* option_;
};

// What an option is, for pages.
struct OptionFacts {
  std::vector<std::string> names;  // "-q", "--quiet"
  std::string value;               // what messages call it: "length", "{a,b}"
  bool has_value = false;
  bool may_repeat = false;
};

struct GivenOption {
  std::string name;
  std::string group;
  bool has_value = false;
  std::vector<std::string> words;
};

// Names are those of CLI11: "-q,--quiet", or "file" for a word that is no value
// of an option. Targets and functions outlive the list; functions may throw
// RequestError.
class OptionList {
 public:
  using Use = std::function<void(const std::string&)>;

  OptionList();
  ~OptionList();

  Option word(const std::string& name, std::string& target);
  Option words(const std::string& name, std::vector<std::string>& targets);

  Option flag(const std::string& name, bool& target);
  // A value may follow a '=', as in --render=cgal; "true" without one.
  Option flag(const std::string& name, std::string& target);
  Option flag(const std::string& name, const Use& use);
  Option flag(const std::string& name, const std::function<void()>& use);

  // An option whose text `use` reads; `value` is what messages call the text.
  Option text(const std::string& name, const std::string& value,
              const Use& use);
  // It may be given more than once, each time with one text.
  Option texts(const std::string& name, const std::string& value,
               const Use& use);

  // A number within the limits that the option has in compiler/validate.h.
  Option number(const std::string& name, const std::string& value,
                double& target);
  // Whole ones: within such limits, any, from `least` to `most`.
  Option count(const std::string& name, std::uint32_t& target);
  Option integer(const std::string& name, std::uint32_t& target);
  Option whole(const std::string& name, std::optional<unsigned>& target,
               unsigned least, unsigned most);
  // --layer-number: one layer, counted from 1.
  Option layer_number(std::optional<std::size_t>& target);
  // --layers: which layers are written.
  Option layer_range(slicer::LayerNumbers& range);

  // An option that names something, such as a file; `what` is what messages
  // call it. An empty name, as of a variable that is not set, must not mean
  // that none was given.
  Option name(const std::string& name, const std::string& what,
              std::string& target);
  // Names that follow each other.
  Option names(const std::string& name, const std::string& what,
               std::vector<std::string>& targets);

  // One of a few words.
  Option choice(const std::string& name, const std::vector<std::string>& words,
                const Use& use);
  // The words that openscad takes for true and false.
  Option boolean(const std::string& name, bool& target);

  // -h and -v, which read() answers.
  void help_and_version();
  // --help-all, likewise.
  void all_help();

  // Options that are added between these are of a group.
  void begin_group(const std::string& group);
  void end_group();

  void remove(const std::string& name);
  std::optional<Option> find(const std::string& name);

  // Called once all words have been read.
  void on_read(const std::function<void()>& use);

  // Reads the words, the program's name first. Returns what is to be printed
  // instead of a run: one of the helps, or the version.
  std::optional<std::string> read(int argc, const char* const* argv,
                                  std::string_view help,
                                  std::string_view all_help);

  // Gives an option that was not given a value, as the command line would.
  // Passes over one that this list does not have.
  void set_default(const std::string& name, const std::string& value);

  // Those that were given, in the order of their addition.
  std::vector<GivenOption> given() const;
  std::vector<OptionFacts> facts() const;

 private:
  std::unique_ptr<CLI::App> app_;
  std::vector<std::function<void()>> read_uses_;
  std::string unused_;  // texts of flags that are read otherwise
};

// All options that were given but some, as text: one that is new counts by
// itself.
//
// neutral  options that change nothing about what is made
std::string given_text(const OptionList& options,
                       std::span<const std::string_view> neutral);

}  // namespace lamina::cli
