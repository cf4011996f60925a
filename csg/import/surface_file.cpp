#include "csg/import/surface_file.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/file/png_image.h"
#include "csg/import/detail/text_lines.h"
#include "csg/limits.h"

namespace lamina::csg {
namespace {

constexpr std::string_view kPngMark = "\x89PNG\r\n\x1a\n";

class MeshBuilder {
 public:
  MeshBuilder(const HeightField& field, bool center) : field_(field) {
    if (!center) return;
    const Vec2 size(static_cast<double>(field.columns) - 1,
                    static_cast<double>(field.rows) - 1);
    shift_ = -size / 2.0;
  }

  Mesh build() {
    const std::size_t columns = field_.columns;
    const std::size_t rows = field_.rows;
    mesh_.vertices.reserve(2 * columns * rows + 2 * (columns + rows));
    mesh_.triangles.reserve(4 * columns * rows + 6 * (columns + rows));
    for (std::size_t row = 0; row < rows; ++row) {
      for (std::size_t column = 0; column < columns; ++column) {
        add_vertex(column, row, 0, height(column, row));
      }
    }
    for (std::size_t row = 0; row + 1 < rows; ++row) {
      for (std::size_t column = 0; column + 1 < columns; ++column) {
        add_cell(column, row);
      }
    }
    close();
    return std::move(mesh_);
  }

 private:
  double height(std::size_t column, std::size_t row) const {
    return field_.heights[row * field_.columns + column];
  }
  std::uint32_t index(std::size_t column, std::size_t row) const {
    return static_cast<std::uint32_t>(row * field_.columns + column);
  }

  std::uint32_t add_vertex(std::size_t column, std::size_t row, double aside,
                           double z) {
    mesh_.vertices.emplace_back(shift_.x + static_cast<double>(column) + aside,
                                shift_.y + static_cast<double>(row) + aside, z);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }

  void add_cell(std::size_t column, std::size_t row) {
    const double mean =
        (height(column, row) + height(column + 1, row) +
         height(column, row + 1) + height(column + 1, row + 1)) /
        4;
    const std::uint32_t top = add_vertex(column, row, 0.5, mean);
    const std::uint32_t corners[] = {index(column, row), index(column + 1, row),
                                     index(column + 1, row + 1),
                                     index(column, row + 1)};
    for (std::size_t i = 0; i < 4; ++i) {
      mesh_.triangles.push_back({corners[i], corners[(i + 1) % 4], top});
    }
  }

  // The walls below the border, and the bottom.
  void close() {
    std::vector<std::array<std::size_t, 2>> border;  // counter-clockwise
    const std::size_t right = field_.columns - 1;
    const std::size_t back = field_.rows - 1;
    for (std::size_t i = 0; i < right; ++i) border.push_back({i, 0});
    for (std::size_t i = 0; i < back; ++i) border.push_back({right, i});
    for (std::size_t i = right; i > 0; --i) border.push_back({i, back});
    for (std::size_t i = back; i > 0; --i) border.push_back({0, i});
    const auto below = static_cast<std::uint32_t>(mesh_.vertices.size());
    const auto count = static_cast<std::uint32_t>(border.size());
    assert(count > 0);
    for (const auto [column, row] : border) {
      add_vertex(column, row, 0, field_.bottom);
    }
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint32_t j = (i + 1) % count;
      const std::uint32_t a = index(border[i][0], border[i][1]);
      const std::uint32_t b = index(border[j][0], border[j][1]);
      mesh_.triangles.push_back({below + i, below + j, b});
      mesh_.triangles.push_back({below + i, b, a});
    }
    // The bottom: one half on each side of its diagonal.
    const auto x = static_cast<std::uint32_t>(right);
    const auto y = static_cast<std::uint32_t>(back);
    const auto at = [=](std::uint32_t i) { return below + i % count; };
    add_half(x, x, y, at);
    add_half(2 * x + y, x, y, at);
  }

  // Fills the half between the border's points before a corner and those behind
  // it, up to the two ends of the diagonal. No triangle is degenerate.
  template <typename At>
  void add_half(std::uint32_t corner, std::uint32_t before,
                std::uint32_t behind, At at) {
    const auto add = [this](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
      mesh_.triangles.push_back({a, c, b});  // seen from below
    };
    std::uint32_t i = 1;
    std::uint32_t j = 1;
    add(at(corner - 1), at(corner), at(corner + 1));
    while (i < before || j < behind) {
      // In step, as far as both last.
      if (j == behind || (i < before && std::uint64_t{i} * behind <=
                                            std::uint64_t{j} * before)) {
        add(at(corner - i - 1), at(corner - i), at(corner + j));
        ++i;
      } else {
        add(at(corner - i), at(corner + j), at(corner + j + 1));
        ++j;
      }
    }
  }

