#include "serve/run/messages.h"

#include <cstddef>
#include <exception>
#include <map>
#include <new>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "compiler/tasks/quote.h"
#include "parser/customizer/customizer.h"

namespace lamina::serve {
namespace {

using Json = nlohmann::ordered_json;

const char* name_of(Severity severity) {
  switch (severity) {
    case Severity::kError:
      return "error";
    case Severity::kWarning:
      return "warning";
    case Severity::kDeprecated:
      return "deprecated";
    case Severity::kEcho:
      return "echo";
    case Severity::kPlain:
      break;
  }
  return "note";
}

Json message_json(const Diagnostic& message, std::string text,
                  const std::string& folder) {
  Json json = {{"severity", name_of(message.severity)},
               {"message", with_display_paths(message.message)},
               {"text", std::move(text)}};
  if (message.range.is_written()) {
    const Source& source = *message.range.source;
    const LineColumn place = source.line_column(message.range.begin);
    json["file"] = relative_path(absolute_path(source.path()), folder);
    json["line"] = place.line;
    json["column"] = place.column;
  }
  return json;
}

}  // namespace

std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json messages_json(const std::vector<Diagnostic>& messages,
                   const std::string& folder) {
  // A message that comes again is shown once.
  Json list = Json::array();
  std::map<std::string, std::size_t> known;
  for (const Diagnostic& message : messages) {
    std::string text = caret_text(message);
    if (text.empty()) continue;
    const auto [at, is_new] = known.try_emplace(text, list.size());
    if (is_new) {
      list.push_back(message_json(message, std::move(text), folder));
    } else {
      Json& count = list[at->second]["count"];
      count = count.is_null() ? 2 : count.get<int>() + 1;
    }
  }
  return list;
}

Json parameters_of(const ast::Program& program) {
  Json parameters = compiler::parameter_list(program);
  const std::map<std::string, std::string> widgets = widgets_of(program);
  for (Json& parameter : parameters) {
    const auto widget = widgets.find(parameter["name"].get<std::string>());
    if (widget != widgets.end()) parameter["widget"] = widget->second;
  }
  return parameters;
}

Ending run_caught(compiler::Compilation& c, const std::function<bool()>& work) {
  const auto report_own = [&c](const char* what) {
    c.diagnostics.error({},
                        fmt::format("internal error, please report: {}", what));
    return Ending::kBroken;
  };
  try {
    return work() ? Ending::kDone : Ending::kFailed;
  } catch (const InternalError& error) {
    return report_own(error.what());
  } catch (const Error& error) {
    if (!compiler::is_among(c.diagnostics, error.diagnostic())) {
      c.diagnostics.report(error.diagnostic());
    }
  } catch (const std::bad_alloc&) {
    c.diagnostics.error({}, "out of memory");
  } catch (const std::exception& error) {
    return report_own(error.what());
  }
  return Ending::kFailed;
}

}  // namespace lamina::serve
