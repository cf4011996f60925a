#include "cli/commands/preflight_page.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <glm/trigonometric.hpp>

#include "base/paths.h"
#include "base/text.h"
#include "slicer/picture/image.h"
#include "slicer/picture/stack_picture.h"

namespace lamina::cli {
namespace {

constexpr unsigned kPictureSide = 460;  // [pixels]

constexpr std::string_view kStyle =
    "@page{size:A4;margin:12mm}"
    "body{font:13px/1.35 sans-serif;max-width:186mm;margin:1em auto;padding:0 "
    "1em;color:#111}"
    "@media print{body{margin:0;padding:0;font-size:10px}}"
    "h1{font-size:1.5em;margin:0}h2{font-size:1.1em;margin:1em 0 .3em}"
    ".verdict{padding:.4em .7em;border-radius:4px;margin:.5em 0;font-weight:"
    "bold}.good{background:#e2f3e4}.bad{background:#fbe3e0}"
    ".views{display:grid;grid-template-columns:repeat(3,1fr);gap:3mm}"
    ".view{position:relative}.view img{width:100%;display:block}"
    ".view svg{position:absolute;inset:0;width:100%;height:100%}"
    ".view p{text-align:center;margin:0;color:#555}"
    ".legend svg{height:1em;width:1.6em;vertical-align:-.15em;margin:0 .3em 0 "
    "1.2em}"
    ".columns{display:grid;grid-template-columns:1fr 1fr;gap:0 "
    "8mm;align-items:start}"
    "@media(max-width:600px){.columns{grid-template-columns:1fr}}"
    "table{border-collapse:collapse;width:100%}td,th{text-align:left;padding:"
    ".12em .5em .12em 0;border-bottom:1px solid #ddd;vertical-align:top}"
    "td.n,th.n{text-align:right;white-space:nowrap}"
    ".list{overflow-x:auto}code{font-size:.95em}";

struct View {
  const char* name;
  Vec3 turn_deg;
};
constexpr std::array<View, 3> kViews = {{{"from the front", Vec3(90, 0, 0)},
                                         {"from the right", Vec3(90, 0, 90)},
                                         {"from above", Vec3(0, 0, 0)}}};

// "A", "B", …, "Z", "AA": what pictures and lists call heavy places.
std::string letter_of(std::size_t index) {
  std::string letters;
  for (std::size_t left = index + 1; left > 0; left = (left - 1) / 26) {
    letters.insert(letters.begin(), static_cast<char>('A' + (left - 1) % 26));
  }
  return letters;
}

// What metal reaches is blue. What it does not reach is orange, which the
// colour-blind tell from blue (Okabe and Ito 2008), and striped, which black
// ink shows too.
constexpr slicer::Rgb kReached = {0.60F, 0.74F, 0.86F};
constexpr slicer::Rgb kUnreached = {0.95F, 0.62F, 0.20F};
constexpr slicer::Rgb kStripe = {0.45F, 0.22F, 0.02F};
// From stripe to stripe, as a share of the picture, and how much of that a
// stripe takes.
constexpr double kStripeStep = 0.022;
constexpr double kStripeShare = 0.3;

// Colours of places by what metal reaches, in what a camera sees.
class FeedingPaint {
 public:
  // shown  width of what the picture shows [mm]
  FeedingPaint(const compiler::Preflight& found, const slicer::Camera& camera,
               double shown)
      : found_(found),
        view_from_world_(camera.view_from_world()),
        step_(kStripeStep * shown) {}

  std::optional<slicer::Rgb> operator()(Vec3 place) const {
    const auto cell = found_.cells.find_near(place);
    if (!cell) return std::nullopt;
    if (found_.is_reached[*cell]) return kReached;
    const Vec4 view = view_from_world_ * Vec4(place, 1);
    const double along = (view.x + view.y) / (std::numbers::sqrt2 * step_);
    return along - std::floor(along) < kStripeShare ? kStripe : kUnreached;
  }

