#include "serve/shop/metrics.h"

#include <iterator>

#include <fmt/format.h>

namespace lamina::shop {
namespace {

void add_head(std::string& text, std::string_view name, std::string_view type,
              std::string_view help) {
  fmt::format_to(std::back_inserter(text), "# HELP {0} {1}\n# TYPE {0} {2}\n",
                 name, help, type);
}

void add_value(std::string& text, std::string_view name, std::string_view type,
               std::string_view help, std::uint64_t value) {
  add_head(text, name, type, help);
  text += fmt::format("{} {}\n", name, value);
}

}  // namespace

void Metrics::count(std::string_view route, unsigned status) {
  ++answers_[{std::string(route), status}];
}

void Metrics::time(std::string_view route, double seconds) {
  Histogram& histogram = times_[std::string(route)];
  for (std::size_t i = 0; i < kClasses.size(); ++i) {
    if (seconds <= kClasses[i]) ++histogram.counts[i];
  }
  ++histogram.count;
  histogram.sum += seconds;
}

std::string Metrics::text(const Gauges& gauges) const {
  std::string text;
  add_head(text, "lamina_requests_total", "counter", "Answers, by status.");
  for (const auto& [key, count] : answers_) {
    text +=
        fmt::format("lamina_requests_total{{route=\"{}\",status=\"{}\"}} {}\n",
                    key.first, key.second, count);
  }
  add_head(text, "lamina_order_seconds", "histogram",
           "Time of orders that were made, from arrival to answer.");
  for (const auto& [route, times] : times_) {
    constexpr const char* kBucket =
        "lamina_order_seconds_bucket{{route=\"{}\",le=\"{}\"}} {}\n";
    for (std::size_t i = 0; i < kClasses.size(); ++i) {
      text += fmt::format(kBucket, route, kClasses[i], times.counts[i]);
    }
    text += fmt::format(kBucket, route, "+Inf", times.count);
    text += fmt::format(
        "lamina_order_seconds_sum{{route=\"{0}\"}} {1}\n"
        "lamina_order_seconds_count{{route=\"{0}\"}} {2}\n",
        route, times.sum, times.count);
  }
  add_head(text, "lamina_ended_total", "counter",
           "Processes that did not end by themselves.");
  for (const auto& [reason, count] : ended_) {
    text +=
        fmt::format("lamina_ended_total{{reason=\"{}\"}} {}\n", reason, count);
  }
  add_value(text, "lamina_cache_hits_total", "counter",
            "Orders whose answer was kept.", hits_);
  add_value(text, "lamina_cache_misses_total", "counter",
            "Orders whose answer had to be made.", misses_);
  add_value(text, "lamina_cache_bytes", "gauge", "Memory of kept answers.",
            gauges.cache_bytes);
  add_value(text, "lamina_workers", "gauge", "Orders that may run at once.",
            gauges.workers);
  add_value(text, "lamina_orders_running", "gauge", "Orders that run.",
            gauges.running);
  add_value(text, "lamina_queue_length", "gauge", "Orders that wait.",
            gauges.waiting);
  add_value(text, "lamina_designs_ready", "gauge",
            "Designs that have a process.", gauges.designs);
  return text;
}

}  // namespace lamina::shop
