#include "slicer/formats/slc_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "base/file/length_units.h"
#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

constexpr std::size_t kLongestHeader = 2048;

// Vertices are read this many at a time, so that a wrong count meets the end of
// the file before it has cost memory.
constexpr std::uint32_t kPointsAtOnce = 4096;

// Returns the words after `key` up to the next " -" that begins a keyword.
std::string value_of(std::string_view header, std::string_view key) {
  const std::size_t at = header.find(key);
  if (at == std::string_view::npos) return {};
  std::string_view rest = header.substr(at + key.size());
  for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
    if (rest[i] == '-' && (i == 0 || rest[i - 1] == ' ') &&
        rest[i + 1] >= 'A' && rest[i + 1] <= 'Z') {
      rest = rest.substr(0, i);
      break;
    }
  }
  constexpr std::string_view kBlanks = " \r\n\t";
  skip(rest, kBlanks);
  return std::string(rest.substr(0, rest.find_last_not_of(kBlanks) + 1));
}

// "minx,maxx miny,maxy minz,maxz"
std::optional<std::array<Vec2, 3>> parse_extents(std::string_view text) {
  std::array<Vec2, 3> extents{};
  for (Vec2& axis : extents) {
    for (double* value : {&axis.x, &axis.y}) {
      skip(text, " ,");
      if (!take_number(text, *value)) return std::nullopt;
    }
  }
  return extents;
}

// Takes the bound that lamina notes off the name of the package: "lamina 0.1.0
// within 0.00100117000 mm".
std::optional<double> split_deviation(std::string& package) {
  constexpr std::string_view kBefore = " within ";
  constexpr std::string_view kAfter = " mm";
  const std::size_t at = package.find(kBefore);
  if (at == std::string::npos || !package.ends_with(kAfter)) return {};
  // In "within mm" one blank would be both.
  if (at + kBefore.size() + kAfter.size() > package.size()) return {};
  const char* const begin = package.data() + at + kBefore.size();
  const char* const end = package.data() + package.size() - kAfter.size();
  double deviation = 0;
  const auto [rest, fault] = std::from_chars(begin, end, deviation);
  if (fault != std::errc() || rest != end || !std::isfinite(deviation)) {
    return {};
  }
  package.resize(at);
  return deviation;
}

}  // namespace

SlcReader::SlcReader(std::string path, const FileAccess& access)
    : path_(std::move(path)) {
  access.require(path_);
  OpenFile file = access.open(path_);
  if (!file) fail_to_open(path_);
  file_.reset(::fdopen(file.descriptor(), "rb"));
  if (!file_) fail_to_open(path_);
  file.release();
  read_header();
  read_sampling();
}

void SlcReader::fail(std::string_view message) const {
  fail_to_read(path_, message);
}

void SlcReader::read(char* bytes, std::size_t count, std::string_view what) {
  const std::size_t got = std::fread(bytes, 1, count, file_.get());
  if (got != count) {
    fail(fmt::format("the file ends at byte {}, in {}", offset_ + got, what));
  }
  offset_ += count;
}

template <typename Value>
Value SlcReader::read_value(std::string_view what) {
  Value value;
  read(reinterpret_cast<char*>(&value), sizeof(value), what);
  return value;
}

void SlcReader::require_finite(float value) const {
  if (std::isfinite(value)) return;
  fail(fmt::format("a number before byte {} is not finite", offset_));
}

// The header without its end.
std::string SlcReader::read_header_text() {
  std::array<char, 8> begin{};
  const std::size_t got =
      std::fread(begin.data(), 1, begin.size(), file_.get());
  offset_ = got;
  std::string text(begin.data(), got);
  if (text.starts_with("Slice V")) {
    fail(
        "this is a Stratasys slice file (\"Slice V0\"), another format with "
        "the suffix .slc");
  }
  if (!text.starts_with("-SLCVER")) {
    // VTK's volumes begin with "<columns> <rows> <slices> …".
    const bool is_vtk = got > 0 && begin[0] >= '0' && begin[0] <= '9';
    fail(is_vtk ? "this is a VTK volume, another format with the suffix .slc"
                : "not an SLC file: it does not begin with \"-SLCVER\"");
  }
  while (true) {
    const char c = read_value<char>("the header");
    if (c == '\x1A') break;
    text.push_back(c);
    if (text.size() >= kLongestHeader) {
      fail("the header has no end (0x1A) within 2048 bytes");
    }
  }
  std::array<char, kSlcReservedSize> reserved;
  read(reserved.data(), reserved.size(), "the 256 reserved bytes");
  return text;
}

