// Measures how far layers are from exact sections at several pitches, for both
// contour modes with all vertices, and for the faithful one as a file holds it;
// bench/pitch_plot draws it.
//
// Prints a line for each scene, kind of contour and pitch: their names, the
// symmetric difference over the perimeter [mm], and how many of the sections
// have another number of regions or holes.

#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/design.h"

namespace {

using namespace lamina;
using slicer::ContourMode;

constexpr std::size_t kHeights = 6;

struct Section {
  double z;
  oracle::ExactRegion region;
};

std::vector<Section> exact_sections(const csg::Scene& scene) {
  const oracle::WorldScene world = oracle::world_scene(scene);
  std::vector<Section> sections;
  for (const double z : oracle::generic_heights(world, scene.box.low.z,
                                                scene.box.high.z, kHeights)) {
    sections.push_back({z, oracle::exact_section(world, z)});
  }
  return sections;
}

struct Kind {
  const char* name;
  ContourMode mode;
  double tolerance;  // [mm]
};
const Kind kKinds[] = {{"paper", ContourMode::kPaper, 0},
                       {"simplified", ContourMode::kFaithful, 0.001},
                       {"faithful", ContourMode::kFaithful, 0}};

void print_row(const std::string& scene_name, const csg::Scene& scene,
               const std::vector<Section>& sections, const Kind& kind,
               double pitch) {
  slicer::Settings settings;
  for (const Section& section : sections) settings.heights.push_back(section.z);
  settings.tolerance = kind.tolerance;
  settings.contour = kind.mode;
  settings.ray_pitch = pitch;
  const auto layers = support::slice_layers(scene, settings);
  double difference = 0;
  double perimeter = 0;
  int wrong = 0;
  for (std::size_t i = 0; i < sections.size(); ++i) {
    const oracle::Comparison found =
        oracle::compare(sections[i].region, layers.at(i).contours);
    difference += found.difference_area;
    perimeter += found.expected_perimeter;
    wrong += found.expected_counts == found.actual_counts ? 0 : 1;
  }
  fmt::print("{} {} {} {:.3g} {}/{}\n", scene_name, kind.name, pitch,
             difference / perimeter, wrong, sections.size());
}

}  // namespace

int main() {
  struct Scene {
    std::string name;
    std::string definition;
  };
  for (const auto& [name, definition] :
       std::vector<Scene>{{"ring55", "k = 51"},
                          {"submarine74", "k = 51"},
                          {"thin_gap", "g = 0.01"}}) {
    const support::Design design = support::Design::from_text(fmt::format(
        "include <{}/{}.scad>\n{};", LAMINA_SCENES, name, definition));
    const std::vector<Section> sections = exact_sections(design.scene());
    for (const Kind& kind : kKinds) {
      for (const double pitch : {0.01, 0.02, 0.05, 0.1, 0.2, 0.5}) {
        print_row(name, design.scene(), sections, kind, pitch);
      }
    }
  }
}
