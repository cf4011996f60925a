#pragma once
// The options of openscad's camera. They mean what they mean there.

#include <optional>

#include <CLI/App.hpp>

#include "slicer/picture/stack_picture.h"

namespace lamina::cli {

class CameraOptions {
 public:
  // Outlives `app`.
  void add_to(CLI::App& app);

  // Whether any of them was given.
  bool is_given() const { return is_given_; }

  // What they ask of a picture of a stack.
  slicer::StackOptions stack() const;

 private:
  bool is_given_ = false;
  std::optional<slicer::Camera> camera_;
  bool views_all_ = false;
  bool centers_ = false;
  slicer::Camera::Projection projection_ =
      slicer::Camera::Projection::kPerspective;
  slicer::StackOptions options_;  // its size and its colours
};

}  // namespace lamina::cli
