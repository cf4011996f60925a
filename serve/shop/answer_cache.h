#pragma once
// Answers to orders, kept until a file of their design changes, and of these
// the ones that were asked for last.

#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <string>
#include <string_view>

namespace lamina::shop {

struct Answer {
  std::string type;
  std::string name;  // of a file; empty: none
  std::string key;   // of its content; empty: not known
  std::string body;  // empty where it is too long to be kept
  bool has_body = false;
};

class AnswerCache {
 public:
  // most_bytes  of all that is kept, about
  explicit AnswerCache(std::size_t most_bytes) : most_bytes_(most_bytes) {}

  // Null: there is none. Valid until the next call.
  //
  // asked  what was asked of the design
  const Answer* find(const std::string& design, const std::string& asked);

  void keep(const std::string& design, const std::string& asked, Answer answer);

  // Forgets all answers of a design.
  void drop(const std::string& design);

  std::size_t bytes() const { return bytes_; }

 private:
  struct Entry {
    std::string design;
    std::string asked;
    Answer answer;

    std::size_t bytes() const {
      return sizeof(Entry) + 2 * (design.size() + asked.size()) +
             answer.body.size();
    }
  };
  using Entries = std::list<Entry>;

  void erase(Entries::iterator entry);

  const std::size_t most_bytes_;
  std::size_t bytes_ = 0;
  Entries entries_;  // the one that was asked for last in front
  std::map<std::string, std::map<std::string, Entries::iterator>> places_;
};

}  // namespace lamina::shop
