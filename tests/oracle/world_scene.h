#pragma once
// A scene as the judges see it: every leaf an explicit mesh in the world and
// the Boolean program evaluated from scratch.
//
// The judges share with lamina the vertices of the leaves (rounded to doubles
// as lamina rounds them, from then on taken for exact numbers) and the
// program's text, nothing else.

#include <cstdint>
#include <span>
#include <vector>

#include "csg/scene.h"

namespace lamina::oracle {

struct WorldScene {
  std::vector<csg::Mesh> meshes;      // one per instance, in the world
  std::vector<std::uint32_t> parent;  // of each instance, into `program`
  std::vector<bool> is_minuend;       // of each instance
  std::vector<plane::BooleanNode> program;
};

WorldScene world_scene(const csg::Scene& scene);

// Whether the Boolean holds at a point that lies inside exactly the instances
// with a nonzero `winding`.
bool evaluate_program(const WorldScene& scene, std::span<const int> winding);

// `count` heights spread over (low, high), each as far as can be had from all
// vertices: a section there depends on no rule for faces in the plane.
std::vector<double> generic_heights(const WorldScene& scene, double low,
                                    double high, std::size_t count);

}  // namespace lamina::oracle
