// Measures the packer of plates: the densities that it reaches on instances of
// the irregular strip packing problem, and how long it takes for rings.
//
//   plate_bench strip FILE WORK      one line: pieces, length, density, seconds
//   plate_bench rings COUNT WORK     one line: rings, plates, seconds
//   plate_bench footprint LAYERS CORNERS
//                                    one line: layers, corners left, seconds
//
// FILE is an instance as sparrow reads it. Densities count only where the exact
// check finds no pieces too near to each other.

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "slicer/plate/distance.h"
#include "slicer/plate/footprint.h"
#include "slicer/plate/packer.h"
#include "slicer/plate/strip.h"

namespace lamina::slicer {
namespace {

double wall_seconds_of(const std::function<void()>& work) {
  const auto begin = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> duration =
      std::chrono::steady_clock::now() - begin;
  return duration.count();
}

double processor_seconds_of(const std::function<void()>& work) {
  const std::clock_t begin = std::clock();
  work();
  return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

struct Instance {
  std::vector<Piece> pieces;
  Strip strip;
};

Instance read_instance(const std::string& path) {
  std::ifstream file(path);
  const auto json = nlohmann::json::parse(file);
  Instance instance;
  instance.strip.depth = json["strip_height"];
  for (const auto& item : json["items"]) {
    plane::Contour contour;
    for (const auto& point : item["shape"]["data"]) {
      contour.emplace_back(point[0].get<double>(), point[1].get<double>());
    }
    if (contour.front() == contour.back()) contour.pop_back();
    plane::Region region{{contour}};
    if (area(region) < 0) {
      std::reverse(contour.begin(), contour.end());
      region = {{contour}};
    }
    instance.pieces.push_back({region, 0, item["demand"].get<std::size_t>()});
    instance.strip.turns =
        static_cast<unsigned>(item["allowed_orientations"].size());
  }
  return instance;
}

int measure_strip(const std::string& path, double work) {
  Instance instance = read_instance(path);
  instance.strip.work = work;
  StripPlan plan;
  const double seconds = processor_seconds_of(
      [&] { plan = pack_strip(instance.pieces, instance.strip); });
  double covered = 0;
  std::vector<plane::Region> placed;
  for (const Placement& one : plan.placements) {
    const plane::Region& footprint = instance.pieces[one.piece].footprint;
    covered += area(footprint);
    placed.push_back(place(footprint, one.turn_deg, one.shift));
  }
  const std::size_t too_near = find_too_near(placed, 0).size();
  fmt::print("{} {:.6g} {:.4f} {:.2f} {}\n", placed.size(), plan.length,
             covered / (plan.length * instance.strip.depth), seconds, too_near);
  return too_near == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}

// The footprint of a ring that stands (a slim oval), or lies (an annulus with a
// head), with uneven edges as supports make them.
plane::Region random_ring(std::mt19937& random) {
  const auto share = [&] { return static_cast<double>(random() % 1000) / 999; };
  const bool stands = random() % 2 == 0;
  const double radius = 8.5 + 3 * share();
  const double width = 1.5 + 3 * share();
  const double wave = 0.1 + 0.3 * share();
  plane::Region region;
  region.contours.resize(stands ? 1 : 2);
  constexpr int kCorners = 300;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * std::numbers::pi * i / kCorners;
    const Vec2 direction(std::cos(angle), std::sin(angle));
    const double edge = wave * std::sin(11 * angle);
    const double head = 2.5 * std::exp(-8 * std::pow(1 - direction.x, 2));
    if (stands) {
      region.contours[0].push_back(
          {(radius + edge) * direction.x, (width + edge + head) * direction.y});
    } else {
      region.contours[0].push_back((radius + width / 2 + edge + head) *
                                   direction);
      region.contours[1].insert(region.contours[1].begin(),
                                (radius - width / 4) * direction);
    }
  }
  return region;
}

int measure_rings(std::size_t count, double work) {
  std::mt19937 random(1);
  std::vector<Piece> pieces(count);
  for (Piece& piece : pieces) {
    piece.footprint = random_ring(random);
    piece.height = 5 + static_cast<double>(random() % 200) / 10;
  }
  Plate plate;
  plate.size = {143.4, 89.6};
  plate.gap = 1;
  plate.margin = 1;
  plate.work = work;
  PlatePlan plan;
  const double seconds =
      wall_seconds_of([&] { plan = pack_plates(pieces, plate); });
  fmt::print("{} {} {:.3f}\n", count, plan.plates, seconds);
  return EXIT_SUCCESS;
}

// Layers of a wavy ring that changes from layer to layer.
int measure_footprint(int layers, int corners) {
  std::vector<Layer> stack(static_cast<std::size_t>(layers));
  for (int i = 0; i < layers; ++i) {
    plane::Region region;
    region.contours.resize(2);
    for (int k = 0; k < corners / 2; ++k) {
      const double angle = 4 * std::numbers::pi * k / corners;
      const Vec2 direction(std::cos(angle), std::sin(angle));
      const double wave = 0.3 * std::sin(7 * angle + 0.02 * i);
      const double radius = 8 + 2 * std::sin(0.01 * i) + wave;
      region.contours[0].push_back(radius * direction);
      region.contours[1].insert(region.contours[1].begin(),
                                (radius - 1.5) * direction);
    }
    stack[static_cast<std::size_t>(i)].contours = plane::to_contours(region);
  }
  plane::Region footprint;
  const double seconds =
      wall_seconds_of([&] { footprint = footprint_of(stack); });
  fmt::print("{} {} {:.3f}\n", layers, plane::corner_count(footprint), seconds);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace lamina::slicer

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  if (words.size() == 3 && words[0] == "strip") {
    return lamina::slicer::measure_strip(words[1], std::stod(words[2]));
  }
  if (words.size() == 3 && words[0] == "rings") {
    return lamina::slicer::measure_rings(std::stoul(words[1]),
                                         std::stod(words[2]));
  }
  if (words.size() == 3 && words[0] == "footprint") {
    return lamina::slicer::measure_footprint(std::stoi(words[1]),
                                             std::stoi(words[2]));
  }
  fmt::print(stderr,
             "plate_bench strip FILE WORK | rings COUNT WORK | "
             "footprint LAYERS CORNERS\n");
  return 2;
}
