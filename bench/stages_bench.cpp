// Times the stages of a run one by one (evaluate, lower, cut the leaves, sweep)
// over the benchmark scenes, at the sizes that the design was measured on.
//
//   build/release/bench/stages_bench --benchmark_filter=ring55
//
// bench/whole_program times whole runs.

#include <cstdint>
#include <string>

#include <benchmark/benchmark.h>

#include "compiler/compile.h"
#include "ldni/section/leaf_section.h"
#include "plane/cascade/kinetic_ray.h"

namespace {

using namespace lamina;

constexpr std::uint32_t kBlockLayers = 32;

// A scene of bench/scenes with `definitions` as -D gives them.
struct Design {
  Design(const std::string& scene, const std::string& definitions)
      : request(request_of(scene, definitions)), compilation(request, files) {
    compiler::read_design(compilation);
  }

  static compiler::Request request_of(const std::string& scene,
                                      const std::string& definitions) {
    compiler::Request request;
    request.design.path = LAMINA_SCENES "/" + scene + ".scad";
    request.design.definitions = definitions;
    return request;
  }
  csg::Tree evaluate() {
    return compiler::evaluate(compilation.design, request, compilation.loader,
                              compilation.readers, compilation.evaluation_stack,
                              compilation.diagnostics);
  }
  csg::Scene lower() {
    return *compiler::lower(compilation.tree, request, {}, compilation.readers,
                            compilation.diagnostics)
                .scene();
  }
  csg::Scene make_scene() {
    compilation.tree = evaluate();
    return lower();
  }

  compiler::Request request;
  TemporaryFiles files;
  compiler::Compilation compilation;
};

void evaluate(benchmark::State& state, const std::string& scene,
              const std::string& definitions) {
  Design design(scene, definitions);
  for (auto _ : state) benchmark::DoNotOptimize(design.evaluate());
}

void lower(benchmark::State& state, const std::string& scene,
           const std::string& definitions) {
  Design design(scene, definitions);
  design.make_scene();
  for (auto _ : state) benchmark::DoNotOptimize(design.lower());
}

// Calls `visit` with every block of layers of the scene, cut into chains.
template <typename Visit>
void for_each_block(const csg::Scene& scene, double thickness,
                    ldni::SectionBlock& block, const Visit& visit) {
  const auto grid =
      ldni::LayerGrid::uniform(scene.box.low.z, scene.box.high.z, thickness);
  const ldni::LeafSectioner sectioner(scene, grid);
  for (std::uint32_t first = 0; first < grid.layer_count();
       first += kBlockLayers) {
    const std::uint32_t count =
        std::min(kBlockLayers, grid.layer_count() - first);
    sectioner.cut(first, count, block);
    visit(count);
  }
}

void cut_leaves(benchmark::State& state, const std::string& scene_name,
                const std::string& definitions, double thickness) {
  Design design(scene_name, definitions);
  const csg::Scene scene = design.make_scene();
  ldni::SectionBlock block;
  std::size_t points = 0;
  for (auto _ : state) {
    points = 0;
    for_each_block(scene, thickness, block,
                   [&](std::uint32_t) { points += block.points.size(); });
  }
  state.counters["points"] = static_cast<double>(points);
}

// Cuts as well: subtract the time of cut_leaves().
void cut_and_sweep(benchmark::State& state, const std::string& scene_name,
                   const std::string& definitions, double thickness) {
  Design design(scene_name, definitions);
  const csg::Scene scene = design.make_scene();
  ldni::SectionBlock block;
  const plane::BooleanProgram program = csg::program_of(scene);
  plane::KineticRay ray(program);
  plane::Contours contours;
  std::size_t points = 0;
  for (auto _ : state) {
    points = 0;
    for_each_block(scene, thickness, block, [&](std::uint32_t count) {
      for (std::uint32_t layer = 0; layer < count; ++layer) {
        ray.sweep(block, layer, contours);
        points += contours.points.size();
      }
    });
  }
  state.counters["points"] = static_cast<double>(points);
}

struct Case {
  std::string name;
  std::string scene;
  std::string definitions;
  double thickness = 0.0762;  // [mm]
};

void add_case(const Case& c) {
  const auto add = [&](const std::string& stage, auto function,
                       auto... arguments) {
    benchmark::RegisterBenchmark((c.name + "/" + stage).c_str(), function,
                                 c.scene, c.definitions, arguments...)
        ->Unit(benchmark::kMillisecond);
  };
  add("evaluate", evaluate);
  add("lower", lower);
  add("cut", cut_leaves, c.thickness);
  add("cut_and_sweep", cut_and_sweep, c.thickness);
}

}  // namespace

int main(int argc, char** argv) {
  for (const Case& c : {Case{"ring55_small", "ring55", ""},
                        Case{"ring55", "ring55", "k=165;\n"},
                        Case{"ring55_fine", "ring55", "k=165;\n", 0.0127},
                        Case{"submarine74", "submarine74", "k=126;\n"},
                        Case{"lattice20", "lattice", "N=20;\n"},
                        Case{"lattice40", "lattice", "N=40;\n"}}) {
    add_case(c);
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
