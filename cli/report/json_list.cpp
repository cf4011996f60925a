#include "cli/report/json_list.h"

#include <utility>

#include <nlohmann/json.hpp>

#include "cli/report/run_report.h"

namespace lamina::cli {

using Json = nlohmann::ordered_json;

std::string list_element(const Json& json) {
  const std::string text = json_text(json);
  std::string indented;
  for (const char c : std::string_view(text).substr(0, text.size() - 1)) {
    if (indented.empty() || indented.back() == '\n') indented += "    ";
    indented += c;
  }
  return indented;
}

void JsonList::add(std::string_view element) {
  file_.write(count_++ == 0 ? "\n" : ",\n");
  file_.write(element);
}

void JsonList::commit(Json members, const std::string& list_name) {
  members[list_name] = Json::array();
  const std::string text = json_text(members);
  // The elements stand between the brackets of the empty list.
  const std::size_t end = text.rfind(']');
  file_.insert(0, std::string_view(text).substr(0, end));
  if (count_ > 0) file_.write("\n  ");
  file_.write(std::string_view(text).substr(end));
  file_.commit();
}

}  // namespace lamina::cli
