#include "compiler/option_names.h"

#include <algorithm>

namespace lamina::compiler {

std::string rename_options(
    std::string_view text,
    const std::function<std::string(std::string name)>& own_name) {
  std::string renamed;
  while (true) {
    const std::size_t begin = text.find("--");
    renamed += text.substr(0, begin);
    if (begin == std::string_view::npos) return renamed;
    text.remove_prefix(begin + 2);
    const std::size_t end = std::min(text.find_first_of(" :,;"), text.size());
    renamed += own_name(std::string(text.substr(0, end)));
    text.remove_prefix(end);
  }
}

}  // namespace lamina::compiler
