#include "cli/options/option_list.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <utility>

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/ranges.h>

#include "base/similar.h"
#include "base/text.h"
#include "base/version.h"
#include "cli/options/option_values.h"

namespace lamina::cli {
namespace {

Option refuse_empty(CLI::Option* option, const std::string& what) {
  option->type_name(what)->check([what](const std::string& text) {
    // "-o=ring.slc" would be a file of the name "=ring.slc".
    return text.empty() || text.starts_with('=')
               ? fmt::format("a {} was expected, behind a blank, not '{}'",
                             what, text)
               : "";
  });
  return Option(*option);
}

// Words of CLI11, "-o: 1 required file missing", as others say it.
std::string words_of(const CLI::ArgumentMismatch& fault) {
  const std::string words = fault.what();
  constexpr std::string_view kMiddle = ": 1 required ";
  constexpr std::string_view kEnd = " missing";
  const std::size_t middle = words.find(kMiddle);
  if (middle == std::string::npos || !words.ends_with(kEnd)) return words;
  const std::size_t begin = middle + kMiddle.size();
  return fmt::format("{} needs a {}", words.substr(0, middle),
                     words.substr(begin, words.size() - begin - kEnd.size()));
}

// Options of `lamina view`, which openscad has for its own pictures.
constexpr std::array<std::string_view, 6> kOfPictures = {
    "--camera",  "--viewall",    "--autocenter",
    "--imgsize", "--projection", "--colorscheme"};

// Names that other programs give to options of lamina.
constexpr std::array<std::pair<std::string_view, std::string_view>, 7> kOthers =
    {{{"--layer-height", "--layer"},
      {"--output", "-o"},
      {"--export-sla", "-o"},
      {"--load", "--printer"},
      {"-j", "--threads"},
      {"-V", "--version"},
      {"--simplify", "--tolerance"}}};

// As CLI11 has it, which turns their order around.
std::string unexpected_words(const std::vector<std::string>& words) {
  return fmt::format("The following argument{} not expected: {}",
                     words.size() > 1 ? "s were" : " was",
                     fmt::join(words, " "));
}

// For the first word that is not an option but much like one, or one of another
// program.
std::string hint_for(const CLI::App& app) {
  std::vector<std::string> own;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) own.push_back(name);
  }
  const std::vector<std::string_view> names(own.begin(), own.end());
  for (const std::string& word : app.remaining()) {
    if (!word.starts_with('-')) continue;
    const std::string_view name =
        std::string_view(word).substr(0, word.find('='));
    if (std::ranges::find(kOfPictures, name) != kOfPictures.end()) {
      return "; it is for pictures: 'lamina view', or -o with .png";
    }
    for (const auto& [other, ours] : kOthers) {
      // A short one may have its value behind it.
      if (other.starts_with("--") ? name == other : name.starts_with(other)) {
        return fmt::format("; did you mean '{}'?", ours);
      }
    }
    if (!name.starts_with("--")) continue;
    const std::string_view similar = most_similar(name.substr(2), names);
    if (!similar.empty()) {
      return fmt::format("; did you mean '--{}'?", similar);
    }
  }
  return "";
}

}  // namespace

const Option& Option::required() const {
  option_->required();
  return *this;
}

const Option& Option::repeatable() const {
  option_->expected(1)->allow_extra_args(false)->multi_option_policy(
      CLI::MultiOptionPolicy::TakeAll);
  return *this;
}

const Option& Option::needs(const Option& other) const {
  option_->needs(other.option_);
  return *this;
}

const Option& Option::needs(const std::string& name) const {
  option_->needs(name);
  return *this;
}

const Option& Option::excludes(const Option& other) const {
  option_->excludes(other.option_);
  return *this;
}

const Option& Option::in_group(const std::string& group) const {
  option_->group(group);
  return *this;
}

OptionList::OptionList() : app_(std::make_unique<CLI::App>("", "lamina")) {}

OptionList::~OptionList() = default;

Option OptionList::word(const std::string& name, std::string& target) {
  return Option(*app_->add_option(name, target));
}

Option OptionList::words(const std::string& name,
                         std::vector<std::string>& targets) {
  return Option(*app_->add_option(name, targets));
}

Option OptionList::flag(const std::string& name, bool& target) {
  return Option(*app_->add_flag(name, target));
}

Option OptionList::flag(const std::string& name, std::string& target) {
  return Option(*app_->add_flag(name, target));
}

Option OptionList::flag(const std::string& name, const Use& use) {
  return Option(*app_->add_flag(name, unused_)->each(use));
}

Option OptionList::flag(const std::string& name,
                        const std::function<void()>& use) {
  return Option(*app_->add_flag_callback(name, use));
}

Option OptionList::text(const std::string& name, const std::string& value,
                        const Use& use) {
  return Option(
      *app_->add_option_function<std::string>(name, use)->type_name(value));
}

Option OptionList::texts(const std::string& name, const std::string& value,
                         const Use& use) {
  const auto use_all = [use](const std::vector<std::string>& texts) {
    for (const std::string& text : texts) use(text);
  };
  return Option(
             *app_->add_option_function<std::vector<std::string>>(name, use_all)
                  ->type_name(value))
      .repeatable();
}

Option OptionList::number(const std::string& name, const std::string& value,
                          double& target) {
  const std::string option = name.substr(0, name.find(','));
  return text(name, value, [option, &target](const std::string& words) {
    target = require_within(option, words);
  });
}

Option OptionList::count(const std::string& name, std::uint32_t& target) {
  return text(name, "number", [name, &target](const std::string& words) {
    const double count = require_within(name, words);
    require(count == std::floor(count), name,
            "a whole number was expected, not '{}'", words);
    target = static_cast<std::uint32_t>(count);
  });
}

