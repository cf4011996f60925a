#pragma once
// Options that are good each, but not together or not for this output.

#include <stdexcept>
#include <string>

#include "cli/process/exit_status.h"

namespace lamina::cli {

class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message, int status = kUsageFault)
      : std::runtime_error(message), status_(status) {}

  int status() const { return status_; }

 private:
  int status_;
};

}  // namespace lamina::cli
