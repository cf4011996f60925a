#pragma once
// What is known of a stack of images once its last layer is drawn, and the
// texts that its formats hold about it.

#include <cstddef>
#include <string>
#include <vector>

#include "base/vec.h"
#include "slicer/formats/output_format.h"
#include "slicer/machine/estimate.h"
#include "slicer/machine/printer.h"

namespace lamina::slicer {

struct ImageLayer {
  double z = 0;          // height of the section [mm]
  double thickness = 0;  // [mm]
  // Corners of the box of pixels that can be covered, y down; equal where no
  // pixel can be.
  Vec2 low = Vec2(0);
  Vec2 high = Vec2(0);
  std::vector<double> regions;  // their areas [mm²]
};

struct ImageStack {
  OutputFormat format = OutputFormat::kPng;
  // One line each: the name of the design's output, without folder and ending,
  // and the material's, empty where none was named.
  std::string job;
  Printer printer;
  Exposure exposure;
  std::string material;
  double layer_thickness = 0;  // [mm]; 0 if layers differ
  double volume = 0;           // of the layers [mm³]
  std::vector<ImageLayer> layers;
};

// How the platform moves behind a layer, counted from 0.
inline const PlatformMoves& moves_of(const Printer& printer,
                                     std::size_t layer) {
  return layer < kFirstLayers ? printer.first_moves : printer.moves;
}

// Name of the text that lists what a folder holds.
inline constexpr const char* kFolderContents = "index.json";

// Name of the image of a layer, counted from 0.
std::string image_name(const ImageStack& stack, std::size_t layer);

struct StackText {
  std::string name;
  std::string text;
};

// The format's texts, each a file of the folder or an entry of the archive.
std::vector<StackText> stack_texts(const ImageStack& stack);

}  // namespace lamina::slicer
