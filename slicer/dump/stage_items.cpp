#include "slicer/dump/detail/stage_items.h"

#include <array>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "plane/cascade/kinetic_ray.h"
#include "plane/loop_area.h"
#include "plane/sweep/sweep_trace.h"
#include "slicer/check/thin/thin_finder.h"
#include "slicer/slice/leaf_search.h"

namespace lamina::slicer {
namespace {

constexpr std::array<std::string_view, 3> kOpNames = {"union", "intersection",
                                                      "difference"};

// The lofts and meshes of a leaf.
std::string surface_text(const csg::Leaf& leaf) {
  std::string text;
  for (const csg::Loft& loft : leaf.lofts) {
    text += fmt::format(", {} of {} x {}", loft.is_cavity ? "cavity" : "loft",
                        loft.outline->size(), loft.profile.size());
  }
  for (const csg::Mesh& mesh : leaf.meshes) {
    text += fmt::format(", mesh of {} triangles", mesh.triangles.size());
  }
  return text + (leaf.may_overlap_itself ? ", may overlap itself" : "");
}

std::string chain_text(std::uint32_t chain) { return fmt::to_string(chain); }

std::string pair_text(const plane::TracedPair& pair) {
  return fmt::format("{}={}", pair.lower, pair.upper);
}

// Solid lies between brackets.
std::string boundary_text(const plane::TracedEntry& entry) {
  return fmt::format("{}{}{}", entry.side > 0 ? "[" : "", entry.chain,
                     entry.side < 0 ? "]" : "");
}

std::string entry_text(const plane::TracedEntry& entry) {
  return boundary_text(entry) + (entry.is_tied ? " =" : "");
}

// An event point, what happened at it, and the ray behind it.
std::string event_text(std::size_t number, const plane::TracedEvent& event) {
  std::string text = fmt::format("event {} at x {}", number, event.left);
  const auto add = [&](std::string_view what, const auto& things,
                       const auto& text_of) {
    if (things.empty()) return;
    text += fmt::format("\n  {}:", what);
    for (const auto& thing : things) text += ' ' + text_of(thing);
  };
  add("ends", event.ended, chain_text);
  add("begins", event.begun, chain_text);
  add("new order", event.swapped, chain_text);
  add("parts", event.parted, pair_text);
  add("ties", event.tied, pair_text);
  add("boundary ends", event.arcs_ended, boundary_text);
  add("boundary begins", event.arcs_begun, boundary_text);
  add(event.has_more_below ? "ray from …" : "ray", event.ray, entry_text);
  return text + (event.has_more_above ? " …" : "");
}

// "#3 ring.scad:12:3"
std::string name_of(const DumpedLayer& layer, std::uint32_t instance) {
  if (instance == kNoInstance) return "no leaf";
  return fmt::format("#{} {}", instance,
                     layer.line_of(layer.scene.instances[instance]));
}

DumpItem instance_item(const DumpedLayer& layer, std::uint32_t number,
                       bool meets_layer, std::size_t depth) {
  const csg::Instance& instance = layer.scene.instances[number];
  const auto& [low, high] = instance.box;
  return {
      fmt::format("{:{}}{}{}: x {} to {}, y {} to {}, z {} to {}, leaf {}{}",
                  meets_layer ? "*" : "", 2 * depth, name_of(layer, number),
                  instance.is_minuend ? ", minuend" : "", low.x, high.x, low.y,
                  high.y, low.z, high.z, instance.leaf,
                  surface_text(layer.scene.leaves[instance.leaf])),
      meets_layer ? DumpShape::kFrame : DumpShape::kNone,
      {{low.x, low.y},
       {high.x, low.y},
       {high.x, high.y},
       {low.x, high.y},
       {low.x, low.y}},
      number};
}

// The program lists an operator before its children and after those of the
// operators before it, so indented lines show the tree.
std::vector<DumpItem> scene_items(const DumpedLayer& layer) {
  const csg::Scene& scene = layer.scene;
  std::vector<DumpItem> items;
  items.push_back({fmt::format(
      "leaves: {}, instances: {}, operators: {}; * meets the layer",
      scene.leaves.size(), scene.instances.size(), scene.program.size())});
  std::vector<bool> meets(scene.instances.size());
  for (const plane::Chain& chain : layer.chains.chains) {
    meets[chain.operand] = true;
  }
  std::vector<std::vector<std::uint32_t>> children(scene.program.size());
  for (std::uint32_t i = 0; i < scene.instances.size(); ++i) {
    children[scene.instances[i].parent].push_back(i);
  }
  std::vector<std::size_t> depths(scene.program.size(), 1);
  for (std::size_t i = 0; i < scene.program.size(); ++i) {
    const plane::BooleanNode& node = scene.program[i];
    if (i > 0) depths[i] = depths[node.parent] + 1;
    items.push_back({fmt::format("{:{}}{}{}", "", 2 * depths[i],
                                 kOpNames[static_cast<std::size_t>(node.op)],
                                 node.is_minuend ? ", minuend" : "")});
    for (const std::uint32_t child : children[i]) {
      items.push_back(instance_item(layer, child, meets[child], depths[i] + 1));
    }
  }
  return items;
}

std::vector<DumpItem> chain_items(const DumpedLayer& layer) {
  const plane::LayerChains& chains = layer.chains;
  std::vector<DumpItem> items;
  items.push_back({fmt::format("chains: {}, loops: {}", chains.chains.size(),
                               chains.loops.size())});
  std::size_t i = 0;
  for (std::size_t loop = 0; loop < chains.loops.size(); ++loop) {
    const std::size_t end = i + chains.loops[loop].chain_count;
    for (; i < end; ++i) {
      const plane::Chain& chain = chains.chains[i];
      const auto points = chain.points_in(chains.points);
      items.push_back({fmt::format("chain {} of loop {}, {}, solid {}", i, loop,
                                   name_of(layer, chain.operand),
                                   chain.winding > 0 ? "above" : "below"),
                       DumpShape::kLine,
                       {points.begin(), points.end()},
                       chain.operand});
    }
  }
  return items;
}

// Where the chains are that begin, end, change places or tie.
std::vector<Vec2> places_of(const DumpedLayer& layer,
                            const plane::TracedEvent& event) {
  std::vector<Vec2> places;
  const auto add = [&](std::uint32_t chain) {
    const auto points =
        layer.chains.chains[chain].points_in(layer.chains.points);
    places.emplace_back(event.left, plane::y_at(points, event.left));
  };
  for (const std::uint32_t chain : event.begun) add(chain);
  for (const std::uint32_t chain : event.ended) add(chain);
  for (const std::uint32_t chain : event.swapped) add(chain);
  for (const plane::TracedPair& pair : event.tied) add(pair.lower);
  return places;
}

std::vector<DumpItem> event_items(const DumpedLayer& layer) {
  const plane::SweepTrace trace =
      plane::trace_sweep(layer.chains, layer.program);
  std::vector<DumpItem> items;
  items.push_back({fmt::format(
      "event points: {}; a ray runs upwards, [ ] enclose solid, = is a tie",
      trace.events.size())});
  for (std::size_t i = 0; i < trace.events.size(); ++i) {
    items.push_back({event_text(i + 1, trace.events[i]), DumpShape::kMarks,
                     places_of(layer, trace.events[i])});
  }
  if (!trace.passed.empty()) {
    items.push_back({fmt::format("never on the ray, as lone loops are: {}",
                                 fmt::join(trace.passed, " "))});
  }
  return items;
}

// The leaf of each edge, which begins at the point of that index.
std::vector<std::uint32_t> edge_instances(const DumpedLayer& layer) {
  std::vector<Vec2> middles;
  for (std::size_t l = 0; l < layer.contours.loop_count(); ++l) {
    const auto loop = layer.contours.loop(l);
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec2 next = loop[i + 1 < loop.size() ? i + 1 : 0];
      middles.push_back(0.5 * (loop[i] + next));
    }
  }
  LeafSearch search;
  const auto found = search.find(layer.block, 0, middles);
  return {found.begin(), found.end()};
}

// Each loop in stretches of edges of one leaf.
std::vector<DumpItem> contour_items(const DumpedLayer& layer) {
  const std::vector<std::uint32_t> instances = edge_instances(layer);
  std::vector<DumpItem> items;
  items.push_back({fmt::format("loops: {}", layer.contours.loop_count())});
  std::size_t edge = 0;
  for (std::size_t l = 0; l < layer.contours.loop_count(); ++l) {
    const auto loop = layer.contours.loop(l);
    const double area = signed_area(loop);
    items.push_back(
        {fmt::format("loop {}, {}, area {}, {} points", l,
                     area < 0 ? "hole" : "outer", area, loop.size())});
    for (std::size_t i = 0; i < loop.size(); ++i, ++edge) {
      if (i == 0 || instances[edge] != instances[edge - 1]) {
        items.push_back({fmt::format("  of loop {}, {}", l,
                                     name_of(layer, instances[edge])),
                         DumpShape::kLine,
                         {loop[i]},
                         instances[edge]});
      }
      items.back().points.push_back(loop[i + 1 < loop.size() ? i + 1 : 0]);
    }
  }
  return items;
}

}  // namespace

DumpedLayer::DumpedLayer(const csg::Scene& its_scene,
                         const ldni::LayerGrid& grid, std::uint32_t number,
                         LineOf leaf_line)
    : scene(its_scene), program(csg::program_of(scene)), line_of(leaf_line) {
  ldni::LeafSectioner(scene, grid).cut(number, 1, block);
  chains = block.chains_of(0);
  plane::KineticRay(program).sweep(block, 0, contours);
}

std::vector<DumpItem> stage_items(const DumpedLayer& layer, DumpStage stage) {
  switch (stage) {
    case DumpStage::kScene:
      return scene_items(layer);
    case DumpStage::kChains:
      return chain_items(layer);
    case DumpStage::kEvents:
      return event_items(layer);
    case DumpStage::kContours:
      break;
  }
  return contour_items(layer);
}

}  // namespace lamina::slicer