void SlcReader::read_header() {
  const std::string text = read_header_text();
  const std::string unit = value_of(text, "-UNIT");
  if (unit == "INCH") {
    mm_per_unit_ = kMillimetresPerInch;
  } else if (unit != "MM") {
    fail(fmt::format("unknown unit '{}' (MM or INCH was expected)", unit));
  }
  facts_.format = "SLC " + value_of(text, "-SLCVER");
  facts_.header = fmt::format("{}, unit {}", value_of(text, "-TYPE"), unit);
  facts_.writer = value_of(text, "-PACKAGE");
  facts_.deviation = split_deviation(facts_.writer);
  facts_.extents = parse_extents(value_of(text, "-EXTENTS"));
}

void SlcReader::read_sampling() {
  const auto rows = read_value<std::uint8_t>("the sampling table");
  if (rows == 0) fail("the sampling table has no row");
  for (unsigned i = 0; i < rows; ++i) {
    const auto row = read_value<std::array<float, 4>>("the sampling table");
    for (const float value : row) require_finite(value);
    facts_.sampling.push_back({row[0], row[1], row[2]});
  }
}

bool SlcReader::read_layer(SlcLayer& layer) {
  const auto z = read_value<float>("the height of a layer");
  const auto boundaries = read_value<std::uint32_t>("the head of a layer");
  require_finite(z);
  layer.z = static_cast<double>(z) * mm_per_unit_;
  if (boundaries == kSlcEndOfLayers) {
    facts_.top = layer.z;
    layer.boundaries.clear();
    require_end();
    return false;
  }
  // The row in force is the last one that begins at or below z.
  const SamplingRow* row = &facts_.sampling.front();
  for (const SamplingRow& candidate : facts_.sampling) {
    if (candidate.min_z <= z) row = &candidate;
  }
  layer.thickness = static_cast<double>(row->thickness) * mm_per_unit_;

  std::size_t count = 0;
  for (std::uint32_t i = 0; i < boundaries; ++i) {
    const auto vertices = read_value<std::uint32_t>("the head of a boundary");
    const auto gaps = read_value<std::uint32_t>("the head of a boundary");
    // Reuse the memory of the boundaries of the layer before.
    if (layer.boundaries.size() == count) layer.boundaries.emplace_back();
    WrittenLoop& boundary = layer.boundaries[count++];
    boundary.gaps = gaps;
    read_points(vertices, boundary.points);
  }
  layer.boundaries.resize(count);
  return true;
}

void SlcReader::require_end() {
  for (int c = std::getc(file_.get()); c != EOF; c = std::getc(file_.get())) {
    if (kPadding.find(static_cast<char>(c)) == std::string_view::npos) {
      fail(fmt::format("something stands behind the end record, at byte {}",
                       offset_));
    }
    ++offset_;
  }
}

void SlcReader::read_points(std::uint32_t count, std::vector<Vec2>& points) {
  points.clear();
  std::array<std::array<float, 2>, kPointsAtOnce> piece;
  while (count > 0) {
    const std::uint32_t now = std::min(count, kPointsAtOnce);
    read(reinterpret_cast<char*>(piece.data()), now * sizeof(piece[0]),
         "the vertices of a boundary");
    for (std::uint32_t i = 0; i < now; ++i) {
      const auto& [x, y] = piece[i];
      require_finite(x);
      require_finite(y);
      points.emplace_back(x * mm_per_unit_, y * mm_per_unit_);
    }
    count -= now;
  }
}

Layer to_layer(const SlcLayer& layer) {
  Layer result;
  result.bottom = layer.z;
  result.top = layer.z + layer.thickness;
  result.section_z = layer.z + layer.thickness / 2;
  for (const WrittenLoop& boundary : layer.boundaries) {
    std::size_t count = boundary.points.size();
    if (count > 1 && boundary.points.front() == boundary.points.back()) {
      --count;
    }
    result.contours.points.insert(
        result.contours.points.end(), boundary.points.begin(),
        boundary.points.begin() + static_cast<std::ptrdiff_t>(count));
    result.contours.ends.push_back(
        static_cast<std::uint32_t>(result.contours.points.size()));
  }
  return result;
}

}  // namespace lamina::slicer
