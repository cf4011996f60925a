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

std::string grams_text(double grams) { return amount_text(grams, "g", "kg"); }

bool is_for(const KnownExposure& known, const std::string& printer) {
  return known.printer.empty() || known.printer == printer;
}

}  // namespace

std::string price_text(const Material& material, double price) {
  if (price == 0) return {};
  return fmt::format(", {:.2f}{}{}", price,
                     material.price->currency.empty() ? "" : " ",
                     material.price->currency);
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

ChosenExposure choose_exposure(const Machine& machine, double layer_thickness) {
  if (!machine.material || machine.material->exposures.empty()) return {};
  const std::string printer = machine.printer ? machine.printer->name : "";
  const auto off = [&](const KnownExposure& known) {
    return known.layer_thickness == 0
               ? 0
               : std::abs(known.layer_thickness - layer_thickness);
  };
  const KnownExposure* best = nullptr;
  for (const KnownExposure& known : machine.material->exposures) {
    const bool is_better =
        best == nullptr || (is_for(known, printer) != is_for(*best, printer)
                                ? is_for(known, printer)
                                : off(known) < off(*best));
    if (is_better) best = &known;
  }
  if (!is_for(*best, printer)) return {best->exposure, best->printer, true};
  if (off(*best) == 0) return {best->exposure, "", false};
  return {best->exposure,
          fmt::format("layers of {:g} mm", best->layer_thickness), true};
}

PrintEstimate estimate_print(const Machine& machine, double layer_thickness,
                             std::size_t layers, double volume, double cast) {
  PrintEstimate estimate;
  estimate.volume = volume;
  if (const auto& material = machine.material) {
    estimate.grams = material->weight(volume);
    if (material->price) {
      estimate.price = material->price->of(estimate.grams, volume);
    }
  }
  if (const auto& metal = machine.metal) {
    estimate.metal_grams = metal->weight(cast);
    if (metal->price) {
      estimate.metal_price = metal->price->of(estimate.metal_grams, cast);
    }
  }
  if (machine.printer) {
    estimate.exposure = choose_exposure(machine, layer_thickness);
    estimate.seconds =
        print_seconds(*machine.printer, estimate.exposure.exposure, layers);
  }
  return estimate;
}

PrintEstimate operator+(PrintEstimate sum, const PrintEstimate& other) {
  sum.seconds += other.seconds;
  sum.exposure = other.exposure;
  sum.volume += other.volume;
  sum.grams += other.grams;
  sum.price += other.price;
  sum.metal_grams += other.metal_grams;
  sum.metal_price += other.metal_price;
  return sum;
}

std::string estimate_text(const Machine& machine,
                          const PrintEstimate& estimate) {
  const auto& [printer, material, metal] = machine;
  std::string text;
  const auto add = [&text](const std::string& words) {
    text += (text.empty() ? "" : ", ") + words;
  };
  const std::string volume = amount_text(estimate.volume / 1000, "ml", "l");
  if (material) {
    add(fmt::format("{} of {}, {}{}", volume, material->title,
                    grams_text(estimate.grams),
                    price_text(*material, estimate.price)));
  } else if (printer && !metal) {
    add(fmt::format("{} of resin", volume));
  }
  if (metal) {
    add(fmt::format("{}{} of {}{}", material ? "cast in " : "",
                    grams_text(estimate.metal_grams), metal->title,
                    price_text(*metal, estimate.metal_price)));
  }
  if (estimate.seconds > 0) {
    add(fmt::format("{} on {}{}", duration_text(estimate.seconds),
                    printer->title,
                    estimate.exposure.is_assumed
                        ? fmt::format(" if a layer is exposed for {:g} s",
                                      estimate.exposure.exposure.layer)
                        : ""));
  }
  return text;
}

}  // namespace lamina::slicer
