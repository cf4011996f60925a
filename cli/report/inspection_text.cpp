#include "cli/report/inspection_text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/text.h"
#include "cli/report/feature_table.h"
#include "cli/report/finding_table.h"
#include "cli/report/printed_text.h"
#include "cli/report/run_report.h"
#include "slicer/contour/deviation.h"
#include "slicer/machine/material.h"

namespace lamina::cli {
namespace {

using slicer::Finding;
using slicer::Inspection;
using slicer::Material;
using slicer::SamplingRow;
using slicer::ThinFeature;

// Supports are printed, but not cast.
double weight_of(const Inspection& found, const Material& material) {
  return material.weight(material.is_metal()
                             ? slicer::part_volume(found.volume, found.supports)
                             : found.volume);
}

// Metals, wax, and resin as such, the heaviest first.
std::vector<Material> weighed_materials() {
  std::vector<Material> materials = slicer::known_materials();
  std::erase_if(materials, [](const Material& material) {
    return !material.exposures.empty();
  });
  std::ranges::stable_sort(materials, std::greater(), &Material::density);
  return materials;
}

using nlohmann::ordered_json;

// Layers listed of a long file.
constexpr std::size_t kListedLayers = 20;

struct Totals {
  std::size_t loops = 0;
  std::size_t holes = 0;
  std::size_t vertices = 0;
  std::size_t empty = 0;
};

Totals totals_of(const Inspection& found) {
  Totals totals;
  for (const auto& row : found.layers) {
    totals.loops += row.measures.loops;
    totals.holes += row.measures.holes;
    totals.vertices += row.measures.vertices;
    totals.empty += row.measures.loops == 0 ? 1 : 0;
  }
  return totals;
}

// Turns what would read "-0.0000" into 0.
Vec3 without_minus_zero(Vec3 place) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(place[axis]) < 0.00005) place[axis] = 0;
  }
  return place;
}

class Text : PrintedText {
 public:
  explicit Text(const Inspection& found) : found_(found) {}

  std::string write(ListedLayers list) {
    print_header();
    for (const csg::MeshFacts& mesh : found_.meshes) print_mesh(mesh);
    print_layers(list);
    print_totals();
    print_weights();
    print_exactness();
    print_defects();
    if (found_.print) {
      text_ += '\n';
      text_ += finding_table(*found_.print, {});
    }
    if (found_.min_feature > 0) {
      text_ += '\n';
      text_ += feature_table(found_.features, found_.min_feature, {});
    }
    return std::move(text_);
  }

 private:
  void print_header() {
    print(
        "{}: {}", found_.name,
        found_.file.format.empty() ? "layers of a design" : found_.file.format);
    if (!found_.file.header.empty()) print(", {}", found_.file.header);
    if (!found_.file.format.empty()) {
      print(", written by {}", found_.file.writer.empty() ? "an unnamed program"
                                                          : found_.file.writer);
    }
    text_ += '\n';
    if (found_.file.extents) {
      const auto& [x, y, z] = *found_.file.extents;
      print(
          "extents   x {:.4f} … {:.4f}   y {:.4f} … {:.4f}   z {:.4f} … "
          "{:.4f}\n",
          x.x, x.y, y.x, y.y, z.x, z.y);
    }
    for (const SamplingRow& row : found_.file.sampling) {
      print("sampling  from z {}: layers of {}", row.min_z, row.thickness);
      if (row.line_width_compensation != 0) {
        print(", lines compensated by {}", row.line_width_compensation);
      }
      text_ += '\n';
    }
    if (!found_.file.has_sides) {
      print(
          "sides     not told: taken halfway between the sections of layers\n");
    }
    const std::string left_out = left_out_text(found_.file);
    if (!left_out.empty()) print("left out  {}\n", left_out);
  }

