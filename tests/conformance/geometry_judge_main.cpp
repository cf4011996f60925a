// geometry_judge --language <word> <design> <mesh> <words> <height>...: judges
// lamina's layers of a design in that language by a mesh (binary STL) that
// openscad made, its messages in the file <words>, at these heights or up to
// 0.01 mm from them, where no vertex is near. Prints the verdict (equal,
// no-judge, differs) and, below it, why.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/conformance/geometry_judge.h"
#include "tests/oracle/openscad.h"
#include "tests/oracle/world_scene.h"
#include "tests/support/temporary_folder.h"

namespace lamina::conformance {
namespace {

// How far a section may be moved, to stay clear of faces in its plane [mm].
constexpr double kGreatestMove = 0.01;

int run(std::span<char*> arguments) {
  const Reference reference = {ReferenceKind::kSolid,
                               oracle::read_binary_stl(arguments[3]),
                               support::read_file(arguments[4])};
  std::vector<double> heights;
  for (const char* const text : arguments.subspan(5)) {
    const double z = std::strtod(text, nullptr);
    const auto clear =
        oracle::generic_heights({{reference.mesh}, {}, {}, {}},
                                z - kGreatestMove, z + kGreatestMove, 1);
    heights.insert(heights.end(), clear.begin(), clear.end());
  }
  const Judgement judgement =
      judge_solid(reference, {arguments[2], arguments[1]}, heights);
  fmt::print("{}\n{}\n", judgement.verdict, judgement.complaint);
  return 0;
}

}  // namespace
}  // namespace lamina::conformance

int main(int argc, char** argv) {
  const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
  if (arguments.size() < 7) {
    fmt::print(stderr,
               "usage: geometry_judge --language <word> <design> <mesh> "
               "<words> <height>...\n");
    return 2;
  }
  try {
    return lamina::conformance::run(arguments.subspan(1));
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
