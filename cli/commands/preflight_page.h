#pragma once
// The page of `lamina preflight`: one sheet of A4 for the casting house.

#include <string>

#include "compiler/tasks/preflight.h"

namespace lamina::cli {

// Rows of a list on the page and on the terminal; files have all.
inline constexpr std::size_t kMostRows = 8;

// "EU 54.5, US 7": what sizes an inner diameter [mm] is.
std::string ring_size_text(double diameter);

// "2.30 mm, 0.045 ct": of a stone; empty where nothing says its size.
std::string stone_text(const compiler::StoneParameter& stone);

// What keeps a piece from being cast, in words: "2 walls are too thin"; empty
// where nothing does.
std::string fault_text(const compiler::Preflight& found);

// "walls 0.8 mm, prongs and wires 0.6 mm, …": the least that a metal allows.
std::string least_text(const slicer::CastingLimits& limits);

// "wall", "gap" or "wire".
std::string kind_of(const compiler::TooThin& one);

// design  its path
//
// Throws FileError, with the package that is missing, where there is no OSMesa.
std::string preflight_page(const compiler::Preflight& found,
                           const std::string& design);

}  // namespace lamina::cli