 private:
  const compiler::Preflight& found_;
  Mat4 view_from_world_;
  double step_;
};

// Marks of findings in a picture, where the camera shows their places.
class Marks {
 public:
  Marks(const slicer::Camera& camera, const Box3& box)
      : clip_from_world_(camera.clip_from_view(1, box) *
                         camera.view_from_world()) {}

  // A number in a disk.
  void add_fault(Vec3 place, std::size_t number) {
    const Vec2 at = picture_from(place);
    svg_ += fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2.6\" fill=\"#c0281c\" "
        "fill-opacity=\".85\"/>",
        at.x, at.y);
    add_label(at, std::to_string(number));
  }
  // A letter in a square.
  void add_heavy(Vec3 place, const std::string& letter) {
    const Vec2 at = picture_from(place);
    svg_ += fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"4.8\" height=\"4.8\" "
        "fill=\"#222\" fill-opacity=\".85\"/>",
        at.x - 2.4, at.y - 2.4);
    add_label(at, letter);
  }
  std::string text() const {
    return "<svg viewBox=\"0 0 100 100\" aria-hidden=\"true\">" + svg_ +
           "</svg>";
  }

 private:
  // As shares of the picture in percent, y down.
  Vec2 picture_from(Vec3 place) const {
    const Vec4 clip = clip_from_world_ * Vec4(place, 1);
    return (Vec2(clip.x, -clip.y) / clip.w + 1.0) * 50.0;
  }
  void add_label(Vec2 at, const std::string& label) {
    svg_ += fmt::format(
        "<text x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"3.4\" "
        "text-anchor=\"middle\" fill=\"#fff\" font-family=\"sans-serif\">"
        "{}</text>",
        at.x, at.y + 1.2, label);
  }

  Mat4 clip_from_world_;
  std::string svg_;
};

// What pictures and lists call an engraving: they count on from what is too
// thin.
std::size_t shallow_number(const compiler::Preflight& found,
                           std::size_t index) {
  return std::min(found.too_thin.size(), kMostRows) + index + 1;
}

std::string picture_of(const compiler::Preflight& found, const View& view) {
  slicer::StackOptions options;
  options.width = options.height = kPictureSide;
  options.centers = options.shows_all = false;
  options.colors = slicer::find_color_scheme("silver");
  options.camera.projection = slicer::Camera::Projection::kOrthogonal;
  options.camera.turn_deg = view.turn_deg;
  options.camera.center_on(found.box);
  options.camera.show_all(found.box);
  options.paint =
      FeedingPaint(found, options.camera,
                   2 * options.camera.distance *
                       std::tan(glm::radians(options.camera.field_deg / 2)));
  Marks marks(options.camera, found.box);
  for (std::size_t i = 0; i < std::min(found.unfed.size(), kMostRows); ++i) {
    marks.add_heavy(found.unfed[i].pool.place, letter_of(i));
  }
  for (std::size_t i = 0; i < std::min(found.too_thin.size(), kMostRows); ++i) {
    marks.add_fault(found.too_thin[i].place.place, i + 1);
  }
  for (std::size_t i = 0; i < std::min(found.too_shallow.size(), kMostRows);
       ++i) {
    marks.add_fault(found.too_shallow[i].engraving.place,
                    shallow_number(found, i));
  }
  return fmt::format(
      "<div class=\"view\"><img alt=\"{0}\" src=\"data:image/png;base64,{1}\">"
      "{2}<p>{0}</p></div>\n",
      view.name, base64(png_of(draw_stack(found.layers, options))),
      marks.text());
}

std::string css_of(const slicer::Rgb& color) {
  return fmt::format("rgb({:.0f},{:.0f},{:.0f})", 255 * color[0],
                     255 * color[1], 255 * color[2]);
}

