// The C++ interface's half of bench/python: slices a design again and again,
// and prints the processor seconds of a slicing and the sum of all coordinates.

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include <lamina/design.h>

int main(int argc, char** argv) {
  if (argc != 4) return 2;  // DESIGN LAYER TIMES
  const auto design = lamina::Design::from_file(argv[1]);
  lamina::SliceOptions options;
  options.layer_thickness = std::atof(argv[2]);
  options.threads = 1;
  const int times = std::atoi(argv[3]);
  double sum = 0;
  const std::clock_t begin = std::clock();
  for (int i = 0; i < times; ++i) {
    for (const lamina::Layer& layer : design.slice(options)) {
      for (const lamina::Loop& loop : layer.loops) sum += loop.front().x;
    }
  }
  const double seconds =
      static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  std::printf("%.6g %.17g\n", seconds / times, sum);
}
