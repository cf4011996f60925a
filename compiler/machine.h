#pragma once
// What the print is made with.

#include <string>

#include "base/file/file_access.h"
#include "compiler/request.h"
#include "slicer/machine/estimate.h"

namespace lamina::compiler {

using slicer::Machine;

// The profiles that are asked for, with the prices that are given; of images
// else the format's usual printer. Throws FileError where a profile cannot be
// opened, and where a material is not of the kind that is asked for.
Machine choose_machine(const OutputRequest& request, const FileAccess& access);

// Whether a price is that of the metal. Prices of litres and kilograms are
// those of the material, of grams and ounces those of the metal, as they are
// sold; of one of them alone, all are its.
bool is_price_of_metal(const slicer::Price& price, bool has_material,
                       bool has_metal);

// Says that a part is too large for the printer, and with which options, such
// as
// "--axis x --turn 90", or on which printers it would fit.
//
// size  of the part as `geometry` has it stand [mm]
std::string too_large_text(const slicer::Printer& printer,
                           const GeometryRequest& geometry, Vec3 size);

}  // namespace lamina::compiler
