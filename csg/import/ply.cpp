// PLY, the Stanford triangle format: what scanners write.
//
// A header of text names elements and the properties of each, in any number and
// order; the body has their values as text or as bytes of either order. So one
// reader walks over the properties, and a source gives it one value after the
// other. What is neither a vertex nor a face is walked over as well, since only
// that shows where it ends.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "base/file/format_error.h"
#include "base/text.h"
#include "csg/import/detail/text_lines.h"
#include "csg/import/mesh_file.h"

namespace lamina::csg {
namespace {

enum class Type : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat,
  kDouble
};

bool is_whole(Type type) { return type < Type::kFloat; }

struct Property {
  std::string_view name;
  Type type = Type::kInt8;
  std::optional<Type> count;  // of a list: the type of its length
};

struct Element {
  std::string_view name;
  std::uint32_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding : std::uint8_t { kText, kLittleEndian, kBigEndian };

struct Header {
  Encoding encoding = Encoding::kText;
  std::vector<Element> elements;
  std::string_view body;
};

// --- Header -----------------------------------------------------------------

std::optional<Type> type_named(std::string_view name) {
  struct Name {
    std::string_view name;
    std::string_view sized;
    Type type;
  };
  constexpr std::array<Name, 8> kNames = {
      {{"char", "int8", Type::kInt8},
       {"uchar", "uint8", Type::kUint8},
       {"short", "int16", Type::kInt16},
       {"ushort", "uint16", Type::kUint16},
       {"int", "int32", Type::kInt32},
       {"uint", "uint32", Type::kUint32},
       {"float", "float32", Type::kFloat},
       {"double", "float64", Type::kDouble}}};
  for (const Name& each : kNames) {
    if (name == each.name || name == each.sized) return each.type;
  }
  return std::nullopt;
}

class HeaderReader {
 public:
  explicit HeaderReader(std::string_view bytes)
      : bytes_(bytes), lines_(bytes) {}

  Header read() {
    if (lines_.next() != "ply") fail("ply");
    bool has_format = false;
    for (;;) {
      const auto line = lines_.next();
      if (!line) fail("end_header");
      rest_ = *line;
      const std::string_view keyword = take_word(rest_);
      if (keyword == "format") {
        read_format();
        has_format = true;
      } else if (keyword == "element") {
        read_element();
      } else if (keyword == "property") {
        read_property();
      } else if (keyword == "end_header") {
        if (!has_format) fail("format before end_header");
        header_.body = behind(*line);
        return std::move(header_);
      } else if (keyword != "comment" && keyword != "obj_info") {
        fail("format, element, property, comment or end_header");
      }
    }
  }

 private:
  [[noreturn]] void fail(std::string_view expected) const {
    throw FormatError(
        fmt::format("PLY line {}, expected {}", lines_.number(), expected));
  }

  void read_format() {
    const std::string_view name = take_word(rest_);
    if (name == "ascii") {
      header_.encoding = Encoding::kText;
    } else if (name == "binary_little_endian") {
      header_.encoding = Encoding::kLittleEndian;
    } else if (name == "binary_big_endian") {
      header_.encoding = Encoding::kBigEndian;
    } else {
      fail("ascii, binary_little_endian or binary_big_endian");
    }
    if (take_word(rest_) != "1.0") fail("version 1.0");
  }

  void read_element() {
    Element element;
    element.name = take_word(rest_);
    const auto count = to_number<std::uint32_t>(take_word(rest_));
    if (!count) fail("the number of elements");
    element.count = *count;
    header_.elements.push_back(std::move(element));
  }

  Type read_type() {
    const auto type = type_named(take_word(rest_));
    if (!type)
      fail(
          "a type: char, uchar, short, ushort, int, uint, float or "
          "double");
    return *type;
  }

  void read_property() {
    if (header_.elements.empty()) fail("an element before its properties");
    Property property;
    std::string_view behind_word = rest_;
    if (take_word(behind_word) == "list") {
      rest_ = behind_word;
      property.count = read_type();
      if (!is_whole(*property.count)) fail("whole numbers as lengths of lists");
    }
    property.type = read_type();
    property.name = take_word(rest_);
    if (property.name.empty()) fail("the name of a property");
    header_.elements.back().properties.push_back(property);
  }

