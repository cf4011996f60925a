#include "slicer/thickness/feeding.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "base/parallel.h"
#include "base/union_find.h"

namespace lamina::slicer {
namespace {

using Index = SolidCells::Index;

// By what share the first look at a cell may take its ball for too large.
constexpr double kFirstDoubt = 0.02;

// A cell on the surface itself has a ball all the same [mm].
constexpr double kLeastRadius = 1e-9;

std::vector<Index> list_cells(const SolidCells& cells) {
  std::vector<Index> list(cells.size());
  cells.visit(
      [&](std::uint32_t number, const Index& index) { list[number] = index; });
  return list;
}

// Sinks the height from the highest summit to the surface.
class Flood {
 public:
  Flood(const SolidSamples& samples, const ThicknessField& field)
      : samples_(samples),
        field_(field),
        cells_(list_cells(samples.cells)),
        order_(cells_.size()),
        rank_of_(cells_.size()) {
    std::iota(order_.begin(), order_.end(), 0U);
    std::sort(order_.begin(), order_.end(),
              [&](std::uint32_t a, std::uint32_t b) {
                return std::tuple(-field_.radii[a], a) <
                       std::tuple(-field_.radii[b], b);
              });
    for (std::uint32_t i = 0; i < order_.size(); ++i) rank_of_[order_[i]] = i;
  }

  void add_gate(const Gate& gate) {
    if (order_.empty()) return;
    const auto gap = [&](std::uint32_t cell) {
      const Vec3 middle = samples_.cells.middle_of(cells_[cell]);
      return glm::length(middle - gate.place) - field_.radii[cell];
    };
    const double slack =
        std::max(kReach * samples_.cells.pitch(), gate.diameter / 2);
    auto cell = std::find_if(order_.begin(), order_.end(),
                             [&](auto one) { return gap(one) <= slack; });
    if (cell == order_.end()) {
      cell = std::min_element(
          order_.begin(), order_.end(),
          [&](auto one, auto other) { return gap(one) < gap(other); });
    }
    const double radius = field_.radii[*cell];
    gates_.emplace_back(
        gate.diameter > 0 ? std::min(gate.diameter / 2, radius) : radius,
        *cell);
  }

  std::vector<Pool> run() {
    std::sort(gates_.rbegin(), gates_.rend());
    // Set 0 is the gate; set i + 1 begins with the cell of rank i. The least
    // number of a set is so that of its summit.
    sets_ = UnionFind(cells_.size() + 1);
    pools_ = UnionFind(cells_.size() + 1);
    pool_of_.assign(cells_.size(), 0);
    std::size_t gate = 0;
    for (std::uint32_t rank = 0; rank < order_.size(); ++rank) {
      const std::uint32_t cell = order_[rank];
      for (; gate < gates_.size() && gates_[gate].first > field_.radii[cell];
           ++gate) {
        open_gate(gates_[gate]);
      }
      join_neighbours(rank, cell);
    }
    for (; gate < gates_.size(); ++gate) open_gate(gates_[gate]);
    return collect();
  }

 private:
  struct Neck {
    std::uint32_t cell = 0;
    double radius = 0;
  };

  template <typename Visit>
  void visit_around(const Index& middle, const Visit& visit) const {
    for (int z = -1; z <= 1; ++z) {
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          const auto cell =
              samples_.cells.find({middle.x + x, middle.y + y, middle.z + z});
          if (cell) visit(*cell);
        }
      }
    }
  }

  void open_gate(const std::pair<double, std::uint32_t>& gate) {
    const auto [radius, cell] = gate;
    join(0, sets_.find(rank_of_[cell] + 1), {cell, radius});
  }

  void join_neighbours(std::uint32_t rank, std::uint32_t cell) {
    const std::uint32_t here = rank + 1;
    higher_.clear();
    visit_around(cells_[cell], [&](std::uint32_t other) {
      if (rank_of_[other] < rank) higher_.push_back(rank_of_[other]);
    });
    if (higher_.empty()) {
      pool_of_[cell] = here;  // a summit
      return;
    }
    // The cell belongs to the highest beside it, and joins the others.
    const std::uint32_t highest = *std::ranges::min_element(higher_);
    pool_of_[cell] = pool_of_[order_[highest]];
    sets_.unite(here, highest + 1);
    for (const std::uint32_t other : higher_) {
      join(sets_.find(here), sets_.find(other + 1), {cell, field_.radii[cell]});
    }
  }

  // a, b  summits of two sets
  void join(std::uint32_t a, std::uint32_t b, const Neck& neck) {
    if (a == b) return;
    const std::uint32_t low = std::max(a, b);
    const double summit = field_.radii[order_[low - 1]];
    const double least = std::min(summit * (1 - kFeedShare),
                                  summit - kNeckDoubt * samples_.cells.pitch());
    necks_[low] = neck;
    if (neck.radius >= least) pools_.unite(a, b);
    sets_.unite(a, b);
  }

  std::vector<Pool> collect() {
    // Of each pool, by its summit.
    std::map<std::uint32_t, std::vector<std::uint32_t>> cells;
    for (std::uint32_t cell = 0; cell < pool_of_.size(); ++cell) {
      cells[pools_.find(pool_of_[cell])].push_back(cell);
    }
    // Without a gate the thickest is fed, and what joins it.
    const std::uint32_t fed = gates_.empty() && !cells.empty() ? 1 : 0;
    std::vector<Pool> pools;
    for (auto& [summit, members] : cells) {
      pools.push_back(pool_at(summit, std::move(members), summit == fed));
    }
    std::sort(pools.begin(), pools.end(), [](const Pool& a, const Pool& b) {
      return std::tuple(a.is_fed, -a.volume) < std::tuple(b.is_fed, -b.volume);
    });
    return pools;
  }

