// What a band ring weighs in silver, for a few sizes of finger, what would go
// wrong in the print of the last one, and its layers for the printer. Prints a
// table; writes the file that its argument names, if there is one.
//
// Each layer is a set of closed loops in memory: areas times thicknesses are
// the volume.

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include <lamina/design.h>

namespace {

// Comfort fit: round inside and outside.
constexpr std::string_view kRing = R"(
  size = 54;        // inner circumference [mm], as ISO 8653 counts
  width = 4;        // [mm]
  thickness = 1.6;  // [mm]
  $fa = 2;
  $fs = 0.05;
  rotate_extrude()
    translate([size / (2 * PI) + thickness / 2, 0])
      scale([thickness, width]) circle(d = 1);
)";

constexpr double kSilver = 0.01036;  // 925 [g/mm³]

lamina::Design ring_of_size(int size) {
  lamina::DesignOptions options;
  options.definitions = {"size=" + std::to_string(size)};
  options.show = [](std::string_view message) {
    std::fwrite(message.data(), 1, message.size(), stderr);
  };
  return lamina::Design::from_text(std::string(kRing), options, "ring.scad");
}

double volume(const lamina::Design& design) {
  lamina::SliceOptions options;
  options.layer_thickness = 0.025;
  double sum = 0;  // [mm³]
  design.slice(options, [&](const lamina::Layer& layer) {
    sum += lamina::area(layer) * (layer.top - layer.bottom);
  });
  return sum;
}

// What needs supports or an outlet.
void print_findings(const lamina::Design& design) {
  for (const lamina::Finding& finding : design.check()) {
    if (finding.is_minor) continue;
    std::fprintf(stderr, "layer %u at z %.2f mm, %.3f mm2: %s\n",
                 finding.first_layer, finding.z, finding.area,
                 finding.source_line.c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    std::printf("size  volume mm3  silver g\n");
    for (const int size : {48, 54, 60}) {
      const double ring = volume(ring_of_size(size));
      std::printf("%4d %11.3f %9.3f\n", size, ring, kSilver * ring);
    }
    const lamina::Design largest = ring_of_size(60);
    print_findings(largest);
    if (argc > 1) largest.write(argv[1]);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
  }
  return 0;
}
