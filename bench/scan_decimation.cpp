// Decimates a mesh at some tolerances and prints what becomes of it, a line
// each: tolerance, triangles before and after, and how far a point of the old
// surface is from the new one, and of the new from the old, at most, by CGAL.
//
//   build/release/bench/scan_decimation scan.ply 0.01 0.02 0.05

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <vector>

#include "csg/import/decimate.h"
#include "csg/import/mesh_file.h"
#include "csg/mesh/vertex_table.h"
#include "tests/oracle/surface_distance.h"

namespace {

using namespace lamina;

csg::Mesh read(const std::string& path) {
  csg::ImportParams params;
  params.path = path;
  params.format = csg::import_format_of_file(path);
  Diagnostics diagnostics;
  csg::Mesh all;
  csg::VertexTable table;
  for (const csg::RawMesh& raw :
       csg::read_mesh_file(params, kAllFiles, {}, diagnostics)) {
    for (auto triangle : raw.mesh.triangles) {
      for (std::uint32_t& corner : triangle) {
        corner = table.name(raw.mesh.vertices[corner]);
      }
      if (triangle[0] != triangle[1] && triangle[1] != triangle[2] &&
          triangle[2] != triangle[0]) {
        all.triangles.push_back(triangle);
      }
    }
  }
  all.vertices = table.take_points();
  csg::keep_named_points(all.vertices, all.triangles);
  return all;
}

}  // namespace

int main(int count, char** words) {
  try {
    if (count < 3) throw std::runtime_error("usage: scan_decimation MESH MM…");
    const csg::Mesh scan = read(words[1]);
    for (int i = 2; i < count; ++i) {
      const double tolerance = std::atof(words[i]);
      csg::Mesh mesh = scan;
      Diagnostics diagnostics;
      csg::decimate(mesh, tolerance, {LAMINA_MODULES}, diagnostics);
      const double error = tolerance / 10;
      std::printf("%g %zu %zu %.5f %.5f\n", tolerance, scan.triangles.size(),
                  mesh.triangles.size(),
                  oracle::surface_distance(scan, mesh, error),
                  oracle::surface_distance(mesh, scan, error));
      std::fflush(stdout);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "scan_decimation: %s\n", error.what());
    return 1;
  }
  return 0;
}