  // What follows the line that `line` is a part of.
  std::string_view behind(std::string_view line) const {
    const auto at =
        static_cast<std::size_t>(line.data() + line.size() - bytes_.data());
    const std::size_t end = bytes_.find('\n', at);
    return end == std::string_view::npos ? std::string_view()
                                         : bytes_.substr(end + 1);
  }

  std::string_view bytes_;
  TextLines lines_;
  std::string_view rest_;  // of the line
  Header header_;
};

// --- Sources of values ------------------------------------------------------

// Values apart by blanks, on lines or not.
class TextSource {
 public:
  explicit TextSource(std::string_view text) : rest_(text) {}

  std::optional<double> next(Type /*type*/) {
    return to_number<double>(take_word(rest_));
  }

 private:
  std::string_view rest_;
};

template <typename Number>
double number_in(const std::array<char, 8>& bytes) {
  Number number{};
  std::memcpy(&number, bytes.data(), sizeof number);
  return static_cast<double>(number);
}

class BinarySource {
 public:
  BinarySource(std::string_view bytes, Encoding encoding)
      : rest_(bytes), is_swapped_(encoding == Encoding::kBigEndian) {}

  std::optional<double> next(Type type) {
    constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
    const std::size_t size = kSizes[static_cast<std::size_t>(type)];
    if (rest_.size() < size) return std::nullopt;
    std::array<char, 8> bytes{};
    std::memcpy(bytes.data(), rest_.data(), size);
    rest_.remove_prefix(size);
    if (is_swapped_) std::reverse(bytes.data(), bytes.data() + size);
    switch (type) {
      case Type::kInt8:
        return number_in<std::int8_t>(bytes);
      case Type::kUint8:
        return number_in<std::uint8_t>(bytes);
      case Type::kInt16:
        return number_in<std::int16_t>(bytes);
      case Type::kUint16:
        return number_in<std::uint16_t>(bytes);
      case Type::kInt32:
        return number_in<std::int32_t>(bytes);
      case Type::kUint32:
        return number_in<std::uint32_t>(bytes);
      case Type::kFloat:
        return number_in<float>(bytes);
      case Type::kDouble:
        break;
    }
    return number_in<double>(bytes);
  }

 private:
  std::string_view rest_;
  bool is_swapped_;
};

// --- Body -------------------------------------------------------------------

template <typename Source>
class BodyReader {
 public:
  BodyReader(const Header& header, Source source)
      : header_(header), source_(std::move(source)) {}

  RawMesh read() {
    const Element* const vertices = find("vertex");
    if (vertices == nullptr) fail_header("an element 'vertex'");
    vertex_count_ = vertices->count;
    for (const Element& element : header_.elements) read(element);
    return std::move(raw_);
  }

 private:
  [[noreturn]] static void fail_header(std::string_view expected) {
    throw FormatError(fmt::format("PLY header, expected {}", expected));
  }

  [[noreturn]] void fail(std::string_view expected) const {
    throw FormatError(fmt::format("PLY {} {} of {}, expected {}",
                                  on_one_line(element_->name), number_ + 1,
                                  element_->count, expected));
  }

  // The only element of that name; null: there is none.
  const Element* find(std::string_view name) const {
    const Element* found = nullptr;
    for (const Element& element : header_.elements) {
      if (element.name != name) continue;
      if (found) fail_header(fmt::format("one element '{}'", name));
      found = &element;
    }
    return found;
  }

  void read(const Element& element) {
    element_ = &element;
    if (element.name == "vertex") {
      read_vertices(element);
    } else if (element.name == "face") {
      read_faces(element, [&] { raw_.add_face(corners_); });
    } else if (element.name == "tristrips") {
      read_faces(element, [&] { add_strips(); });
    } else if (!element.properties.empty()) {
      // Else a few bytes of header would ask for four billion steps.
      for_each_record([&] {
        for (const Property& property : element.properties) skip(property);
      });
    }
  }

  template <typename Read>
  void for_each_record(Read read_record) {
    for (number_ = 0; number_ < element_->count; ++number_) read_record();
  }

  double value(const Property& property) {
    const std::optional<double> value = source_.next(property.type);
    if (!value) fail(fmt::format("'{}'", on_one_line(property.name)));
    return *value;
  }

