#include "csg/cad/cad_reader.h"

#include <algorithm>
#include <cerrno>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <new>
#include <utility>

#include <fmt/format.h>

#include "base/child_process.h"
#include "base/file/format_error.h"
#include "csg/cad/detail/engine.h"
#include "csg/limits.h"

namespace lamina::cad {
namespace {

std::string_view name_of(Format format) {
  switch (format) {
    case Format::kStep:
      return "STEP";
    case Format::kIges:
      return "IGES";
    case Format::kBrep:
      return "BREP";
  }
  return "";
}

// --- The child ---------------------------------------------------------------

// Writes numbers and rows of them as they stand in memory.
class Writer {
 public:
  explicit Writer(const ChildOutput& output) : output_(output) {}

  void write(std::uint64_t number) const {
    output_.write(&number, sizeof number);
  }
  // Strings and vectors.
  template <typename Row>
  void write_row(const Row& row) const {
    write(row.size());
    output_.write(row.data(), row.size() * sizeof(row[0]));
  }

 private:
  const ChildOutput& output_;
};

void write_part(const Part& part, const Writer& writer) {
  for (const auto* messages : {&part.warnings, &part.notes}) {
    writer.write(messages->size());
    for (const std::string& words : *messages) writer.write_row(words);
  }
  writer.write(part.bodies.size());
  for (const Body& body : part.bodies) {
    writer.write_row(body.name);
    writer.write_row(body.mesh.vertices);
    writer.write_row(body.mesh.triangles);
  }
}

void work(Engine& engine, std::string_view bytes, Format format,
          const Fineness& fineness, std::optional<std::string_view> asked,
          const ChildOutput& output) {
  // OpenCASCADE follows the environment to files of its own, and prints and
  // reads numbers in the process's locale.
  ::clearenv();
  std::setlocale(LC_ALL, "C");
  const Result result = engine.read(bytes, format, fineness, asked);
  const Writer writer(output);
  writer.write(static_cast<std::uint64_t>(result.outcome));
  writer.write_row(result.reason);
  writer.write(static_cast<std::uint64_t>(result.triangles));
  write_part(result.part, writer);
}

// --- What comes from it ------------------------------------------------------

// The child ended too early, or says what makes no sense.
struct ChildFailed {};

// Trusts nothing: what a file made OpenCASCADE do may have ruined the child.
class Source {
 public:
  explicit Source(const ChildProcess& child) : child_(child) {}

  std::uint64_t read() const {
    std::uint64_t number = 0;
    if (!child_.read(&number, sizeof number)) throw ChildFailed();
    return number;
  }
  // most  items that can be
  template <typename Row>
  Row read_row(double most) const {
    const std::uint64_t size = read();
    if (static_cast<double>(size) > most) throw ChildFailed();
    Row row(size, typename Row::value_type{});
    if (!child_.read(row.data(), size * sizeof(row[0]))) throw ChildFailed();
    return row;
  }
  std::string read_text() const { return read_row<std::string>(kMostLetters); }

 private:
  static constexpr double kMostLetters = 1 << 16;

  const ChildProcess& child_;
};

bool is_sound(const csg::Mesh& mesh) {
  const auto is_finite = [](Vec3 p) {
    return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
  };
  const auto is_inside = [&](const std::array<std::uint32_t, 3>& triangle) {
    return std::all_of(triangle.begin(), triangle.end(), [&](std::uint32_t i) {
      return i < mesh.vertices.size();
    });
  };
  return std::all_of(mesh.vertices.begin(), mesh.vertices.end(), is_finite) &&
         std::all_of(mesh.triangles.begin(), mesh.triangles.end(), is_inside);
}

Body read_body(const Source& source) {
  Body body;
  body.name = source.read_text();
  body.mesh.vertices =
      source.read_row<std::vector<Vec3>>(3 * csg::kMostTriangles);
  body.mesh.triangles =
      source.read_row<std::vector<std::array<std::uint32_t, 3>>>(
          csg::kMostTriangles);
  if (!is_sound(body.mesh)) throw ChildFailed();
  return body;
}

Result read_result(const Source& source) {
  Result result;
  result.outcome = static_cast<Outcome>(source.read());
  result.reason = source.read_text();
  result.triangles = static_cast<double>(source.read());
  for (auto* messages : {&result.part.warnings, &result.part.notes}) {
    for (std::uint64_t count = source.read(); count > 0; --count) {
      messages->push_back(source.read_text());
    }
  }
  for (std::uint64_t count = source.read(); count > 0; --count) {
    result.part.bodies.push_back(read_body(source));
  }
  return result;
}

[[noreturn]] void fail(ChildFault fault, Format format, unsigned most_seconds) {
  switch (fault) {
    case ChildFault::kOutOfTime:
      throw FormatError(
          fmt::format("OpenCASCADE takes more than {} s for this {}",
                      most_seconds, name_of(format)));
    case ChildFault::kKilled:
      throw FormatError(fmt::format(
          "OpenCASCADE was killed when it read this {}", name_of(format)));
    case ChildFault::kOutOfMemory:
      throw std::bad_alloc();
    case ChildFault::kNone:
    case ChildFault::kCrashed:
      break;
  }
  throw FormatError(
      fmt::format("OpenCASCADE fails on this {}", name_of(format)));
}

Result read_apart(Engine& engine, std::string_view bytes, Format format,
                  const Fineness& fineness,
                  std::optional<std::string_view> asked,
                  unsigned most_seconds) {
  ChildProcess child(
      [&](const ChildOutput& output) {
        work(engine, bytes, format, fineness, asked, output);
      },
      most_seconds);
  try {
    return read_result(Source(child));
  } catch (const ChildFailed&) {
    fail(child.wait(), format, child.most_seconds());
  }
}

}  // namespace

Format format_of(csg::ImportFormat format) {
  return format == csg::ImportFormat::kStep   ? Format::kStep
         : format == csg::ImportFormat::kIges ? Format::kIges
                                              : Format::kBrep;
}

Reader::Reader(std::vector<std::string> folders, Diagnostics& diagnostics,
               unsigned most_seconds)
    : folders_(std::move(folders)),
      diagnostics_(diagnostics),
      most_seconds_(most_seconds) {}

Reader::~Reader() = default;

Part Reader::read(std::string_view bytes, Format format,
                  const Fineness& fineness,
                  std::optional<std::string_view> asked) {
  if (engine_ == nullptr) {
    auto* const make_engine = reinterpret_cast<MakeEngine*>(
        open_module(kModule, folders_, diagnostics_));
    engine_ = make_engine(kEngineVersion);
    if (engine_ == nullptr) fail_without_engine(kModule, 0, diagnostics_);
  }
  Result result =
      read_apart(*engine_, bytes, format, fineness, asked, most_seconds_);
  switch (result.outcome) {
    case Outcome::kRead:
      break;
    case Outcome::kBroken:
      throw FormatError(result.reason);
    case Outcome::kNoMemory:
      throw std::bad_alloc();
    case Outcome::kTooManyTriangles:
      csg::require_triangles(result.triangles);
      break;
  }
  return std::move(result.part);
}

}  // namespace lamina::cad
