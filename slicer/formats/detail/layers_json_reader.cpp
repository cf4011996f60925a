// Reads .layers.json files (docs/formats.md). Unknown members are passed over;
// the document is never in memory as a whole.

#include <array>
#include <cstddef>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "plane/loop_area.h"
#include "slicer/formats/detail/reading.h"

namespace lamina::slicer {
namespace {

// Where in the document the parser is.
enum class Place {
  kTop,       // outside of all
  kDocument,  // {"units":…,"layers":[…]}
  kLayers,
  kLayer,
  kContours,
  kContour,
  kPoints,
  kPoint,
  kOther,  // in something that is passed over
};

// Makes layers from what the parser finds, value by value.
class Handler : public nlohmann::json_sax<nlohmann::json> {
 public:
  // at  where the parser reads
  Handler(const std::string& path, const TakeLayer& take, std::string_view text,
          const char*& at)
      : path_(path), take_(take), text_(text), at_(at) {}

  bool null() override { return take_other(); }
  bool boolean(bool value) override {
    if (place() != Place::kContour || key_ != "hole") return take_other();
    is_hole_ = value;
    return true;
  }
  bool number_integer(number_integer_t value) override {
    return take_number(static_cast<double>(value));
  }
  bool number_unsigned(number_unsigned_t value) override {
    return take_number(static_cast<double>(value));
  }
  bool number_float(number_float_t value, const string_t&) override {
    return take_number(value);
  }
  bool string(string_t& value) override {
    if (place() == Place::kDocument && key_ == "units") {
      if (value == "mm") return true;
      fail(fmt::format("unknown unit '{}' (mm was expected)", value));
    }
    return take_other();
  }
  bool binary(binary_t&) override { return take_other(); }
  bool key(string_t& value) override {
    key_ = value;
    return true;
  }

  bool start_object(std::size_t) override {
    switch (place()) {
      case Place::kTop:
        return enter(Place::kDocument);
      case Place::kLayers:
        layer_ = {};
        z_ = bottom_ = top_ = std::nullopt;
        ++count_;
        return enter(Place::kLayer);
      case Place::kContours:
        is_hole_ = std::nullopt;
        points_.clear();
        return enter(Place::kContour);
      default:
        return enter_other();
    }
  }
  bool start_array(std::size_t) override {
    switch (place()) {
      case Place::kDocument:
        if (key_ != "layers") return enter_other();
        has_layers_ = true;
        return enter(Place::kLayers);
      case Place::kLayer:
        if (key_ != "contours") return enter_other();
        return enter(Place::kContours);
      case Place::kContour:
        if (key_ != "points") return enter_other();
        return enter(Place::kPoints);
      case Place::kPoints:
        coordinates_ = 0;
        return enter(Place::kPoint);
      default:
        return enter_other();
    }
  }
  bool end_object() override {
    if (place() == Place::kLayer) finish_layer();
    if (place() == Place::kContour) finish_contour();
    return leave();
  }
  bool end_array() override {
    if (place() == Place::kPoint) {
      if (coordinates_ != point_.size()) fail("a point needs two numbers");
      points_.emplace_back(point_[0], point_[1]);
    }
    return leave();
  }

  bool parse_error(std::size_t place, const std::string& token,
                   const nlohmann::json::exception& error) override {
    // The library's message ends with what it expected.
    const std::string_view words = error.what();
    const std::size_t reason = words.rfind("; ");
    fail_to_read(
        path_,
        fmt::format(
            "line {}: not JSON near '{}'{}",
            line_at(text_, place == 0 ? 0 : place - 1), printable(token),
            reason == std::string_view::npos ? "" : words.substr(reason)));
  }

  bool has_layers() const { return has_layers_; }
  // What was noted while reading.
  const LayerFileFacts& facts() const { return facts_; }

 private:
  Place place() const {
    return depth_of_other_ > 0 ? Place::kOther : places_.back();
  }
  bool enter(Place place) {
    places_.push_back(place);
    key_.clear();
    return true;
  }
  bool enter_other() {
    require_no_layer_part();
    ++depth_of_other_;
    return true;
  }
  bool leave() {
    if (depth_of_other_ > 0) {
      --depth_of_other_;
    } else {
      places_.pop_back();
    }
    key_.clear();
    return true;
  }

