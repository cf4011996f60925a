#include "compiler/tasks/quote.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "compiler/tasks/viewer_options.h"
#include "parser/customizer/customizer.h"
#include "slicer/machine/estimate.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::compiler {
namespace {

using Json = nlohmann::ordered_json;

// The values of all parameters.
Json values_json(const ast::Program& program) {
  Json values = Json::object();
  for (const Json& parameter : parameter_list(program)) {
    values[parameter["name"].get<std::string>()] = parameter["initial"];
  }
  return values;
}

void add_price(Json& json, const slicer::Material& material, double price) {
  if (price == 0) return;
  json["price"] = price;
  if (!material.price->currency.empty()) {
    json["currency"] = material.price->currency;
  }
}

void add_machine(Json& json, const Compilation& compilation,
                 const slicer::Inspection& found) {
  const Machine& machine = compilation.report.machine;
  const slicer::PrintEstimate estimate = estimate_of(compilation, found);
  if (machine.material) {
    Json& material = json["material"];
    material = {{"name", machine.material->name},
                {"grams", estimate.grams},
                {"millilitres", estimate.volume / 1000}};
    add_price(material, *machine.material, estimate.price);
  }
  if (machine.metal) {
    Json& metal = json["metal"];
    metal = {{"name", machine.metal->name}, {"grams", estimate.metal_grams}};
    add_price(metal, *machine.metal, estimate.metal_price);
  }
  if (machine.printer) json["printer"] = machine.printer->name;
  if (estimate.seconds > 0) json["seconds"] = estimate.seconds;
}

Json findings_json(const Inspection& inspection, const std::string& folder) {
  Json json = Json::array();
  if (!inspection.found.print) return json;
  const auto& findings = inspection.found.print->findings;
  for (std::size_t i = 0; i < findings.size(); ++i) {
    const slicer::Finding& finding = findings[i];
    json.push_back(
        {{"kind", slicer::name_of(finding.kind)},
         {"layer", finding.layer},
         {"x", finding.place.x},
         {"y", finding.place.y},
         {"z", finding.section_z},
         {"isMinor", finding.is_minor},
         {"source", text_from(folder, inspection.lines.findings[i])}});
  }
  return json;
}

Json thin_places_json(const Inspection& inspection, const std::string& folder) {
  Json json = Json::array();
  const auto& features = inspection.found.features;
  for (std::size_t i = 0; i < features.size(); ++i) {
    const slicer::ThinFeature& feature = features[i];
    json.push_back(
        {{"kind", slicer::name_of(feature.kind)},
         {"width", feature.width},
         {"layer", feature.layer},
         {"x", feature.place.x},
         {"y", feature.place.y},
         {"z", feature.section_z},
         {"source", text_from(folder, inspection.lines.features[i])}});
  }
  return json;
}

}  // namespace

Json parameter_list(const ast::Program& program) {
  Json file = Json::parse(parameters_json(program, ""));
  return file.contains("parameters") ? std::move(file["parameters"])
                                     : Json::array();
}

Json weights_json(double volume) {
  Json metals = Json::array();
  for (const slicer::Material& material : slicer::known_materials()) {
    if (!material.is_metal()) continue;
    metals.push_back({{"name", material.name},
                      {"title", material.title},
                      {"grams", material.weight(volume)}});
  }
  return metals;
}

Json quote_json(const Compilation& compilation, const Inspection& inspection) {
  const slicer::Inspection& found = inspection.found;
  const std::string& path = compilation.request.design.path;
  const std::string folder = folder_of(path);
  const double volume = slicer::part_volume(found.volume, found.supports);
  const Vec3 size = found.box.size();
  const Vec3 low = found.box.low;
  Json json = {{"design", std::filesystem::path(path).stem().string()},
               {"values", values_json(compilation.design.program)},
               {"size", {size.x, size.y, size.z}},
               {"low", {low.x, low.y, low.z}},
               {"volume", volume},
               {"printed", found.volume},
               {"layers", found.layers.size()},
               {"layer", compilation.request.job.layer_thickness}};
  add_machine(json, compilation, found);
  json["metals"] = weights_json(volume);
  json["findings"] = findings_json(inspection, folder);
  if (compilation.request.job.min_feature > 0) {
    json["thinPlaces"] = thin_places_json(inspection, folder);
  }
  return json;
}

}  // namespace lamina::compiler