// What colours and marks of the pictures mean, as far as they have them.
std::string legend_of(const compiler::Preflight& found) {
  const auto key = [](const std::string& drawing, std::string_view words) {
    return fmt::format(
        "<svg viewBox=\"0 0 16 10\" aria-hidden=\"true\">{}</svg>{}", drawing,
        words);
  };
  const auto field = [](const slicer::Rgb& color) {
    return fmt::format("<path fill=\"{}\" d=\"M0 0h16v10H0z\"/>",
                       css_of(color));
  };
  std::string text =
      "<p class=\"legend\">" + key(field(kReached), "metal reaches it");
  if (!found.unfed.empty()) {
    const std::string stripes = fmt::format(
        "<path stroke=\"{}\" stroke-width=\"1.5\" d=\"M-2 2l10 10M2 -1l12 "
        "12M7 -1l10 10M12 -1l6 6\"/>",
        css_of(kStripe));
    text += key(field(kUnreached) + stripes,
                "freezes by itself; A, B: its heaviest places");
  }
  if (!found.is_ready()) {
    text += key("<circle cx=\"8\" cy=\"5\" r=\"5\" fill=\"#c0281c\"/>",
                "1, 2: too thin or too shallow");
  }
  return text + "</p>\n";
}

std::string row(std::string_view name, std::string_view value) {
  return fmt::format("<tr><th>{}</th><td>{}</td></tr>\n", name, value);
}

std::string facts_of(const compiler::Preflight& found) {
  const Vec3 size = found.box.size();
  const slicer::CastingLimits& limits = *found.metal.casting;
  std::string text = "<table>\n";
  text += row("size", fmt::format("{:.2f} × {:.2f} × {:.2f} mm", size.x, size.y,
                                  size.z));
  text += row("volume", fmt::format("{:.1f} mm³", found.volume));
  text += row("surface", fmt::format("{:.0f} mm²", found.area));
  if (found.finger > 0) {
    text += row("inner diameter", fmt::format("{:.2f} mm ({})", found.finger,
                                              ring_size_text(found.finger)));
  }
  text += row("thickest place", fmt::format("{:.2f} mm", found.thickest));
  text += row("asked for", least_text(limits));
  text += row("finishing takes",
              fmt::format("up to {} mm of a surface", limits.finishing));
  return text + "</table>\n";
}

std::string weights_of(const compiler::Preflight& found) {
  std::string text = "<table>\n";
  for (const slicer::Material& metal : found.metals) {
    text += fmt::format("<tr><th>{}</th><td class=\"n\">{:.2f} g</td></tr>\n",
                        escape_html(metal.title), metal.weight(found.volume));
  }
  return text + "</table>\n";
}

std::string more_of(std::size_t count) {
  return count > kMostRows
             ? fmt::format("<p>and {} more</p>\n", count - kMostRows)
             : "";
}

std::string thin_of(const compiler::Preflight& found,
                    const std::string& folder) {
  if (found.too_thin.empty()) return "";
  std::string text =
      "<h2>Too thin</h2><div class=\"list\"><table><tr><th></th><th></th><th "
      "class=\"n\">is</th><th class=\"n\">asked for</th><th class=\"n\">area"
      "</th><th>at</th><th>made by</th></tr>\n";
  for (std::size_t i = 0; i < std::min(found.too_thin.size(), kMostRows); ++i) {
    const compiler::TooThin& one = found.too_thin[i];
    text += fmt::format(
        "<tr><td>{}</td><td>{}</td><td class=\"n\">{:.2f} mm</td><td class="
        "\"n\">{:.2f} mm</td><td class=\"n\">{:.2f} mm²</td><td "
        "class=\"n\">{}</td><td>"
        "<code>{}</code></td></tr>\n",
        i + 1, kind_of(one), one.place.width, one.least, one.place.area,
        place_text(one.place.place),
        escape_html(compiler::text_from(folder, one.lines)));
  }
  return text + "</table></div>\n" + more_of(found.too_thin.size());
}

