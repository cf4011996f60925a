#pragma once
// How the program ends.

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

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

// words  a format of fmt
template <typename... Args>
void refuse_if(bool is_wrong, fmt::format_string<Args...> words,
               Args&&... args) {
  if (!is_wrong) return;
  throw UsageError(fmt::format(words, std::forward<Args>(args)...));
}

}  // namespace lamina::cli
