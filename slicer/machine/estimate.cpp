#include "slicer/machine/estimate.h"

#include <cmath>
#include <cstddef>
#include <string_view>

#include <fmt/format.h>

namespace lamina::slicer {
namespace {

std::string duration_text(double seconds) {
  const auto minutes = static_cast<long>(std::lround(seconds / 60));
  if (minutes < 1) return fmt::format("{:.0f} s", seconds);
  if (minutes < 60) return fmt::format("{} min", minutes);
  return fmt::format("{} h {} min", minutes / 60, minutes % 60);
}

// "12.3 g", "1.23 kg"
std::string amount_text(double amount, std::string_view unit,
                        std::string_view thousand) {
  return amount < 999.5 ? fmt::format("{:.3g} {}", amount, unit)
                        : fmt::format("{:.4g} {}", amount / 1000, thousand);
}

}  // namespace

double Exposure::of(std::size_t index) const {
  if (index < kFirstLayers) return first;
  const double step = (first - layer) / static_cast<double>(kFadeLayers + 1);
  const double faded =
      first - step * static_cast<double>(index - kFirstLayers + 1);
  return index < kFirstLayers + kFadeLayers ? faded : layer;
}

double print_seconds(const Printer& printer, const Exposure& exposure,
                     std::size_t layers) {
  if (printer.move_seconds == 0) return 0;
  double seconds = 0;
  for (std::size_t i = 0; i < layers; ++i) {
    seconds += exposure.of(i) + printer.move_seconds;
  }
  return seconds;
}

Exposure exposure_of(const std::optional<Material>& material) {
  if (!material || material->exposure == 0) return {};
  return {material->exposure, material->first_exposure};
}

PrintEstimate estimate_print(const std::optional<Printer>& printer,
                             const std::optional<Material>& material,
                             std::size_t layers, double volume) {
  PrintEstimate estimate;
  estimate.volume = volume;
  if (material) {
    estimate.grams = material->weight(volume);
    estimate.price = material->price * volume / 1e6;
  }
  if (printer) {
    estimate.seconds = print_seconds(*printer, exposure_of(material), layers);
  }
  return estimate;
}

std::string estimate_text(const std::optional<Printer>& printer,
                          const std::optional<Material>& material,
                          const PrintEstimate& estimate) {
  std::string text;
  const auto add = [&text](const std::string& words) {
    text += (text.empty() ? "" : ", ") + words;
  };
  const bool is_resin = material && material->exposure > 0;
  if (is_resin || (printer && !material)) {
    add(fmt::format("{} of {}", amount_text(estimate.volume / 1000, "ml", "l"),
                    material ? material->title : "resin"));
    if (material) add(amount_text(estimate.grams, "g", "kg"));
  } else if (material) {
    add(fmt::format("{} of {}", amount_text(estimate.grams, "g", "kg"),
                    material->title));
  }
  if (estimate.price > 0) {
    add(fmt::format("{:.2f} {}", estimate.price, material->currency));
  }
  if (estimate.seconds > 0) {
    const bool is_known = is_resin && (material->printer.empty() ||
                                       material->printer == printer->name);
    add(fmt::format("{} on {}{}", duration_text(estimate.seconds),
                    printer->title,
                    is_known ? ""
                             : fmt::format(" if a layer is exposed for {:g} s",
                                           exposure_of(material).layer)));
  }
  return text;
}

}  // namespace lamina::slicer