Option OptionList::integer(const std::string& name, std::uint32_t& target) {
  return Option(*app_->add_option(name, target)->type_name("number"));
}

Option OptionList::whole(const std::string& name,
                         std::optional<unsigned>& target, unsigned least,
                         unsigned most) {
  return Option(*app_->add_option(name, target)
                     ->check(CLI::Range(least, most))
                     ->type_name("number"));
}

Option OptionList::layer_number(std::optional<std::size_t>& target) {
  return text("--layer-number", "number", [&target](const std::string& words) {
    constexpr double kMost = 0xffffffff;
    const auto number = parse_number(words);
    require(number && *number >= 1 && *number <= kMost &&
                *number == std::floor(*number),
            "--layer-number", "a whole number from 1 on was expected, not '{}'",
            words);
    target = static_cast<std::size_t>(*number);
  });
}

Option OptionList::layer_range(slicer::LayerNumbers& range) {
  return text("--layers", "range", [&range](const std::string& words) {
    range = parse_layers(words);
  });
}

Option OptionList::name(const std::string& name, const std::string& what,
                        std::string& target) {
  return refuse_empty(app_->add_option(name, target), what);
}

Option OptionList::names(const std::string& name, const std::string& what,
                         std::vector<std::string>& targets) {
  return refuse_empty(app_->add_option(name, targets), what);
}

Option OptionList::choice(const std::string& name,
                          const std::vector<std::string>& words,
                          const Use& use) {
  const auto fault_of = [words](const std::string& word) -> std::string {
    if (std::ranges::find(words, word) != words.end()) return "";
    return fmt::format("expected {}, not '{}'", fmt::join(words, ", "), word);
  };
  // Completions read the words from the description.
  return Option(
      *app_->add_option_function<std::string>(name, use)
           ->type_name("word")
           ->check(fault_of, fmt::format("{{{}}}", fmt::join(words, ","))));
}

Option OptionList::boolean(const std::string& name, bool& target) {
  const std::vector<std::string> words = {"true", "false", "on",
                                          "off",  "1",     "0"};
  const auto use = [&target](const std::string& word) {
    target = word == "true" || word == "on" || word == "1";
  };
  return Option(*app_->add_option_function<std::string>(name, use)
                     ->type_name("word")
                     ->transform(CLI::IsMember(words, CLI::ignore_case)));
}

void OptionList::help_and_version() {
  app_->set_help_flag("-h,--help");
  app_->set_version_flag("-v,--version", fmt::format("lamina {}", version()));
}

void OptionList::all_help() { app_->set_help_all_flag("--help-all"); }

void OptionList::begin_group(const std::string& group) {
  app_->option_defaults()->group(group);
}

void OptionList::end_group() { begin_group("Options"); }  // as CLI11 does

void OptionList::remove(const std::string& name) {
  app_->remove_option(app_->get_option(name));
}

std::optional<Option> OptionList::find(const std::string& name) {
  CLI::Option* const option = app_->get_option_no_throw(name);
  return option != nullptr ? std::optional(Option(*option)) : std::nullopt;
}

void OptionList::on_read(const std::function<void()>& use) {
  read_uses_.push_back(use);
  app_->parse_complete_callback([this] {
    for (const auto& one : read_uses_) one();
  });
}

std::optional<std::string> OptionList::read(int argc, const char* const* argv,
                                            std::string_view help,
                                            std::string_view all_help) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::CallForHelp&) {
    return std::string(help);
  } catch (const CLI::CallForAllHelp&) {
    return std::string(all_help);
  } catch (const CLI::CallForVersion& version) {
    return fmt::format("{}\n", version.what());
  } catch (const CLI::ExtrasError&) {
    throw compiler::RequestError(unexpected_words(app_->remaining()) +
                                 hint_for(*app_));
  } catch (const CLI::ArgumentMismatch& error) {
    throw compiler::RequestError(words_of(error));
  } catch (const CLI::ParseError& error) {
    throw compiler::RequestError(error.what());
  }
  return std::nullopt;
}

void OptionList::set_default(const std::string& name,
                             const std::string& value) {
  CLI::Option* const option = app_->get_option_no_throw(name);
  if (option == nullptr || option->count() > 0) return;
  try {
    option->add_result(value);
    option->run_callback();
  } catch (const CLI::ParseError& error) {
    throw compiler::RequestError(error.what());
  }
}

std::vector<GivenOption> OptionList::given() const {
  std::vector<GivenOption> given;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->count() == 0) continue;
    given.push_back({option->get_name(), option->get_group(),
                     option->get_expected_max() > 0, option->results()});
  }
  return given;
}

std::vector<OptionFacts> OptionList::facts() const {
  std::vector<OptionFacts> facts;
  for (const CLI::Option* option : app_->get_options()) {
    if (option->get_positional()) continue;
    OptionFacts& fact = facts.emplace_back();
    for (const std::string& name : option->get_snames()) {
      fact.names.push_back("-" + name);
    }
    for (const std::string& name : option->get_lnames()) {
      fact.names.push_back("--" + name);
    }
    fact.value = option->get_type_name();
    fact.has_value = option->get_expected_max() > 0;
    fact.may_repeat = fact.has_value && option->get_multi_option_policy() ==
                                            CLI::MultiOptionPolicy::TakeAll;
  }
  return facts;
}

std::string given_text(const OptionList& options,
                       std::span<const std::string_view> neutral) {
  std::string text;
  for (const GivenOption& option : options.given()) {
    if (std::ranges::find(neutral, option.name) != neutral.end()) continue;
    text += option.name;
    for (const std::string& word : option.words) text += "\n " + word;
    text += '\n';
  }
  return text;
}

}  // namespace lamina::cli
