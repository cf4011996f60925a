#include "csg/lower/mesh_file_facts.h"

#include <utility>

#include "csg/import/mesh_file.h"
#include "csg/lower/detail/face.h"
#include "csg/lower/detail/repair.h"

namespace lamina::csg {

std::vector<MeshFacts> measure_mesh_file(const std::string& path,
                                         const FileAccess& access) {
  ImportParams params;
  params.path = path;
  params.is_design = true;
  params.format = import_format_of_file(path);
  Diagnostics unread;  // lowering has reported what there is to report
  std::vector<MeshFacts> facts;
  if (is_mesh(params.format)) {
    for (RawMesh& raw : read_mesh_file(params, access, {}, unread)) {
      Mesh mesh = std::move(raw.mesh);
      for (const auto& polygon : raw.polygons) add_face(mesh, polygon);
      if (!raw.is_joined) merge_equal_vertices(mesh);
      facts.push_back(measure(std::move(mesh)));
    }
  }
  return facts;
}

}  // namespace lamina::csg
