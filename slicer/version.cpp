#include "slicer/version.h"

namespace lamina::slicer {

std::string_view version() { return LAMINA_VERSION; }

}  // namespace lamina::slicer
