// Compiled without ThreadSanitizer, as the library is whose templates it holds
// (CMakeLists.txt).

#include "base/parallel.h"

#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_pipeline.h>

namespace lamina {

namespace tbb = oneapi::tbb;

void run_tasks(std::size_t count,
               const std::function<void(std::size_t)>& task) {
  tbb::parallel_for(std::size_t{0}, count, task);
}

void run_stages(std::size_t places, const Stages& stages) {
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
  tbb::parallel_pipeline(
      places,
      tbb::make_filter<void, Place>(tbb::filter_mode::serial_in_order, start) &
          tbb::make_filter<Place, Place>(tbb::filter_mode::parallel, work) &
          tbb::make_filter<Place, void>(tbb::filter_mode::serial_in_order,
                                        finish));
}

}  // namespace lamina
