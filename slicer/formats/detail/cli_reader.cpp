// Reads CLI 2.0 files, ASCII and binary (docs/formats.md).
//
// Closed polylines become loops; hatches and open polylines are counted and
// left out. A layer reaches from the one before up to its z. The first one
// begins at the lower corner in the header, or else is as thick as the second.
// If that corner lies at the first z itself, all layers are sections at their
// z, without thickness.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

constexpr std::string_view kStart = "$$HEADERSTART";
constexpr std::string_view kHeaderEnd = "$$HEADEREND";

// Where the header's lower corner would make the first layer thicker than this
// many others, it belongs to something else.
constexpr double kThickestFirst = 10;

constexpr std::int64_t kOpen = 2;  // direction of lines that bound nothing

struct CliHeader {
  bool is_binary = false;
  bool is_aligned = false;       // commands begin at every fourth byte
  double unit = 1;               // [mm]
  std::optional<double> bottom;  // lower side of the part [mm]
  std::optional<double> layers;  // how many there should be
  std::size_t size = 0;          // in bytes, with its end
};

// Makes layers from the commands of the body.
class LayerMaker {
 public:
  LayerMaker(const CliHeader& header, const TakeLayer& take)
      : header_(header), take_(take) {}

  void begin_layer(double z) {
    z *= header_.unit;
    if (count_ > 0) finish_layer(z);
    layer_ = {};
    layer_.top = z;
    if (count_ == 0) {
      first_top_ = z;
    } else {
      layer_.bottom = has_thickness_ ? std::min(last_top_, z) : z;
    }
    ++count_;
  }

  // direction  0: clockwise, 1: counter-clockwise, or kOpen
  void add_polyline(std::int64_t direction, std::vector<Vec2>& points) {
    if (direction == kOpen) {
      ++facts_.left_out["open polyline"];
      return;
    }
    for (Vec2& point : points) point *= header_.unit;
    if (points.empty() || points.front() != points.back()) {
      facts_.open_loops.add(count_, points);
    }
    add_loop(points, direction == 0 ? LoopKind::kHole : LoopKind::kOuter,
             count_, layer_.contours, facts_);
  }

  void finish() {
    if (count_ > 0) finish_layer(std::nullopt);
  }

  void add_hatches() { ++facts_.left_out["hatch block"]; }

  std::size_t count() const { return count_; }
  // What was noted while reading.
  const LayerFileFacts& facts() const { return facts_; }

 private:
  // next  top of the layer above, if there is one
  void finish_layer(std::optional<double> next) {
    if (count_ == 1) {
      layer_.bottom = bottom_of_first(next);
      has_thickness_ = layer_.bottom < layer_.top;
    }
    layer_.section_z = (layer_.bottom + layer_.top) / 2;
    last_top_ = layer_.top;
    take_(layer_);
  }

  double bottom_of_first(std::optional<double> next) const {
    const double like_next =
        next ? std::min(first_top_, 2 * first_top_ - *next) : first_top_;
    if (!header_.bottom) return like_next;
    const double corner = std::min(*header_.bottom, first_top_);
    const bool is_thick =
        next && first_top_ - corner > kThickestFirst * (*next - first_top_);
    return is_thick ? like_next : corner;
  }

  const CliHeader& header_;
  const TakeLayer& take_;
  Layer layer_;  // that is being read
  std::size_t count_ = 0;
  LayerFileFacts facts_;
  double first_top_ = 0;
  double last_top_ = 0;
  bool has_thickness_ = true;
};

// Walks over the commands of an ASCII text: "$$NAME/a,b,c", with blanks, line
// ends and comments between pairs of slashes among them.
class Commands {
 public:
  // place  where the commands begin; lines count from the top of the text
  Commands(const std::string& path, std::string_view text, std::size_t place)
      : path_(path), text_(text), rest_(text.substr(place)) {}

  // False at the end of the text.
  bool next(std::string_view& name) {
    skip_blanks();
    if (rest_.empty()) return false;
    if (!rest_.starts_with("$$")) fail("a command ($$…) was expected");
    rest_.remove_prefix(2);
    std::size_t size = 0;
    while (size < rest_.size() && is_letter(rest_[size])) ++size;
    name = rest_.substr(0, size);
    rest_.remove_prefix(size);
    mark_ = '/';
    return true;
  }

  void require_end() {
    skip_blanks();
    skip(rest_, kPadding);
    if (!rest_.empty()) fail("something stands behind $$GEOMETRYEND");
  }

  // Reads the next parameter: '/' stands before the first, ',' before others.
  double number() {
    skip_blanks();
    if (!rest_.starts_with(mark_)) {
      fail(fmt::format("'{}' and a number were expected", mark_));
    }
    rest_.remove_prefix(1);
    mark_ = ',';
    skip_blanks();
    double value = 0;
    if (!take_number(rest_, value)) fail("a number was expected");
    return value;
  }

