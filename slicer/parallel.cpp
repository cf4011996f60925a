#include "slicer/parallel.h"

#include <oneapi/tbb/parallel_for.h>

namespace lamina::slicer {

void for_each_index(std::size_t count,
                    const std::function<void(std::size_t)>& body) {
  char begin = 0;
  char end = 0;
  const Lent lent_begin(&begin);
  const Lent lent_end(&end);
  oneapi::tbb::parallel_for(std::size_t{0}, count, [&](std::size_t i) {
    const Turn turn(&begin, &end);
    body(i);
  });
}

}  // namespace lamina::slicer
