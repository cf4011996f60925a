#pragma once
// The options of openscad's camera, with the meaning that they have there.

#include <string>
#include <vector>

#include <CLI/App.hpp>

#include "slicer/picture/stack_picture.h"

namespace lamina::cli {

class CameraOptions {
 public:
  // Outlives `app`.
  void add_to(CLI::App& app);

  // Whether any of them was given.
  bool is_given() const { return is_given_; }

  slicer::StackOptions stack() const;

 private:
  bool is_given_ = false;
  std::vector<double> camera_;  // 6 or 7 numbers; empty: not given
  bool views_all_ = false;
  bool centers_ = false;
  slicer::Camera::Projection projection_ =
      slicer::Camera::Projection::kPerspective;
  std::vector<double> size_ = {512, 512};
  std::string colors_ = "gold";
};

}  // namespace lamina::cli
