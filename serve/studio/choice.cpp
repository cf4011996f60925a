#include "serve/studio/choice.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "compiler/validate.h"
#include "slicer/formats/output_format.h"

namespace lamina::studio {
namespace {

using ReadJson = nlohmann::json;

// Reads members of an object, and says what is wrong with one.
class Members {
 public:
  Members(const ReadJson& json, std::string name)
      : json_(json), name_(std::move(name)) {
    if (!json.is_object()) fail("an object");
  }

  std::string text(const char* key) const {
    const ReadJson* value = find(key);
    if (value == nullptr) return {};
    if (!value->is_string()) fail(fmt::format("a text as '{}'", key));
    return value->get<std::string>();
  }
  double number(const char* key) const {
    const ReadJson* value = find(key);
    if (value == nullptr) return 0;
    if (!value->is_number()) fail(fmt::format("a number as '{}'", key));
    return value->get<double>();
  }
  bool truth(const char* key) const {
    const ReadJson* value = find(key);
    if (value == nullptr) return false;
    if (!value->is_boolean()) fail(fmt::format("true or false as '{}'", key));
    return value->get<bool>();
  }
  std::uint64_t count(const char* key) const {
    const ReadJson* value = find(key);
    if (value == nullptr) return 0;
    if (!value->is_number_unsigned()) {
      fail(fmt::format("a whole number as '{}'", key));
    }
    return value->get<std::uint64_t>();
  }
  const ReadJson* find(const char* key) const {
    const auto found = json_.find(key);
    return found == json_.end() || found->is_null() ? nullptr : &*found;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw ChoiceError(fmt::format("{} needs {}", name_, expected));
  }

  const ReadJson& json_;
  std::string name_;
};

ParameterSet read_values(const ReadJson& json) {
  if (!json.is_object()) throw ChoiceError("'values' needs an object");
  ParameterSet values;
  for (const auto& [name, value] : json.items()) {
    if (!value.is_string()) {
      throw ChoiceError(fmt::format("'values' needs a text as '{}'", name));
    }
    values.push_back({name, value.get<std::string>()});
  }
  return values;
}

JobChoice read_job(const ReadJson& json) {
  const Members members(json, "'settings'");
  return {.layer_thickness = members.number("layer"),
          .min_feature = members.number("minFeature"),
          .has_supports = members.truth("supports"),
          .printer = members.text("printer"),
          .material = members.text("material"),
          .metal = members.text("metal")};
}

}  // namespace

Choice read_choice(std::string_view text) {
  const ReadJson json = ReadJson::parse(text, nullptr, false);
  if (json.is_discarded()) throw ChoiceError("the body is not JSON");
  const Members members(json, "the body");
  Choice choice;
  choice.client = members.text("client");
  choice.number = members.count("number");
  choice.design = members.text("design");
  if (const ReadJson* values = members.find("values")) {
    choice.values = read_values(*values);
  }
  if (const ReadJson* job = members.find("settings"))
    choice.job = read_job(*job);
  choice.form = members.text("form");
  if (members.find("z") != nullptr) choice.z = members.number("z");
  choice.format = members.text("format");
  choice.key = members.text("key");
  return choice;
}

JobChoice job_of(const compiler::Request& request) {
  return {.layer_thickness = request.job.layer_thickness,
          .min_feature = request.job.min_feature,
          .has_supports = request.supports.has_value(),
          .printer = request.output.printer,
          .material = request.output.material,
          .metal = request.output.metal};
}

compiler::Request request_of(const Choice& choice,
                             const compiler::Request& base,
                             const serve::Names& names) {
  serve::require_name(names.printers, choice.job.printer, "printer");
  serve::require_name(names.materials, choice.job.material, "material");
  serve::require_name(names.metals, choice.job.metal, "metal");
  serve::require_name(names.formats, choice.format, "format");
  compiler::Request request = base;
  request.design.parameters = choice.values;
  request.job.layer_thickness = choice.job.layer_thickness;
  request.job.min_feature = choice.job.min_feature;
  if (!choice.job.has_supports) request.supports.reset();
  if (choice.job.has_supports && !request.supports) {
    request.supports = slicer::SupportSizes{.tip = 0};
  }
  request.output.printer = choice.job.printer;
  request.output.material = choice.job.material;
  request.output.metal = choice.job.metal;
  if (!choice.format.empty()) {
    request.output.format = *slicer::choose_output_format(choice.format).format;
  }
  compiler::validate(request);
  return request;
}

}  // namespace lamina::studio
