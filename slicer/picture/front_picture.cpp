#include "slicer/picture/front_picture.h"

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace lamina::slicer {
namespace {

// Draws layers from the front: what each covers along x; and supports.
class FrontPicture {
 public:
  explicit FrontPicture(std::span<const Layer> layers) {
    for (const Layer& layer : layers) add(layer);
  }

  void add(const SupportPlan& plan) {
    for (const Support& support : plan.supports) {
      for (std::size_t i = 0; i + 1 < support.path.size(); ++i) {
        add_rod(support.path[i], support.path[i + 1],
                i == 0 ? support.tip : plan.sizes.pillar);
      }
    }
    for (const Brace& brace : plan.braces) {
      add_rod(brace[0], brace[1], plan.sizes.brace);
    }
  }

  std::string take() const {
    const Vec2 size = box_.size() + Vec2(2);
    return fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{:.2f} {:.2f} "
        "{:.2f} {:.2f}\"><g stroke=\"#7f9bb8\" stroke-linecap=\"round\">{}</g>"
        "<path fill=\"#d9a066\" d=\"{}\"/></svg>",
        box_.low.x - 1, -box_.high.y - 1, size.x, size.y, rods_, part_);
  }

 private:
  void add(const Layer& layer) {
    std::vector<std::pair<double, double>> spans;
    for (std::size_t i = 0; i < layer.contours.loop_count(); ++i) {
      Box2 box;
      box.add(layer.contours.loop(i));
      spans.emplace_back(box.low.x, box.high.x);
    }
    std::ranges::sort(spans);
    for (std::size_t i = 0; i < spans.size();) {
      auto [low, high] = spans[i];
      for (++i; i < spans.size() && spans[i].first <= high; ++i) {
        high = std::max(high, spans[i].second);
      }
      box_.add(Vec2(low, layer.bottom));
      box_.add(Vec2(high, layer.top));
      fmt::format_to(std::back_inserter(part_),
                     "M{:.2f} {:.2f}h{:.2f}v{:.2f}h{:.2f}z", low, -layer.bottom,
                     high - low, layer.bottom - layer.top - 0.02, low - high);
    }
  }

  void add_rod(Vec3 from, Vec3 to, double width) {
    box_.add(Vec2(from.x, from.z));
    box_.add(Vec2(to.x, to.z));
    fmt::format_to(std::back_inserter(rods_),
                   "<path stroke-width=\"{:.2f}\" d=\"M{:.2f} {:.2f}L{:.2f} "
                   "{:.2f}\"/>",
                   width, from.x, -from.z, to.x, -to.z);
  }

  Box2 box_;
  std::string part_;
  std::string rods_;
};

}  // namespace

std::string front_svg(std::span<const Layer> layers, const SupportPlan& plan) {
  FrontPicture picture(layers);
  picture.add(plan);
  return picture.take();
}

}  // namespace lamina::slicer
