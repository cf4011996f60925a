#pragma once
// What the service counts, in the text format of Prometheus (version 0.0.4).

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace lamina::shop {

// As it is now.
struct Gauges {
  std::size_t workers = 0;
  std::size_t running = 0;
  std::size_t waiting = 0;
  std::size_t designs = 0;  // that have a process
  std::size_t cache_bytes = 0;
};

class Metrics {
 public:
  // Counts an answer.
  //
  // route  its name; empty: none
  void count(std::string_view route, unsigned status);
  // Counts how long an order took, from its arrival to its answer.
  void time(std::string_view route, double seconds);
  void count_cache(bool is_hit) { ++(is_hit ? hits_ : misses_); }
  // Counts a process that was ended, and by what.
  void count_ended(std::string_view reason) { ++ended_[std::string(reason)]; }

  std::string text(const Gauges& gauges) const;

 private:
  // Upper ends of the classes of time [s].
  static constexpr std::array kClasses = {0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
                                          0.5,   1.0,  2.5,   5.0,  10.0};
  struct Histogram {
    std::array<std::uint64_t, kClasses.size()> counts{};  // up to each end
    std::uint64_t count = 0;
    double sum = 0;
  };

  std::map<std::pair<std::string, unsigned>, std::uint64_t> answers_;
  std::map<std::string, Histogram> times_;
  std::map<std::string, std::uint64_t> ended_;
  std::uint64_t hits_ = 0;
  std::uint64_t misses_ = 0;
};

}  // namespace lamina::shop
