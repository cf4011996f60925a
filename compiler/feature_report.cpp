#include "compiler/feature_report.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "slicer/check/feature_table.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::ordered_json;

std::string place_of(const SourceRange& range) {
  if (!range.is_known()) return {};
  const LineColumn at = range.source->line_column(range.begin);
  return fmt::format("{}:{}:{}", range.source->path(), at.line, at.column);
}

FeatureOrigin origin_of(const csg::Instance& instance) {
  FeatureOrigin origin;
  origin.place = place_of(instance.range);
  for (const csg::CallSite* call = instance.caller; call != nullptr;
       call = call->caller) {
    origin.calls.push_back({std::string(call->name), place_of(call->range)});
  }
  return origin;
}

std::string text_of(const FeatureOrigin& origin) {
  if (origin.calls.empty()) return origin.place;
  return fmt::format("{} from {}", origin.place, origin.calls.back().place);
}

Json json_of(const FeatureOrigin& origin) {
  Json json{{"place", origin.place}, {"called_by", Json::array()}};
  for (const FeatureOrigin::Call& call : origin.calls) {
    json["called_by"].push_back(
        {{"module", call.module}, {"place", call.place}});
  }
  return json;
}

Json json_of(const slicer::ThinFeature& feature, double width,
             const std::vector<FeatureOrigin>& origins) {
  Json json{{"kind", slicer::name_of(feature.kind)},
            {"width_mm", feature.width},
            {"first_layer", feature.first_layer},
            {"last_layer", feature.last_layer},
            {"bottom", feature.bottom},
            {"top", feature.top},
            {"is_low", slicer::is_low(feature, width)},
            {"layer", feature.layer},
            {"z", feature.section_z},
            {"x", feature.place.x},
            {"y", feature.place.y},
            {"low", {feature.low.x, feature.low.y}},
            {"high", {feature.high.x, feature.high.y}},
            {"made_by", Json::array()}};
  for (const FeatureOrigin& origin : origins) {
    json["made_by"].push_back(json_of(origin));
  }
  return json;
}

}  // namespace

std::vector<std::vector<FeatureOrigin>> origins_of(
    const csg::Scene& scene, std::span<const slicer::ThinFeature> features) {
  std::vector<std::vector<FeatureOrigin>> all;
  for (const slicer::ThinFeature& feature : features) {
    std::vector<FeatureOrigin>& origins = all.emplace_back();
    // In the order of the design; kNoInstance comes last.
    const auto [first, second] =
        std::minmax(feature.instances[0], feature.instances[1]);
    for (const std::uint32_t instance : {first, second}) {
      if (instance == slicer::kNoInstance) continue;
      FeatureOrigin origin = origin_of(scene.instances[instance]);
      if (origins.empty() || text_of(origins[0]) != text_of(origin)) {
        origins.push_back(std::move(origin));
      }
    }
  }
  return all;
}

std::vector<std::string> origin_texts(
    std::span<const std::vector<FeatureOrigin>> origins) {
  std::vector<std::string> texts;
  for (const std::vector<FeatureOrigin>& sides : origins) {
    std::string& text = texts.emplace_back();
    for (const FeatureOrigin& origin : sides) {
      if (!text.empty()) text += ", ";
      text += text_of(origin);
    }
  }
  return texts;
}

std::string features_json(std::span<const slicer::ThinFeature> features,
                          double width,
                          std::span<const std::vector<FeatureOrigin>> origins) {
  std::string text = "[";
  for (std::size_t i = 0; i < features.size(); ++i) {
    text += i == 0 ? "\n    " : ",\n    ";
    // Paths can hold any bytes.
    text +=
        json_of(features[i], width,
                i < origins.size() ? origins[i] : std::vector<FeatureOrigin>{})
            .dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return text + (features.empty() ? "]" : "\n  ]");
}

}  // namespace lamina::cli
