#include "cli/pages/help_text.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace lamina::cli {
namespace {

std::size_t indentation(const std::string& line) {
  return std::min(line.find_first_not_of(' '), line.size());
}

bool is_heading(const std::string& line) {
  return indentation(line) == 0 && line.ends_with(':') &&
         std::isupper(static_cast<unsigned char>(line.front())) != 0;
}

bool is_entry(const std::string& line) {
  return indentation(line) == 2 && line.size() > 2 && line[2] == '-';
}

// Where the word at or behind `at` begins and ends.
struct Word {
  std::size_t begin = 0;
  std::size_t end = 0;
};

Word word_at(const std::string& line, std::size_t at) {
  const std::size_t begin =
      std::min(line.find_first_not_of(' ', at), line.size());
  return {begin, std::min(line.find(' ', begin), line.size())};
}

// Names and their values behind them, as in "-p FILE -P SET" and "-q, --quiet".
// Two blanks end them, or a word behind a value, where the value is long.
std::size_t read_head(const std::string& line, HelpEntry& entry) {
  std::size_t end = 0;
  bool is_value_next = false;
  for (Word word = word_at(line, 0); word.begin < line.size();
       word = word_at(line, word.end)) {
    if (end > 0 && word.begin > end + 1) break;
    std::string text = line.substr(word.begin, word.end - word.begin);
    if (text.ends_with(',')) text.pop_back();
    if (text.starts_with('-')) {
      entry.options.push_back({text, ""});
    } else if (is_value_next) {
      entry.options.back().value = text;
    } else {
      break;
    }
    is_value_next = text.starts_with('-');
    end = word.end;
  }
  entry.head = line.substr(2, end - 2);
  return end;
}

class Reader {
 public:
  std::vector<HelpBlock> read(std::string_view help) {
    std::istringstream lines{std::string(help)};
    std::string line;
    while (std::getline(lines, line)) take(line);
    return std::move(blocks_);
  }

 private:
  void take(const std::string& line) {
    if (line.empty()) {
      is_open_ = false;
    } else if (is_heading(line)) {
      open(line.substr(0, line.size() - 1));
    } else if (is_entry(line)) {
      if (!is_open_) open("");
      add_entry(line);
    } else if (is_open_ && !blocks_.back().entries.empty()) {
      add_text(line);
    } else {
      if (!is_open_) open("");
      blocks_.back().lines.push_back(line);
    }
  }

  void open(const std::string& heading) {
    blocks_.push_back({heading, {}, {}});
    is_open_ = true;
  }

  void add_entry(const std::string& line) {
    HelpEntry entry;
    const std::size_t end = read_head(line, entry);
    column_ = std::min(line.find_first_not_of(' ', end), line.size());
    if (column_ < line.size()) entry.text.push_back(line.substr(column_));
    blocks_.back().entries.push_back(std::move(entry));
  }

  void add_text(const std::string& line) {
    std::vector<std::string>& text = blocks_.back().entries.back().text;
    const std::size_t indent = indentation(line);
    if (text.empty()) column_ = indent;
    text.push_back(line.substr(std::min(column_, indent)));
  }

  std::vector<HelpBlock> blocks_;
  bool is_open_ = false;    // the last block goes on
  std::size_t column_ = 0;  // where the text of the last entry begins
};

}  // namespace

std::vector<HelpBlock> read_help(std::string_view help) {
  return Reader().read(help);
}

std::vector<std::string> lines_below(const std::vector<HelpBlock>& help,
                                     std::string_view heading) {
  for (const HelpBlock& block : help) {
    if (block.heading == heading) return block.lines;
  }
  return {};
}

}  // namespace lamina::cli
