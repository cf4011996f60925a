#include "serve/shop/answer_cache.h"

#include <utility>

namespace lamina::shop {

const Answer* AnswerCache::find(const std::string& design,
                                const std::string& asked) {
  const auto of_design = places_.find(design);
  if (of_design == places_.end()) return nullptr;
  const auto place = of_design->second.find(asked);
  if (place == of_design->second.end()) return nullptr;
  entries_.splice(entries_.begin(), entries_, place->second);
  return &place->second->answer;
}

void AnswerCache::keep(const std::string& design, const std::string& asked,
                       Answer answer) {
  auto& place = places_[design];
  if (const auto known = place.find(asked); known != place.end()) {
    bytes_ -= known->second->bytes();
    entries_.erase(known->second);
  }
  entries_.push_front({design, asked, std::move(answer)});
  place[asked] = entries_.begin();
  bytes_ += entries_.front().bytes();
  while (bytes_ > most_bytes_) erase(std::prev(entries_.end()));
}

void AnswerCache::drop(const std::string& design) {
  const auto of_design = places_.find(design);
  if (of_design == places_.end()) return;
  for (const auto& [asked, entry] : of_design->second) {
    bytes_ -= entry->bytes();
    entries_.erase(entry);
  }
  places_.erase(of_design);
}

void AnswerCache::erase(Entries::iterator entry) {
  bytes_ -= entry->bytes();
  const auto of_design = places_.find(entry->design);
  of_design->second.erase(entry->asked);
  if (of_design->second.empty()) places_.erase(of_design);
  entries_.erase(entry);
}

}  // namespace lamina::shop