std::string shallow_of(const compiler::Preflight& found,
                       const std::string& folder) {
  if (found.too_shallow.empty()) return "";
  std::string text =
      "<h2>Too shallow</h2><div class=\"list\"><table><tr><th></th><th></th>"
      "<th class=\"n\">is deep</th><th class=\"n\">asked for</th><th class="
      "\"n\">is wide</th><th>at</th><th>made by</th></tr>\n";
  for (std::size_t i = 0; i < std::min(found.too_shallow.size(), kMostRows);
       ++i) {
    const auto& [engraving, least, lines] = found.too_shallow[i];
    text += fmt::format(
        "<tr><td>{}</td><td>engraving</td><td class=\"n\">{:.2f} mm</td><td "
        "class=\"n\">{:.2f} mm</td><td class=\"n\">{:.2f} mm</td><td>{}</td>"
        "<td><code>{}</code></td></tr>\n",
        shallow_number(found, i), engraving.depth, least, engraving.width,
        place_text(engraving.place),
        escape_html(compiler::text_from(folder, lines)));
  }
  return text + "</table></div>\n" + more_of(found.too_shallow.size());
}

std::string feeding_of(const compiler::Preflight& found,
                       const std::string& folder) {
  std::string gates;
  for (const slicer::Gate& gate : found.gates) {
    gates += (gates.empty() ? "" : " and ") + place_text(gate.place);
  }
  std::string text = "<h2>Feeding</h2><p>Metal enters at " + gates + ". ";
  if (found.unfed.empty()) {
    return text + "It reaches every heavy place through places as thick.</p>\n";
  }
  text +=
      "These places are thicker than the way to them, and would freeze last, "
      "by themselves:</p><div class=\"list\"><table><tr><th></th><th class="
      "\"n\">is</th><th class=\"n\">fed through</th><th class=\"n\">volume"
      "</th><th>at</th><th>neck at</th><th>made by</th></tr>\n";
  for (std::size_t i = 0; i < std::min(found.unfed.size(), kMostRows); ++i) {
    const auto& [pool, lines] = found.unfed[i];
    text += fmt::format(
        "<tr><td>{}</td><td class=\"n\">{:.2f} mm</td><td class=\"n\">{:.2f} "
        "mm</td><td class=\"n\">{:.1f} mm³</td><td>{}</td><td>{}</td><td>"
        "<code>{}</code></td></tr>\n",
        letter_of(i), pool.thickness, pool.neck_thickness, pool.volume,
        place_text(pool.place),
        pool.neck_thickness > 0 ? place_text(pool.neck) : "–",
        escape_html(compiler::text_from(folder, lines)));
  }
  return text + "</table></div>\n" + more_of(found.unfed.size());
}

std::string verdict_of(const compiler::Preflight& found) {
  const std::string faults = fault_text(found);
  std::string text = faults.empty()
                         ? "No measure is below what the metal asks for"
                         : "Not ready: " + faults;
  if (!found.unfed.empty()) {
    text += fmt::format("; metal reaches {} through thinner ones only",
                        counted(found.unfed.size(), "heavy place"));
  }
  return text;
}

std::string stones_of(const compiler::Preflight& found) {
  if (found.stones.empty()) return "";
  std::string text = "<h2>Stones</h2><table>\n";
  for (const compiler::StoneParameter& one : found.stones) {
    text += fmt::format(
        "<tr><th><code>{}</code></th><td>{}</td><td>{}</td><td>{}</td></tr>\n",
        escape_html(one.entry.name), escape_html(one.entry.value),
        stone_text(one), escape_html(one.entry.comment.description));
  }
  return text +
         "</table><p>Sizes are those of round brilliants: diameter² × 0.6 "
         "diameter × 0.0061.</p>\n";
}

