#pragma once
// When two faces, or two places on a ray, coincide.

namespace lamina {

// Samples, ends of chains and planes of faces nearer than this [mm] are one:
// only the states before and after them count. So faces that coincide up to
// rounding leave neither skin nor gap. It is far above the rounding of a design
// (1e-12 mm at 1e4 mm) and far below what a printer resolves; results are the
// same from 1e-5 down to 1e-9.
inline constexpr double kTieDistance = 1e-6;

}  // namespace lamina