  void print_box(const Box3& box) {
    const Vec3 low = without_minus_zero(box.low);
    const Vec3 high = without_minus_zero(box.high);
    const Vec3 size = high - low;
    print(
        "box       x {:.4f} … {:.4f}   y {:.4f} … {:.4f}   z {:.4f} … "
        "{:.4f}   ({:.4f} x {:.4f} x {:.4f} mm)\n",
        low.x, high.x, low.y, high.y, low.z, high.z, size.x, size.y, size.z);
  }

  void print_mesh(const csg::MeshFacts& mesh) {
    print("\nmesh      {}, {}; {}\n",
          counted(mesh.vertices, "vertex", "vertices"),
          counted(mesh.triangles, "triangle"),
          mesh.is_closed ? "closed" : "not closed");
    print("surface   {}, genus {}, {}\n", counted(mesh.components, "component"),
          mesh.genus, counted(mesh.boundary_loops, "boundary loop"));
    print("edges     {} open\n", mesh.open_edges);
    if (mesh.tangled_edges + mesh.tangled_vertices > 0) {
      print("no manifold at {} and {}\n", counted(mesh.tangled_edges, "edge"),
            counted(mesh.tangled_vertices, "vertex", "vertices"));
    }
    if (!mesh.box.is_empty()) print_box(mesh.box);
    print("area      {:.6f} mm²\n", mesh.area);
    print("volume    {:.6f} mm³\n", mesh.volume);
  }

  void print_layers(ListedLayers list) {
    if (found_.layers.empty()) return;
    const std::size_t count = found_.layers.size();
    const bool lists_all = list == ListedLayers::kAll || count <= kListedLayers;
    print("\n{:>7} {:>12} {:>10} {:>7} {:>7} {:>9} {:>14} {:>14}\n", "layer",
          "z", "thickness", "loops", "holes", "vertices", "area mm²",
          "perimeter mm");
    const std::size_t listed = lists_all ? count : kListedLayers;
    for (std::size_t i = 0; i < listed; ++i) {
      const std::size_t index = lists_all ? i : i * (count - 1) / (listed - 1);
      const auto& [bottom, thickness, of, perimeter] = found_.layers[index];
      print("{:>7} {:>12.6g} {:>10.4g} {:>7} {:>7} {:>9} {:>13.6f} {:>13.6f}\n",
            index + 1, bottom, thickness, of.loops, of.holes, of.vertices,
            of.area, perimeter);
    }
    if (!lists_all) {
      print("({} of {} layers; --all lists them all)\n", listed, count);
    }
  }

  void print_totals() {
    const Totals totals = totals_of(found_);
    print("\nlayers    {}, {} of them empty; top of the part z {:.6g}\n",
          found_.layers.size(), totals.empty, found_.top);
    print("loops     {}, {} of them holes; {} vertices\n", totals.loops,
          totals.holes, totals.vertices);
    if (!found_.box.is_empty()) print_box(found_.box);
    print("volume    {:.6f} mm³\n", found_.volume);
    if (found_.supports) print("supports  {}\n", size_text(*found_.supports));
  }

  void print_weights() {
    if (!(found_.volume > 0)) return;
    std::string_view title = "weight";
    for (const Material& material : weighed_materials()) {
      print("{:<9} {:>10.3f} g  {} ({} g/cm³)\n", title,
            weight_of(found_, material), material.title, material.density);
      title = "";
    }
  }

  void print_exactness() {
    if (found_.file.deviation) {
      print("deviation at most {:.6g} mm from the design's sections\n",
            *found_.file.deviation);
    }
    if (found_.file.is_float32) {
      print("rounding  at most {:.2g} mm{}, by 32-bit numbers\n",
            slicer::float32_rounding(found_.greatest_coordinate),
            found_.file.deviation ? " of that" : "");
    }
  }

  void print_defects() {
    if (found_.defects == 0) {
      print("defects   none\n");
      return;
    }
    print("defects   {}\n", found_.defects);
    for (const std::string& words : found_.reported_defects)
      print("  {}\n", words);
    if (found_.defects > found_.reported_defects.size()) {
      print("  … and {} more\n",
            found_.defects - found_.reported_defects.size());
    }
  }