// All that are not of stones.
std::string parameters_of(const compiler::Preflight& found) {
  std::vector<CustomizerEntry> parameters = found.parameters;
  std::erase_if(parameters, [&](const CustomizerEntry& one) {
    return std::ranges::any_of(found.stones, [&](const auto& stone) {
      return stone.entry.name == one.name;
    });
  });
  if (parameters.empty()) return "";
  std::string text = "<h2>Parameters</h2><div class=\"columns\">";
  const std::size_t half = (parameters.size() + 1) / 2;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (i % half == 0) text += i == 0 ? "<table>\n" : "</table><table>\n";
    const CustomizerEntry& one = parameters[i];
    const std::string& words = one.comment.description;
    text += fmt::format(
        "<tr><th><code>{}</code></th><td>{}</td><td>{}</td>"
        "</tr>\n",
        escape_html(one.name), escape_html(one.value), escape_html(words));
  }
  return text + "</table></div>\n";
}

}  // namespace

std::string ring_size_text(double diameter) {
  const auto rounded = [](double size, double step) {
    return std::round(size / step) * step;
  };
  return fmt::format("EU {:g}, US {:g}",
                     rounded(compiler::european_ring_size(diameter), 0.5),
                     rounded(compiler::american_ring_size(diameter), 0.25));
}

std::string stone_text(const compiler::StoneParameter& stone) {
  if (!stone.diameter) return "";
  return fmt::format("{:.2f} mm, {:.3f} ct", *stone.diameter, *stone.carats);
}

std::string fault_text(const compiler::Preflight& found) {
  std::string text;
  for (const char* kind : {"wall", "wire", "gap"}) {
    const auto count = static_cast<std::size_t>(std::ranges::count_if(
        found.too_thin, [&](const auto& one) { return kind_of(one) == kind; }));
    if (count == 0) continue;
    text += fmt::format("{}{} {} too {}", text.empty() ? "" : ", ",
                        counted(count, kind), count == 1 ? "is" : "are",
                        kind == std::string_view("gap") ? "narrow" : "thin");
  }
  if (const std::size_t count = found.too_shallow.size(); count > 0) {
    text += fmt::format("{}{} {} too shallow", text.empty() ? "" : ", ",
                        counted(count, "engraving"), count == 1 ? "is" : "are");
  }
  return text;
}

std::string least_text(const slicer::CastingLimits& limits) {
  std::string text =
      fmt::format("walls {} mm, prongs and wires {} mm, gaps {} mm",
                  limits.wall, limits.wire, limits.gap);
  if (limits.engraving > 0) {
    text += fmt::format(", engravings {} mm deep", limits.engraving);
  }
  return text;
}

std::string kind_of(const compiler::TooThin& one) {
  if (one.place.is_gap) return "gap";
  return one.place.shape == slicer::ThinShape::kWire ? "wire" : "wall";
}

std::string preflight_page(const compiler::Preflight& found,
                           const std::string& design) {
  const std::string name =
      escape_html(std::filesystem::path(design).filename().string());
  const std::string folder = folder_of(design);
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta "
      "name=\"viewport\" content=\"width=device-width\"><title>{0}</title>"
      "<style>{1}</style></head><body>\n<h1>{0}</h1><p>To be cast in {2}: "
      "{3:.2f} g</p>\n<p class=\"verdict {4}\">{5}</p>\n<div class=\"views\">",
      name, kStyle, escape_html(found.metal.title),
      found.metal.weight(found.volume), found.is_ready() ? "good" : "bad",
      verdict_of(found));
  for (const View& view : kViews) page += picture_of(found, view);
  page += "</div>\n" + legend_of(found) +
          "<div class=\"columns\"><div><h2>Measures</h2>" + facts_of(found) +
          "</div><div><h2>Weights</h2>" + weights_of(found) + "</div></div>\n";
  page += thin_of(found, folder) + shallow_of(found, folder) +
          feeding_of(found, folder) + stones_of(found) + parameters_of(found);
  page += fmt::format(
      "<p>Least measures: {}. Thickness is that of the largest ball, measured "
      "by rays {:.2f} mm apart.</p></body></html>\n",
      escape_html(found.metal.casting->source), found.pitch);
  return page;
}

}  // namespace lamina::cli
