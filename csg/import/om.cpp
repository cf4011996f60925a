// OM, the binary format of OpenMesh.
//
// Chunks follow a header of counts. Three of them are the mesh: positions of
// vertices, the half-edges with next half-edge, vertex and face, and a
// half-edge of each face. Around each face leads a ring of half-edges; every
// one of them names the face, so rings that a broken file has tangled are seen.
//
// OpenMesh's own reader is not used: docs/decisions/0035 says why.

#include <array>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

enum class Entity : std::uint8_t {
  kVertex = 0,
  kMesh = 1,
  kFace = 2,
  kEdge = 4,
  kHalfEdge = 6,
  kEnd = 7
};

constexpr unsigned kPositions = 0;
constexpr unsigned kTopology = 7;

// Sixteen bits, the lowest first: reserved, has a name, entity (3), type (4),
// is signed, is of floats, dimensions less one (3), size as a power of 2 (2).
struct Chunk {
  explicit Chunk(unsigned bits)
      : has_name((bits >> 1 & 1) != 0),
        entity(static_cast<Entity>(bits >> 2 & 7)),
        type(bits >> 5 & 15),
        has_floats((bits >> 10 & 1) != 0),
        dimensions((bits >> 11 & 7) + 1),
        log_size(bits >> 14 & 3) {}

  bool has_name;
  Entity entity;
  unsigned type;
  bool has_floats;
  std::size_t dimensions;
  unsigned log_size;
};

struct HalfEdge {
  std::uint32_t next = 0;
  std::uint32_t to = 0;    // vertex
  std::uint32_t face = 0;  // kNone: open
};

constexpr std::uint32_t kNone = ~std::uint32_t{0};

class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  RawMesh read() {
    read_header();
    while (!has_positions_ || !has_half_edges_ || !has_faces_) read_chunk();
    for (std::uint32_t face = 0; face < faces_.size(); ++face) add_face(face);
    return std::move(raw_);
  }

 private:
  [[noreturn]] static void fail(std::string_view expected) {
    throw FormatError(fmt::format("OM file, expected {}", expected));
  }

  // A whole number of `size` bytes, little-endian as all machines that this is
  // built for; kNone where all its bits are set.
  std::uint32_t take(std::size_t size, std::string_view expected) {
    if (rest_.size() < size) fail(expected);
    std::uint64_t number = 0;
    std::memcpy(&number, rest_.data(), size);
    rest_.remove_prefix(size);
    const std::uint64_t all = ~std::uint64_t{0} >> (64 - 8 * size);
    return number >= std::min<std::uint64_t>(all, kNone)
               ? kNone
               : static_cast<std::uint32_t>(number);
  }

  void read_header() {
    constexpr std::size_t kMagic = 3;  // the third tells triangles from others
    if (!rest_.starts_with("OM") || rest_.size() < kMagic) fail("'OM'");
    rest_.remove_prefix(kMagic);
    const unsigned version = take(1, "the version");
    if (version >> 5 != 2) {
      throw FormatError(fmt::format("OM file of version {}.{} instead of 2.x,",
                                    version >> 5, version & 31));
    }
    vertex_count_ = take(4, "the number of vertices");
    face_count_ = take(4, "the number of faces");
    half_edge_count_ = 2 * std::size_t{take(4, "the number of edges")};
  }

  void read_chunk() {
    const Chunk chunk(take(2, "positions of vertices, half-edges and faces"));
    if (chunk.has_name || chunk.entity == Entity::kEnd) {
      fail("positions of vertices, half-edges and faces before what has names");
    }
    if (chunk.type == kTopology) {
      read_topology(chunk);
    } else if (chunk.type == kPositions && chunk.entity == Entity::kVertex) {
      read_positions(chunk);
    } else {
      const std::size_t size = (chunk.has_floats ? 4U : 1U) << chunk.log_size;
      skip(count_of(chunk.entity) * chunk.dimensions * size);
    }
  }

  std::size_t count_of(Entity entity) const {
    switch (entity) {
      case Entity::kVertex:
        return vertex_count_;
      case Entity::kFace:
        return face_count_;
      case Entity::kEdge:
        return half_edge_count_ / 2;
      case Entity::kHalfEdge:
        return half_edge_count_;
      case Entity::kMesh:
      case Entity::kEnd:
        break;
    }
    return 1;
  }

  void skip(std::size_t size) {
    require(size);
    rest_.remove_prefix(size);
  }

  // So that counts ask for no memory that the file does not fill.
  void require(std::size_t size) const {
    if (rest_.size() < size) {
      fail(fmt::format("{} bytes more than the {} that there are",
                       size - rest_.size(), rest_.size()));
    }
  }

  void read_positions(const Chunk& chunk) {
    if (chunk.dimensions != 3 || !chunk.has_floats || chunk.log_size > 1) {
      fail("three floats or doubles for a vertex");
    }
    require(std::size_t{vertex_count_} * (12U << chunk.log_size));
    raw_.mesh.vertices.reserve(vertex_count_);
    for (std::uint32_t i = 0; i < vertex_count_; ++i) {
      raw_.mesh.vertices.push_back(chunk.log_size == 0 ? take_point<float>()
                                                       : take_point<double>());
    }
    has_positions_ = true;
  }

  template <typename Number>
  Vec3 take_point() {
    std::array<Number, 3> numbers{};
    std::memcpy(numbers.data(), rest_.data(), sizeof numbers);
    rest_.remove_prefix(sizeof numbers);
    return {numbers[0], numbers[1], numbers[2]};
  }

  void read_topology(const Chunk& chunk) {
    const std::size_t size = std::size_t{1} << chunk.log_size;
    const std::size_t count = count_of(chunk.entity);
    if (chunk.entity == Entity::kHalfEdge) {
      require(3 * count * size);
      half_edges_.clear();
      half_edges_.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t next = take(size, "");
        const std::uint32_t to = take(size, "");
        half_edges_.push_back({next, to, take(size, "")});
      }
      has_half_edges_ = true;
    } else if (chunk.entity == Entity::kFace) {
      require(count * size);
      faces_.clear();
      faces_.reserve(count);
      for (std::size_t i = 0; i < count; ++i) faces_.push_back(take(size, ""));
      has_faces_ = true;
    } else {
      skip(count * size);
    }
  }

  // Follows the ring of half-edges around a face. Every half-edge names one
  // face, so a walk that neither returns nor leaves the face repeats itself and
  // is longer than all half-edges that are left.
  void add_face(std::uint32_t face) {
    corners_.clear();
    std::uint32_t at = faces_[face];
    do {
      if (at >= half_edges_.size() || half_edges_[at].face != face ||
          half_edges_[at].to >= raw_.mesh.vertices.size() ||
          ++walked_ > half_edges_.size()) {
        fail(fmt::format("a ring of half-edges around face {}", face));
      }
      corners_.push_back(half_edges_[at].to);
      at = half_edges_[at].next;
    } while (at != faces_[face]);
    raw_.add_face(corners_);
  }

  std::string_view rest_;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  std::size_t half_edge_count_ = 0;
  bool has_positions_ = false;
  bool has_half_edges_ = false;
  bool has_faces_ = false;
  std::vector<HalfEdge> half_edges_;
  std::vector<std::uint32_t> faces_;  // a half-edge of each
  std::vector<std::uint32_t> corners_;
  std::size_t walked_ = 0;  // half-edges
  RawMesh raw_;
};

}  // namespace

RawMesh parse_om(std::string_view bytes) { return Reader(bytes).read(); }

}  // namespace lamina::csg
