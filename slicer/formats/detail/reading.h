#pragma once
// What the readers of layer files have in common.

#include <span>
#include <string>
#include <string_view>

#include "base/vec.h"
#include "plane/contours.h"
#include "slicer/formats/layer_reader.h"

namespace lamina::slicer {

// The file in a .3mf archive that holds the layers.
inline constexpr const char* kThreemfModel = "3D/3dmodel.model";

// Throws FileError, whose message begins with the file's name.
[[noreturn]] void fail_to_read(const std::string& path,
                               std::string_view message);

// Throws FileError for a file that FileAccess::open could not open: errno says
// why.
[[noreturn]] void fail_to_open(const std::string& path);

// All bytes of a file. Throws FileError where there is no regular file that can
// be read, AccessError for one that may not be.
std::string read_whole(const std::string& path, const FileAccess& access);

// The number of the line that holds the byte at `place`, from 1.
std::size_t line_at(std::string_view text, std::size_t place);

// Takes the leading characters that are among `characters` off the text.
void skip(std::string_view& text, std::string_view characters);

// Takes a number, with blanks before it, off the front of `text`; false where
// there is none that is finite.
bool take_number(std::string_view& text, double& value);

// Programs may fill up a file behind its end with these.
inline constexpr std::string_view kPadding{"\0 \t\r\n\x1A", 6};

// What a file says that a loop is.
enum class LoopKind { kOuter, kHole };

// Appends a loop without its closing point, turned round where it does not run
// as its kind must. What has fewer than three points is left out and noted.
//
// layer  its number, from 1
void add_loop(std::span<const Vec2> points, LoopKind kind, std::size_t layer,
              plane::Contours& contours, LayerFileFacts& facts);

// The readers behind read_layers(): one for each format, in a source file of
// its name. SLC has slc_reader.h.
using ReadLayers = LayerFileFacts(const std::string& path,
                                  const TakeLayer& take,
                                  const FileAccess& access);
ReadLayers read_cli;
ReadLayers read_layers_json;
ReadLayers read_svg;
ReadLayers read_3mf;
ReadLayers read_ctb;
ReadLayers read_goo;
ReadLayers read_image_archive;
ReadLayers read_image_folder;

// Whether the file is a 3MF with slices; they may also hold meshes alone.
bool has_slices(const std::string& path, const FileAccess& access);

// Whether it is a folder of images with a list of what it holds; a .png may
// also be a picture.
bool is_image_folder(const std::string& path, const FileAccess& access);

}  // namespace lamina::slicer
