#include "tests/conformance/geometry_judge.h"

#include <algorithm>
#include <stdexcept>
#include <string_view>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "tests/oracle/exact_region.h"
#include "tests/oracle/judge.h"
#include "tests/oracle/openscad.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

using oracle::ExactRegion;

constexpr int kLaminaSeconds = 60;

// OpenSCAD's own grid of 2D designs, 2^-16 mm, and a bit [mm].
constexpr double kOpenScadDistance = 2e-5;

struct LaminaResult {
  bool is_empty = false;
  std::string complaint;  // why there are no layers
  std::vector<plane::Contours> layers;
};

LaminaResult run_lamina(const Design& design,
                        const std::vector<double>& heights) {
  const support::TemporaryFolder folder;
  const std::string output = folder.file("out.layers.json");
  std::vector<std::string> arguments = {
      "timeout",      std::to_string(kLaminaSeconds),
      LAMINA_PROGRAM, design.path,
      "--language",   design.language,
      "-o",           output,
      "--tolerance",  "0"};
  if (!heights.empty()) {
    arguments.push_back(fmt::format("--heights={}", fmt::join(heights, ",")));
  }
  const auto result = support::run_process(arguments);
  LaminaResult lamina;
  lamina.is_empty = result.errors.find("object is empty") != std::string::npos;
  if (result.status != 0) {
    const std::string& words = result.errors;
    const std::size_t error = words.find("error: ");
    lamina.complaint =
        fmt::format("lamina ends with {}: {}", result.status,
                    words.substr(error == std::string::npos ? 0 : error, 200));
    return lamina;
  }
  const auto json = nlohmann::json::parse(support::read_file(output));
  for (const auto& layer : json["layers"]) {
    plane::Contours contours;
    for (const auto& contour : layer["contours"]) {
      for (const auto& p : contour["points"])
        contours.points.push_back({p[0], p[1]});
      contours.ends.push_back(
          static_cast<std::uint32_t>(contours.points.size()));
    }
    lamina.layers.push_back(std::move(contours));
  }
  return lamina;
}

// openscad's words where it left a part of the design out.
std::string missing_part(const Reference& reference) {
  for (const std::string_view words :
       {"Unable to convert to CGAL_Nef_Polyhedron",  // 2021.01
        "Unable to convert to CGALNefGeometry",      // 2025.07
        "-> Manifold conversion failed", "CGAL error in applyHull()"}) {
    if (reference.words.find(words) != std::string::npos) {
      return fmt::format("openscad left a part out: {}", words);
    }
  }
  return "";
}

// Why openscad's mesh is no judge of a section that differs; empty: it is one.
std::string fault_of(const Reference& reference, double z, double distance) {
  if (const auto part = missing_part(reference); !part.empty()) return part;
  const double overlap =
      oracle::overlap_of_section(reference.mesh, z, distance);
  const double allowed =
      distance *
      oracle::compare(oracle::exact_section(reference.mesh, z, distance),
                      ExactRegion())
          .expected_perimeter;
  if (overlap <= allowed) return "";
  return fmt::format("overlaps itself at z = {} in {:.3g} mm²", z, overlap);
}

// heights        of the mesh's sections
// layer_heights  of lamina's layers; none: those that it has
Judgement judge_mesh(const Reference& reference, const Design& design,
                     const std::vector<double>& heights,
                     const std::vector<double>& layer_heights) {
  const csg::Mesh& mesh = reference.mesh;
  const double distance = kOpenScadDistance + oracle::float32_spacing(mesh);
  std::vector<ExactRegion> sections;
  for (const double z : heights) {
    try {
      sections.push_back(oracle::exact_section(mesh, z, distance));
    } catch (const std::runtime_error& error) {
      return {"no-judge", error.what()};
    }
  }
  LaminaResult lamina = run_lamina(design, layer_heights);
  if (lamina.is_empty) {
    // Of a solid without volume, all sections are.
    lamina.layers.resize(heights.size());
  } else if (!lamina.complaint.empty()) {
    return {"differs", lamina.complaint};
  }
  if (lamina.layers.size() != heights.size()) {
    return {"differs", fmt::format("{} layers", lamina.layers.size())};
  }
  Judgement outcome = {"equal", ""};
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const oracle::Verdict verdict =
        oracle::judge(sections[i], lamina.layers[i], {distance, distance});
    if (!verdict.complaint.empty()) {
      const std::string fault = fault_of(reference, heights[i], distance);
      if (!fault.empty()) return {"no-judge", fault};
      outcome.verdict = "differs";
      outcome.complaint +=
          fmt::format("z = {}: {}\n", heights[i], verdict.complaint);
    }
  }
  return outcome;
}

}  // namespace

std::vector<double> generic_heights(const csg::Mesh& mesh, std::size_t count) {
  const auto [low, high] = std::minmax_element(
      mesh.vertices.begin(), mesh.vertices.end(),
      [](const Vec3& a, const Vec3& b) { return a.z < b.z; });
  return oracle::generic_heights({{mesh}, {}, {}, {}}, low->z, high->z, count);
}

Judgement judge_solid(const Reference& reference, const Design& design,
                      const std::vector<double>& heights) {
  return judge_mesh(reference, design, heights, heights);
}

Judgement judge_outline(const Reference& reference, const Design& design) {
  return judge_mesh(reference, design, {0.5}, {});
}

Judgement judge_empty(const Reference& reference, const Design& design) {
  const LaminaResult lamina = run_lamina(design, {});
  if (lamina.is_empty) return {"empty", ""};
  if (const auto part = missing_part(reference); !part.empty()) {
    return {"no-judge", part};
  }
  return {"differs", "openscad's is empty; " + lamina.complaint};
}

}  // namespace lamina::conformance