  // Throws FileError where something else stands in a list of layers, contours
  // or points, or in the place of such a list.
  void require_no_layer_part() const {
    switch (place()) {
      case Place::kTop:
        fail("an object with \"layers\" was expected");
      case Place::kLayers:
        fail("a layer (an object) was expected");
      case Place::kContours:
        fail("a contour (an object) was expected");
      case Place::kPoints:
      case Place::kPoint:
        fail("a point (two numbers) was expected");
      case Place::kDocument:
        if (key_ == "layers") fail("\"layers\" must be a list");
        if (key_ == "units") fail("\"units\" must be a text");
        break;
      case Place::kLayer:
        if (key_ == "contours") fail("\"contours\" must be a list");
        if (height_of(key_) != nullptr) fail("a height must be a number");
        break;
      case Place::kContour:
        if (key_ == "points") fail("\"points\" must be a list");
        if (key_ == "hole") fail("\"hole\" must be true or false");
        break;
      case Place::kOther:
        break;
    }
  }

  bool take_other() {
    require_no_layer_part();
    return true;
  }

  bool take_number(double value) {
    if (place() == Place::kPoint && coordinates_ < point_.size()) {
      point_[coordinates_++] = value;
      return true;
    }
    if (place() == Place::kLayer) {
      if (const auto height = height_of(key_)) {
        this->*height = value;
        return true;
      }
    }
    return take_other();
  }

  using Height = std::optional<double> Handler::*;
  static Height height_of(std::string_view key) {
    if (key == "z") return &Handler::z_;
    if (key == "bottom") return &Handler::bottom_;
    if (key == "top") return &Handler::top_;
    return nullptr;
  }

  void finish_layer() {
    if (!z_) fail(fmt::format("layer {} has no z", count_));
    layer_.section_z = *z_;
    layer_.bottom = bottom_.value_or(*z_);
    layer_.top = top_.value_or(*z_);
    take_(layer_);
  }

  void finish_contour() {
    // Where the file does not say, the sense in which the loop runs decides.
    const bool is_hole = is_hole_.value_or(signed_area(points_) < 0);
    add_loop(points_, is_hole ? LoopKind::kHole : LoopKind::kOuter, count_,
             layer_.contours, facts_);
  }

  static std::string printable(std::string_view token) {
    std::string text;
    for (const char c : token.substr(0, 40)) {
      text += c >= ' ' && c <= '~' ? c : '?';
    }
    return text;
  }

  [[noreturn]] void fail(std::string_view message) const {
    const auto place = static_cast<std::size_t>(at_ - text_.data());
    fail_to_read(path_, fmt::format("line {}: {}",
                                    line_at(text_, place == 0 ? 0 : place - 1),
                                    message));
  }

  const std::string& path_;
  const TakeLayer& take_;
  std::string_view text_;
  const char*& at_;
  std::vector<Place> places_ = {Place::kTop};
  std::size_t depth_of_other_ = 0;
  std::string key_;
  Layer layer_;  // that is being read
  std::size_t count_ = 0;
  std::optional<double> z_;
  std::optional<double> bottom_;
  std::optional<double> top_;
  std::optional<bool> is_hole_;
  std::vector<Vec2> points_;
  std::array<double, 2> point_{};
  std::size_t coordinates_ = 0;
  bool has_layers_ = false;
  LayerFileFacts facts_;
};

// Walks over bytes, and notes for others how far it is.
class Walker {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = const char&;

  Walker(const char* at, const char** seen) : at_(at), seen_(seen) {}
  reference operator*() const { return *at_; }
  Walker& operator++() {
    *seen_ = ++at_;
    return *this;
  }
  bool operator==(const Walker& other) const { return at_ == other.at_; }
  bool operator!=(const Walker& other) const { return at_ != other.at_; }

 private:
  const char* at_;
  const char** seen_;
};

}  // namespace

LayerFileFacts read_layers_json(const std::string& path, const TakeLayer& take,
                                const FileAccess& access) {
  const std::string file = read_whole(path, access);
  const std::string_view text = file;
  const char* at = text.data();
  Handler handler(path, take, text, at);
  nlohmann::json::sax_parse(Walker(text.data(), &at),
                            Walker(text.data() + text.size(), &at), &handler);
  if (!handler.has_layers()) fail_to_read(path, "it has no list \"layers\"");
  LayerFileFacts facts = handler.facts();
  facts.format = "layers.json";
  facts.is_float32 = false;
  return facts;
}

}  // namespace lamina::slicer
