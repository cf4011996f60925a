#pragma once
// How the program ends.

#include <stdexcept>
#include <string>

namespace lamina::cli {

inline constexpr int kDone = 0;
inline constexpr int kFault = 1;  // of the design or of a file
inline constexpr int kUsageFault = 2;
inline constexpr int kInterrupted = 130;

// Options that are each good, but not together or not for this output.
class UsageError : public std::runtime_error {
 public:
  explicit UsageError(const std::string& message, int status = kUsageFault)
      : std::runtime_error(message), status_(status) {}

  int status() const { return status_; }

 private:
  int status_;
};

inline void refuse_if(bool is_wrong, const char* words) {
  if (is_wrong) throw UsageError(words);
}

}  // namespace lamina::cli