  std::int64_t whole_number() {
    const double value = number();
    if (value != std::floor(value) || std::abs(value) > 2147483648.0) {
      fail("a whole number was expected");
    }
    return static_cast<std::int64_t>(value);
  }

  void take_points(std::int64_t count, std::vector<Vec2>& points) {
    points.clear();
    if (count < 0) fail(fmt::format("{} points", count));
    for (std::int64_t i = 0; i < count; ++i) {
      const double x = number();
      points.emplace_back(x, number());
    }
  }

  void skip_parameters() {
    rest_.remove_prefix(std::min(rest_.find("$$"), rest_.size()));
  }

  [[noreturn]] void fail(std::string_view message) const {
    const std::size_t place = text_.size() - rest_.size();
    fail_to_read(path_,
                 fmt::format("line {}: {}", line_at(text_, place), message));
  }

 private:
  static bool is_letter(char c) {
    return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z');
  }

  void skip_blanks() {
    while (!rest_.empty()) {
      if (rest_.starts_with("//")) {
        const std::size_t end = rest_.find("//", 2);
        if (end == std::string_view::npos) fail("a comment has no end");
        rest_.remove_prefix(end + 2);
      } else if (std::string_view(" \t\r\n").find(rest_.front()) !=
                 std::string_view::npos) {
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  const std::string& path_;
  std::string_view text_;
  std::string_view rest_;
  char mark_ = '/';  // before the next parameter
};

CliHeader read_header(const std::string& path, std::string_view bytes) {
  if (!bytes.starts_with(kStart)) {
    fail_to_read(path,
                 "not a CLI file: it does not begin with \"$$HEADERSTART\"");
  }
  const std::size_t end = bytes.find(kHeaderEnd);
  if (end == std::string_view::npos) {
    fail_to_read(path, "the header has no end ($$HEADEREND)");
  }
  CliHeader header;
  header.size = end + kHeaderEnd.size();
  bool has_encoding = false;
  Commands commands(path, bytes.substr(0, end), 0);
  std::string_view name;
  while (commands.next(name)) {
    if (name == "BINARY" || name == "ASCII") {
      header.is_binary = name == "BINARY";
      has_encoding = true;
    } else if (name == "ALIGN") {
      header.is_aligned = true;
    } else if (name == "UNITS") {
      header.unit = commands.number();
      if (!(header.unit > 0)) commands.fail("the unit must be more than 0");
    } else if (name == "LAYERS") {
      header.layers = commands.number();
    } else if (name == "DIMENSION") {
      commands.number();
      commands.number();
      header.bottom = commands.number();
    }
    commands.skip_parameters();
  }
  if (!has_encoding) {
    fail_to_read(path, "the header has neither $$ASCII nor $$BINARY");
  }
  return header;
}

// Reads what follows the command of a polyline or of hatches.
//
// input  has whole_number(), take_points() and fail()
template <typename Input>
void read_line(Input& input, bool is_hatches, std::vector<Vec2>& points,
               LayerMaker& maker) {
  input.whole_number();  // of the part
  const std::int64_t direction = is_hatches ? 0 : input.whole_number();
  if (direction < 0 || direction > kOpen) {
    input.fail(fmt::format("direction {} (0, 1 or 2 was expected)", direction));
  }
  const std::int64_t count = input.whole_number();
  input.take_points(is_hatches ? 2 * count : count, points);
  if (is_hatches) {
    maker.add_hatches();
  } else {
    maker.add_polyline(direction, points);
  }
}

void read_ascii(const std::string& path, std::string_view text,
                std::size_t header_size, LayerMaker& maker) {
  Commands commands(path, text, header_size);
  std::string_view name;
  std::vector<Vec2> points;
  while (commands.next(name)) {
    if (name == "GEOMETRYSTART") continue;
    if (name == "GEOMETRYEND") return commands.require_end();
    if (name == "LAYER") {
      maker.begin_layer(commands.number());
      continue;
    }
    const bool is_hatches = name == "HATCHES";
    if (!is_hatches && name != "POLYLINE") {
      commands.fail(fmt::format("unknown command '$${}'", name));
    }
    if (maker.count() == 0) commands.fail("a polyline stands before any layer");
    read_line(commands, is_hatches, points, maker);
  }
  commands.fail("the file ends without $$GEOMETRYEND");
}

// Reads numbers one after another; they are little-endian, as is every machine
// that this is built for.
class BinaryNumbers {
 public:
  BinaryNumbers(const std::string& path, std::string_view bytes,
                std::size_t place)
      : path_(path), bytes_(bytes), place_(place) {}

  bool is_at_end() const { return place_ == bytes_.size(); }

  template <typename Number>
  Number take() {
    Number number;
    require(sizeof(number));
    std::memcpy(&number, bytes_.data() + place_, sizeof(number));
    place_ += sizeof(number);
    if constexpr (std::is_floating_point_v<Number>) {
      if (!std::isfinite(number)) fail("a number is not finite");
    }
    return number;
  }

  // Passes over what fills up the word of four bytes in hand, counted from the
  // begin of the file.
  void skip_to_word() {
    constexpr std::size_t kWord = 4;
    const std::size_t words = (place_ + kWord - 1) / kWord;
    place_ = std::min(kWord * words, bytes_.size());
  }

  // Checks the count before it asks for memory.
  template <typename Number>
  void take_points(std::int64_t count, std::vector<Vec2>& points) {
    points.clear();
    if (count < 0) fail(fmt::format("{} points", count));
    require(2 * sizeof(Number) * static_cast<std::size_t>(count));
    points.reserve(static_cast<std::size_t>(count));
    for (std::int64_t i = 0; i < count; ++i) {
      const auto x = static_cast<double>(take<Number>());
      points.emplace_back(x, static_cast<double>(take<Number>()));
    }
  }

  [[noreturn]] void fail(std::string_view message) const {
    fail_to_read(path_, fmt::format("byte {}: {}", place_, message));
  }

 private:
  void require(std::size_t count) const {
    if (count <= bytes_.size() - place_) return;
    fail_to_read(path_,
                 fmt::format("the file ends at byte {}, {} bytes early",
                             bytes_.size(), count - (bytes_.size() - place_)));
  }

  const std::string& path_;
  std::string_view bytes_;
  std::size_t place_;
};

// Commands of the binary body.
enum Command : std::uint16_t {
  kLongLayer = 127,
  kShortLayer = 128,
  kShortPolyline = 129,
  kLongPolyline = 130,
  kShortHatches = 131,
  kLongHatches = 132,
};

// The parameters of a binary command. `Count` is the type of its whole numbers,
// `Number` that of its coordinates.
template <typename Count, typename Number>
struct Parameters {
  BinaryNumbers& numbers;

  std::int64_t whole_number() { return numbers.take<Count>(); }
  void take_points(std::int64_t count, std::vector<Vec2>& points) {
    numbers.take_points<Number>(count, points);
  }
  [[noreturn]] void fail(std::string_view message) { numbers.fail(message); }
};

// is_aligned  two bytes follow each command, so that all that is behind it
//             begins a word; descriptions of CLI do not say the same of numbers
//             of two bytes, which are refused then
void read_binary(BinaryNumbers& numbers, bool is_aligned, LayerMaker& maker) {
  Parameters<std::uint16_t, std::uint16_t> short_ones = {numbers};
  Parameters<std::int32_t, float> long_ones = {numbers};
  std::vector<Vec2> points;
  if (is_aligned) numbers.skip_to_word();
  while (!numbers.is_at_end()) {
    const auto command = numbers.take<std::uint16_t>();
    if (is_aligned) {
      if (command >= kShortLayer && command != kLongPolyline &&
          command != kLongHatches) {
        numbers.fail(fmt::format(
            "command {} is not supported in an aligned file ($$ALIGN)",
            command));
      }
      numbers.skip_to_word();
    }
    const bool is_layer = command == kLongLayer || command == kShortLayer;
    if (maker.count() == 0 && !is_layer) {
      numbers.fail(fmt::format("command {} stands before any layer", command));
    }
    switch (command) {
      case kLongLayer:
        maker.begin_layer(static_cast<double>(numbers.take<float>()));
        break;
      case kShortLayer:
        maker.begin_layer(numbers.take<std::uint16_t>());
        break;
      case kShortPolyline:
      case kShortHatches:
        read_line(short_ones, command == kShortHatches, points, maker);
        break;
      case kLongPolyline:
      case kLongHatches:
        read_line(long_ones, command == kLongHatches, points, maker);
        break;
      default:
        numbers.fail(fmt::format("unknown command {}", command));
    }
  }
}

}  // namespace

LayerFileFacts read_cli(const std::string& path, const TakeLayer& take,
                        const FileAccess& access) {
  const std::string file = read_whole(path, access);
  const CliHeader header = read_header(path, file);
  LayerMaker maker(header, take);
  if (header.is_binary) {
    BinaryNumbers numbers(path, file, header.size);
    read_binary(numbers, header.is_aligned, maker);
  } else {
    read_ascii(path, file, header.size, maker);
  }
  maker.finish();
  // A binary body has no end of its own, so that a file cut between two
  // commands shows in nothing else.
  if (header.layers && static_cast<double>(maker.count()) != *header.layers) {
    fail_to_read(path, fmt::format("the header counts {} layers, the file "
                                   "holds {}",
                                   *header.layers, maker.count()));
  }
  LayerFileFacts facts = maker.facts();
  facts.format = header.is_binary ? "CLI, binary" : "CLI, ASCII";
  return facts;
}

}  // namespace lamina::slicer
