// Prints how far the layers of two SLC files differ: the area of the symmetric
// difference of all layers, as a share of the area of the first file's layers.
//
//   build/release/bench/layer_difference a.slc b.slc
//
// A layer that only one of the files has counts whole. Clipper computes the
// areas, in units of 1e-7 mm.

#include <cmath>
#include <cstdio>
#include <exception>
#include <vector>

#include <polyclipping/clipper.hpp>

#include "slicer/formats/slc_reader.h"

namespace {

using ClipperLib::Paths;
using lamina::slicer::SlcLayer;
using lamina::slicer::SlcReader;

constexpr double kUnitsPerMm = 1e7;
constexpr double kSameHeight = 1e-4;  // [mm], float32's rounding included

struct Layer {
  double z = 0;
  Paths paths;
};

std::vector<Layer> read_layers(const char* path) {
  SlcReader reader(path);
  std::vector<Layer> layers;
  for (SlcLayer read; reader.read_layer(read);) {
    Layer& layer = layers.emplace_back();
    layer.z = read.z;
    for (const auto& boundary : read.boundaries) {
      ClipperLib::Path& loop = layer.paths.emplace_back();
      for (const lamina::Vec2 point : boundary.points) {
        loop.emplace_back(std::llround(point.x * kUnitsPerMm),
                          std::llround(point.y * kUnitsPerMm));
      }
    }
  }
  return layers;
}

double area(const Paths& paths) {
  double sum = 0;
  for (const ClipperLib::Path& path : paths) sum += ClipperLib::Area(path);
  return sum / (kUnitsPerMm * kUnitsPerMm);
}

double area_of_difference(const Paths& a, const Paths& b) {
  ClipperLib::Clipper clipper;
  clipper.AddPaths(a, ClipperLib::ptSubject, true);
  clipper.AddPaths(b, ClipperLib::ptClip, true);
  Paths result;
  clipper.Execute(ClipperLib::ctXor, result, ClipperLib::pftEvenOdd,
                  ClipperLib::pftEvenOdd);
  return area(result);
}

double share_of_difference(const std::vector<Layer>& a,
                           const std::vector<Layer>& b) {
  double difference = 0;
  double whole = 0;
  auto other = b.begin();
  const auto skip_below = [&](double z) {
    for (; other != b.end() && other->z < z - kSameHeight; ++other) {
      difference += area(other->paths);
    }
  };
  for (const Layer& layer : a) {
    skip_below(layer.z);
    whole += area(layer.paths);
    if (other != b.end() && other->z < layer.z + kSameHeight) {
      difference += area_of_difference(layer.paths, other->paths);
      ++other;
    } else {
      difference += area(layer.paths);
    }
  }
  skip_below(HUGE_VAL);
  return difference / whole;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fputs("usage: layer_difference a.slc b.slc\n", stderr);
    return 2;
  }
  try {
    std::printf("%.2e\n", share_of_difference(read_layers(argv[1]),
                                              read_layers(argv[2])));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "layer_difference: %s\n", error.what());
    return 1;
  }
}