  std::uint32_t list_length(const Property& property) {
    constexpr double kMost = std::numeric_limits<std::uint32_t>::max();
    const std::optional<double> length = source_.next(*property.count);
    if (!length || !(*length >= 0 && *length <= kMost) ||
        *length != std::floor(*length)) {
      fail(fmt::format("the length of '{}'", on_one_line(property.name)));
    }
    return static_cast<std::uint32_t>(*length);
  }

  void skip(const Property& property) {
    const std::uint32_t length = property.count ? list_length(property) : 1;
    for (std::uint32_t i = 0; i < length; ++i) value(property);
  }

  void read_vertices(const Element& element) {
    std::vector<int> axes;  // of each property; -1: none
    for (const Property& property : element.properties) {
      const std::size_t axis =
          property.count ? std::string_view::npos
                         : std::string_view("xyz").find(property.name);
      const bool is_axis = property.name.size() == 1 && axis < 3;
      axes.push_back(is_axis ? static_cast<int>(axis) : -1);
    }
    for (const int axis : {0, 1, 2}) {
      if (std::count(axes.begin(), axes.end(), axis) != 1) {
        fail_header("x, y and z of a vertex, once each");
      }
    }
    for_each_record([&] {
      Vec3 vertex(0);
      for (std::size_t i = 0; i < axes.size(); ++i) {
        const Property& property = element.properties[i];
        if (axes[i] < 0) {
          skip(property);
        } else {
          vertex[axes[i]] = value(property);
        }
      }
      raw_.mesh.vertices.push_back(vertex);
    });
  }

  // add  makes faces of corners_
  template <typename Add>
  void read_faces(const Element& element, Add add) {
    const auto is_corners = [](const Property& property) {
      return property.name == "vertex_indices" ||
             property.name == "vertex_index";
    };
    const std::vector<Property>& properties = element.properties;
    const auto corners =
        std::find_if(properties.begin(), properties.end(), is_corners);
    if (corners == properties.end() || !corners->count ||
        !is_whole(corners->type)) {
      fail_header(
          fmt::format("a list 'vertex_indices' of whole numbers in "
                      "element '{}'",
                      element.name));
    }
    for_each_record([&] {
      for (const Property& property : properties) {
        if (&property != &*corners) {
          skip(property);
          continue;
        }
        read_corners(property);
        add();
      }
    });
  }

  void read_corners(const Property& property) {
    corners_.clear();
    for (std::uint32_t left = list_length(property); left > 0; --left) {
      const double index = value(property);
      const bool ends_strip = index == -1 && element_->name == "tristrips";
      if (!ends_strip && !(index >= 0 && index < vertex_count_ &&
                           index == std::floor(index))) {
        fail("indices of vertices");
      }
      corners_.push_back(ends_strip ? kStripEnd
                                    : static_cast<std::uint32_t>(index));
    }
  }

  // Every second triangle of a strip runs the other way round.
  void add_strips() {
    std::size_t begin = 0;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      if (corners_[i] == kStripEnd) begin = i + 1;
      if (i < begin + 2) continue;
      const bool is_turned = (i - begin) % 2 == 1;
      raw_.mesh.triangles.push_back({corners_[i - (is_turned ? 1 : 2)],
                                     corners_[i - (is_turned ? 2 : 1)],
                                     corners_[i]});
    }
  }

  static constexpr std::uint32_t kStripEnd = ~std::uint32_t{0};

  const Header& header_;
  Source source_;
  const Element* element_ = nullptr;
  std::uint32_t number_ = 0;  // of the record
  std::uint32_t vertex_count_ = 0;
  std::vector<std::uint32_t> corners_;
  RawMesh raw_;
};

}  // namespace

RawMesh parse_ply(std::string_view bytes) {
  const Header header = HeaderReader(bytes).read();
  RawMesh raw =
      header.encoding == Encoding::kText
          ? BodyReader(header, TextSource(header.body)).read()
          : BodyReader(header, BinarySource(header.body, header.encoding))
                .read();
  if (raw.mesh.triangles.empty() && raw.polygons.empty()) {
    throw FormatError("PLY without faces: points alone bound no solid,");
  }
  return raw;
}

}  // namespace lamina::csg