  const Inspection& found_;
};

ordered_json number_or_null(const std::optional<double>& value) {
  return value ? ordered_json(*value) : ordered_json();
}

ordered_json meshes_json(const Inspection& found) {
  ordered_json meshes = ordered_json::array();
  for (const csg::MeshFacts& mesh : found.meshes) {
    meshes.push_back({{"vertices", mesh.vertices},
                      {"triangles", mesh.triangles},
                      {"is_closed", mesh.is_closed},
                      {"components", mesh.components},
                      {"genus", mesh.genus},
                      {"boundary_loops", mesh.boundary_loops},
                      {"open_edges", mesh.open_edges},
                      {"non_manifold_edges", mesh.tangled_edges},
                      {"non_manifold_vertices", mesh.tangled_vertices},
                      {"box_mm", box_json(mesh.box)},
                      {"area_mm2", mesh.area},
                      {"volume_mm3", mesh.volume}});
  }
  return meshes;
}

ordered_json layers_json(const Inspection& found) {
  ordered_json layers = ordered_json::array();
  for (const auto& [bottom, thickness, of, perimeter] : found.layers) {
    layers.push_back({{"z", bottom},
                      {"thickness", thickness},
                      {"loops", of.loops},
                      {"holes", of.holes},
                      {"vertices", of.vertices},
                      {"area_mm2", of.area},
                      {"perimeter_mm", perimeter}});
  }
  return layers;
}

ordered_json features_json(const Inspection& found) {
  ordered_json features = ordered_json::array();
  for (const ThinFeature& feature : found.features) {
    features.push_back({{"kind", name_of(feature.kind)},
                        {"width_mm", feature.width},
                        {"first_layer", feature.first_layer},
                        {"last_layer", feature.last_layer},
                        {"z", feature.section_z},
                        {"place", {feature.place.x, feature.place.y}}});
  }
  return features;
}

}  // namespace

std::string inspection_text(const Inspection& found, ListedLayers list) {
  return Text(found).write(list);
}

std::string inspection_json(const Inspection& found) {
  const Totals totals = totals_of(found);
  ordered_json json;
  json["name"] = found.name;
  json["format"] = found.file.format;
  json["writer"] = found.file.writer;
  if (!found.file.left_out.empty()) json["left_out"] = found.file.left_out;
  if (!found.meshes.empty()) json["meshes"] = meshes_json(found);
  json["sampling"] = ordered_json::array();
  for (const SamplingRow& row : found.file.sampling) {
    json["sampling"].push_back({{"z", row.min_z},
                                {"thickness", row.thickness},
                                {"compensation", row.line_width_compensation}});
  }
  json["box_mm"] = box_json(found.box);
  json["top_mm"] = found.top;
  json["volume_mm3"] = found.volume;
  if (found.supports) json["supports"] = supports_json(*found.supports, {});
  for (const Material& material : weighed_materials()) {
    json["weight_g"][material.title] = weight_of(found, material);
  }
  json["loops"] = totals.loops;
  json["holes"] = totals.holes;
  json["vertices"] = totals.vertices;
  json["empty_layers"] = totals.empty;
  json["deviation_mm"] = number_or_null(found.file.deviation);
  json["defects"] = found.defects;
  json["reported_defects"] = found.reported_defects;
  if (found.print) {
    json["peel"] = peel_json(found.print->peel);
    json["findings"] = ordered_json::array();
    for (const Finding& finding : found.print->findings) {
      json["findings"].push_back(finding_json(finding));
    }
  }
  if (found.min_feature > 0) json["features"] = features_json(found);
  json["layers"] = layers_json(found);
  return json.dump(1, ' ', false, ordered_json::error_handler_t::replace) +
         "\n";
}

}  // namespace lamina::cli
