#include "cli/options/camera_options.h"

#include <fmt/format.h>

#include "cli/options/option_values.h"
#include "slicer/picture/color_scheme.h"

namespace lamina::cli {
namespace {

constexpr double kLargestPicture = 4096;  // either way [pixels]

slicer::Camera parse_camera(const std::string& text) {
  const std::vector<double> numbers = require_numbers("--camera", text);
  require(numbers.size() == 6 || numbers.size() == 7, "--camera",
          "6 or 7 numbers were expected, not '{}'", text);
  const slicer::Camera camera = slicer::Camera::from_numbers(numbers);
  require(camera.distance > 0, "--camera", "the distance must be more than 0");
  return camera;
}

std::vector<double> parse_size(const std::string& text) {
  const std::vector<double> size = require_numbers("--imgsize", text);
  const auto is_good = [](double pixels) {
    return pixels >= 1 && pixels <= kLargestPicture &&
           pixels == static_cast<unsigned>(pixels);
  };
  require(size.size() == 2 && is_good(size[0]) && is_good(size[1]), "--imgsize",
          "two whole numbers up to {} were expected, not '{}'", kLargestPicture,
          text);
  return size;
}

}  // namespace

void CameraOptions::add_to(CLI::App& app) {
  add_text(app, "--camera", "numbers", [this](const std::string& text) {
    is_given_ = true;
    camera_ = parse_camera(text);
  });
  const auto add_flag = [&](const std::string& name, bool& flag) {
    app.add_flag_callback(name, [this, &flag] { is_given_ = flag = true; });
  };
  add_flag("--viewall", views_all_);
  add_flag("--autocenter", centers_);
  add_choice(app, "--projection",
             {"p", "perspective", "o", "ortho", "orthogonal"},
             [this](const std::string& word) {
               is_given_ = true;
               projection_ = word.front() == 'o'
                                 ? slicer::Camera::Projection::kOrthogonal
                                 : slicer::Camera::Projection::kPerspective;
             });
  add_text(app, "--imgsize", "width,height", [this](const std::string& text) {
    is_given_ = true;
    const std::vector<double> size = parse_size(text);
    options_.width = static_cast<unsigned>(size[0]);
    options_.height = static_cast<unsigned>(size[1]);
  });
  add_choice(app, "--colorscheme", slicer::color_scheme_names(),
             [this](const std::string& name) {
               is_given_ = true;
               options_.colors = slicer::find_color_scheme(name);
             });
}

slicer::StackOptions CameraOptions::stack() const {
  slicer::StackOptions options = options_;
  if (camera_) options.camera = *camera_;
  options.camera.projection = projection_;
  options.shows_all = views_all_ || !camera_;
  options.centers = centers_ || !camera_;
  return options;
}

}  // namespace lamina::cli
