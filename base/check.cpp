#include "base/check.h"

#include "base/diagnostic.h"

namespace lamina {

void fail_check(const char* file, int line, const char* claim,
                const std::string& left, const std::string& right) {
  throw InternalError(std::string("internal error, please report: ") + file +
                      ":" + std::to_string(line) + ": " + claim +
                      " does not hold: " + left + " against " + right);
}

}  // namespace lamina
