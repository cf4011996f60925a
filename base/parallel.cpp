// Compiled without ThreadSanitizer, as the library is whose templates it holds
// (CMakeLists.txt).

#include "base/parallel.h"

#include <optional>
#include <stdexcept>
#include <typeinfo>

#include <fmt/format.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include "base/diagnostic.h"

namespace lamina {

namespace tbb = oneapi::tbb;

namespace {

// oneTBB throws a plain std::runtime_error where the system grants no thread.
template <typename Work>
void with_threads(const Work& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    if (typeid(error) != typeid(std::runtime_error)) throw;
    throw Error(
        fmt::format("the system grants no further thread, or no stack "
                    "for it (ulimit -u, -d, -v): {}",
                    error.what()));
  }
}

}  // namespace

void run_tasks(std::size_t count,
               const std::function<void(std::size_t)>& task) {
  with_threads([&] { tbb::parallel_for(std::size_t{0}, count, task); });
}

void run_stages(std::size_t places, unsigned most_threads,
                const Stages& stages) {
  std::optional<tbb::global_control> limit;
  if (most_threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, most_threads);
  }
  std::size_t place = places - 1;
  const auto start = [&](tbb::flow_control& flow) {
    place = (place + 1) % places;
    if (!stages.start(place)) flow.stop();
    return place;
  };
  const auto work = [&](std::size_t item) {
    stages.work(item);
    return item;
  };
  const auto finish = [&](std::size_t item) { stages.finish(item); };
  using Place = std::size_t;
  const auto stages_in_order =
      tbb::make_filter<void, Place>(tbb::filter_mode::serial_in_order, start) &
      tbb::make_filter<Place, Place>(tbb::filter_mode::parallel, work) &
      tbb::make_filter<Place, void>(tbb::filter_mode::serial_in_order, finish);
  with_threads([&] { tbb::parallel_pipeline(places, stages_in_order); });
}

}  // namespace lamina