  Pool pool_at(std::uint32_t summit, std::vector<std::uint32_t> members,
               bool is_fed) {
    Pool pool;
    // What joins the gate has its own highest cell.
    const std::uint32_t cell =
        summit == 0 ? highest_of_gate() : order_[summit - 1];
    pool.place = samples_.cells.middle_of(cells_[cell]);
    pool.thickness = 2 * field_.radii[cell];
    const double pitch = samples_.cells.pitch();
    pool.volume = static_cast<double>(members.size()) * pitch * pitch * pitch;
    pool.cells = std::move(members);
    pool.is_fed = is_fed;
    const auto neck = necks_.find(summit);
    if (neck != necks_.end()) {
      pool.neck = samples_.cells.middle_of(cells_[neck->second.cell]);
      pool.neck_thickness = 2 * neck->second.radius;
    }
    return pool;
  }

  std::uint32_t highest_of_gate() {
    const auto highest = std::find_if(
        order_.begin(), order_.end(),
        [&](std::uint32_t cell) { return pools_.find(pool_of_[cell]) == 0; });
    return *highest;
  }

  const SolidSamples& samples_;
  const ThicknessField& field_;
  std::vector<Index> cells_;
  std::vector<std::uint32_t> order_;    // cells, the highest first
  std::vector<std::uint32_t> rank_of_;  // each cell in that
  std::vector<std::pair<double, std::uint32_t>> gates_;
  UnionFind sets_;   // of cells above the height that hang together
  UnionFind pools_;  // of summits that feed each other
  std::vector<std::uint32_t> pool_of_;   // each cell: a number in pools_
  std::vector<std::uint32_t> higher_;    // ranks around the present cell
  std::map<std::uint32_t, Neck> necks_;  // of summits
};

}  // namespace

SolidSamples sample_casting(const csg::Scene& scene) {
  constexpr double kFirstCells = 3e5;  // of the box, to know the volume
  constexpr double kCells = 2e5;       // of the solid
  constexpr double kMostRays = 1e6;    // along an axis, for a thin plate
  const Vec3 size = glm::max(scene.box.size(), Vec3(kLeastRadius));
  double pitch = std::cbrt(size.x * size.y * size.z / kFirstCells);
  SolidSamples samples = sample_solid(scene, pitch);
  const double face =
      std::max({size.x * size.y, size.y * size.z, size.z * size.x});
  while (samples.cells.size() == 0 && 4 * face < kMostRays * pitch * pitch) {
    samples = sample_solid(scene, pitch /= 2);
  }
  if (samples.cells.size() == 0) return samples;
  // A thin plate has fewer cells, rather than none.
  const double filled = static_cast<double>(samples.cells.size()) / kCells;
  SolidSamples fine = sample_solid(scene, pitch * std::cbrt(filled));
  return fine.cells.size() > 0 ? fine : samples;
}

ThicknessField measure_thickness(const SolidSamples& samples,
                                 const BallFinder& balls) {
  const SolidCells& cells = samples.cells;
  const std::vector<Index> list = list_cells(cells);
  const double pitch = cells.pitch();

  // A first look. A ray along y enters at most one step before its first cell.
  ThicknessField field{std::vector<double>(list.size())};
  std::vector<std::uint32_t> feet(list.size());
  for_each_index(list.size(), [&](std::size_t cell) {
    const Vec3 middle = cells.middle_of(list[cell]);
    for (double within = 2 * pitch; !(field.radii[cell] > 0); within *= 2) {
      const auto foot = balls.nearest(middle, within, kFirstDoubt);
      if (!foot) continue;
      field.radii[cell] = std::max(foot->distance, kLeastRadius);
      feet[cell] = foot->point;
    }
  });

  // Where no cell beside is clearly farther from the surface, a summit or a
  // neck may be: let the ball grow away from what is nearest.
  const std::vector<double> first = field.radii;
  for_each_index(list.size(), [&](std::size_t cell) {
    const Vec3 middle = cells.middle_of(list[cell]);
    const auto inward_from = [&](std::uint32_t point) {
      return (middle - samples.points[point].place) / first[cell];
    };
    const auto next =
        cells.find(cells.index_at(middle + pitch * inward_from(feet[cell])));
    if (next && first[*next] > first[cell] + kReach * pitch) return;
    const auto foot = balls.nearest(middle, first[cell]);
    if (foot) {
      field.radii[cell] = foot->distance;
      feet[cell] = foot->point;
    }
    const Vec3 touch = samples.points[feet[cell]].place;
    field.radii[cell] = std::max(
        field.radii[cell], balls
                               .grow(touch, glm::normalize(middle - touch),
                                     field.radii[cell] + kReach * pitch)
                               .radius);
  });
  return field;
}

std::vector<Pool> find_pools(const SolidSamples& samples,
                             const BallFinder& balls,
                             const ThicknessField& field,
                             const std::vector<Gate>& gates) {
  Flood flood(samples, field);
  for (const Gate& gate : gates) flood.add_gate(gate);
  std::vector<Pool> pools = flood.run();
  for (Pool& pool : pools) {
    const Ball ball = balls.climb(pool.place, 2 * samples.pitch);
    pool.place = ball.centre;
    pool.thickness = std::max(pool.thickness, 2 * ball.radius);
  }
  return pools;
}

}  // namespace lamina::slicer
