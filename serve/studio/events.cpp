#include "serve/studio/events.h"

#include <filesystem>
#include <map>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/fingerprint.h"
#include "base/paths.h"
#include "base/version.h"
#include "compiler/tasks/quote.h"
#include "compiler/tasks/viewer_options.h"
#include "serve/run/messages.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/estimate.h"

namespace lamina::studio {
namespace {

using Json = nlohmann::ordered_json;
using serve::text_of;

Json event(const char* kind, std::uint64_t number) {
  return {{"kind", kind}, {"number", number}};
}

// The sets of the file beside the design.
Json sets_beside(const std::string& path, const FileAccess& access,
                 Diagnostics& diagnostics) {
  Json sets = Json::array();
  const std::string file = sets_file(path);
  if (!access.is_file(file)) return sets;
  try {
    const ParameterSets all = ParameterSets::read(file, access);
    for (std::size_t i = 0; i < all.size(); ++i) {
      Json values = Json::object();
      for (const ParameterValue& value : all.values_of(i)) {
        if (value.is_single) values[value.name] = value.text;
      }
      sets.push_back({{"name", all.name_of(i)}, {"values", std::move(values)}});
    }
  } catch (const FileError& error) {
    diagnostics.own_warning({}, error.diagnostic().message);
  }
  return sets;
}

// What a format is, for those who choose one.
std::string title_of_format(const std::string& extension) {
  static const std::map<std::string, std::string> kTitles = {
      {"slc", "layers for wax and resin printers"},
      {"cli", "Common Layer Interface"},
      {"svg", "polygons"},
      {"sl1", "images for Prusa"},
      {"goo", "images for Elegoo"},
      {"ctb", "images for ChiTuBox"},
      {"zip", "images for NanoDLP"},
      {"nanodlp", "images for NanoDLP"},
      {"slices.3mf", "a stack of slices"},
      {"layers.json", "layers in full precision"},
      {"csg", "the CSG tree"},
      {"echo", "what the design prints"},
      {"ast", "the syntax tree"},
      {"param", "the parameters"}};
  const auto title = kTitles.find(extension);
  return title == kTitles.end() ? "." + extension
                                : "." + extension + ": " + title->second;
}

}  // namespace

std::string sets_file(const std::string& path) {
  return std::filesystem::path(path).replace_extension(".json");
}

Form form_of(const ast::Program& program, const std::string& path,
             const FileAccess& access, Diagnostics& diagnostics) {
  Form form;
  form.parameters = text_of(serve::parameters_of(program));
  form.sets = text_of(sets_beside(path, access, diagnostics));
  form.key = digest(form.parameters + form.sets);
  return form;
}

std::string form_event(std::uint64_t number, const Form& form) {
  return fmt::format(
      R"({{"kind":"form","number":{},"key":"{}","parameters":{},"sets":{}}})",
      number, form.key, form.parameters, form.sets);
}

std::string messages_event(std::uint64_t number, const std::string& messages) {
  return fmt::format(R"({{"kind":"messages","number":{},"messages":{}}})",
                     number, messages);
}

std::string report_event(std::uint64_t number,
                         const compiler::Compilation& compilation,
                         const slicer::Inspection& found) {
  const slicer::PrintEstimate estimate =
      compiler::estimate_of(compilation, found);
  const slicer::Machine& machine = compilation.report.machine;
  const double cast = slicer::part_volume(found.volume, found.supports);
  const Vec3 size = found.box.size();
  Json json = event("report", number);
  json["size"] = {size.x, size.y, size.z};
  json["volume"] = cast;
  json["printed"] = found.volume;
  json["estimate"] = slicer::estimate_text(machine, estimate);
  json["seconds"] = estimate.seconds;
  json["price"] = estimate.price + estimate.metal_price;
  json["metals"] = compiler::weights_json(cast);
  return text_of(json);
}

std::string hello_event(const std::string& client, const serve::Names& names,
                        const std::string& design, const JobChoice& job) {
  Json formats = Json::array();
  for (const std::string& extension : names.formats) {
    formats.push_back(
        {{"name", extension}, {"title", title_of_format(extension)}});
  }
  return text_of({{"kind", "hello"},
                  {"client", client},
                  {"version", version()},
                  {"designs", names.designs},
                  {"design", design},
                  {"settings",
                   {{"layer", job.layer_thickness},
                    {"minFeature", job.min_feature},
                    {"supports", job.has_supports},
                    {"printer", job.printer},
                    {"material", job.material},
                    {"metal", job.metal}}},
                  {"printers", names.printers},
                  {"materials", names.materials},
                  {"metals", names.metals},
                  {"formats", std::move(formats)}});
}

std::string name_in_answer(const std::string& json) {
  const Json answer = Json::parse(json, nullptr, false);
  return answer.is_object() ? answer.value("name", "") : "";
}

std::string file_answer(std::uint64_t number, const std::string& name) {
  return text_of({{"file", fmt::format("/file/{}", number)}, {"name", name}});
}

std::string changed_event(const std::vector<std::string>& files) {
  return text_of({{"kind", "changed"}, {"files", files}});
}

std::string end_event(std::uint64_t number, bool is_well,
                      double seconds_to_layer, double seconds) {
  Json json = event("end", number);
  json["isWell"] = is_well;
  Json& times = json["milliseconds"] = Json::object();
  if (seconds_to_layer >= 0) times["layer"] = seconds_to_layer * 1e3;
  times["all"] = seconds * 1e3;
  return text_of(json);
}

}  // namespace lamina::studio