  const HeightField& field_;
  Vec2 shift_ = Vec2(0);
  Mesh mesh_;
};

// Appends the numbers of a line, or sets the field's fault.
void take_row(std::string_view line, HeightField& field,
              std::vector<double>& numbers) {
  while (true) {
    const std::string_view word = take_word(line);
    if (word.empty()) return;
    const auto number = to_number<double>(word);
    if (!number || !std::isfinite(*number)) {
      field.fault =
          "bad lexical cast: source type value could not be interpreted as "
          "target";
      return;
    }
    numbers.push_back(*number);
    field.bottom = std::min(field.bottom, *number - 1);
  }
}

}  // namespace

HeightField parse_dat(std::string_view bytes, Language rules) {
  HeightField field;
  std::vector<double> numbers;    // of all rows
  std::vector<std::size_t> ends;  // of each row, in numbers
  TextLines lines(bytes);
  while (const auto line = lines.next()) {
    if (line->empty() || line->front() == '#') continue;
    const std::size_t begin = numbers.size();
    take_row(*line, field, numbers);
    const std::size_t columns = numbers.size() - begin;
    if (columns > 0) ends.push_back(numbers.size());
    field.columns = std::max(field.columns, columns);
    require_heights(field.columns, ends.size());
    if (!field.fault.empty()) break;
  }
  if (!field.fault.empty() && rules != Language::k2021) {
    return {0, 0, {}, 0, field.fault};
  }
  field.rows = ends.size();
  field.heights.reserve(field.columns * field.rows);
  auto begin = numbers.cbegin();
  for (std::size_t row = 0; row < field.rows; ++row) {
    const auto end = numbers.cbegin() + static_cast<std::ptrdiff_t>(ends[row]);
    field.heights.insert(field.heights.end(), begin, end);
    field.heights.resize((row + 1) * field.columns);
    begin = end;
  }
  return field;
}

HeightField parse_png(std::string_view bytes, bool invert, Language rules) {
  const PngImage image =
      read_png_image(bytes, PngChannels::kRgba, require_heights);
  HeightField field;
  field.columns = image.columns;
  field.rows = image.rows;
  field.heights.resize(image.columns * image.rows);
  constexpr double kAboveAll = 200;  // mm
  if (rules != Language::k2021) field.bottom = kAboveAll;
  for (std::size_t row = 0; row < image.rows; ++row) {
    const std::uint8_t* pixel = &image.pixels[4 * row * image.columns];
    double* height = &field.heights[(image.rows - 1 - row) * image.columns];
    for (std::size_t i = 0; i < image.columns; ++i, pixel += 4, ++height) {
      const double luminance =
          0.2126 * pixel[0] + 0.7152 * pixel[1] + 0.0722 * pixel[2];
      *height = 100.0 / 255 * (invert ? 1 - luminance : luminance);
      field.bottom = std::min(field.bottom, *height - 1);
    }
  }
  return field;
}

Mesh make_surface(const HeightField& field, bool center) {
  if (field.rows < 2 || field.columns < 2) return {};
  return MeshBuilder(field, center).build();
}

Mesh read_surface_file(const SurfaceParams& params, const FileAccess& access,
                       SourceRange range, Diagnostics& diagnostics) {
  const std::string path(params.path);
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    diagnostics.warning(range,
                        fmt::format("The file '{}' couldn't be opened.", path));
    return {};
  }
  if (!bytes->starts_with(kPngMark)) {
    const HeightField field = parse_dat(*bytes, params.rules);
    if (!field.fault.empty()) {
      diagnostics.warning(
          range, fmt::format("Illegal value in '{}': {}", path, field.fault));
    }
    return make_surface(field, params.center);
  }
  try {
    return make_surface(parse_png(*bytes, params.invert, params.rules),
                        params.center);
  } catch (const FormatError& fault) {
    diagnostics.report({Severity::kWarning,
                        range,
                        fmt::format("Can't read PNG image '{}'", path),
                        {},
                        {{range, fault.what()}}});
    return {};
  }
}

}  // namespace lamina::csg
