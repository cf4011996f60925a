#include "serve/shop/openapi.h"

#include <string_view>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/version.h"
#include "serve/http/status.h"
#include "serve/run/messages.h"
#include "serve/shop/detail/description.h"
#include "serve/shop/routes.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;

Json reference_to(std::string_view schema) {
  return {{"$ref", "#/components/schemas/" + std::string(schema)}};
}

Json content_json(std::string_view type, std::string_view schema) {
  Json media = Json::object();
  if (!schema.empty()) media["schema"] = reference_to(schema);
  return {{std::string(type.substr(0, type.find(';'))), std::move(media)}};
}

Json header(const char* description) {
  return {{"description", description}, {"schema", {{"type", "string"}}}};
}

// The answers that are problems, by their status.
Json problem_answer(unsigned status) {
  Json answer = {
      {"description", http::title_of(status)},
      {"content", content_json("application/problem+json", "Problem")}};
  if (status == 429 || status == 503) {
    answer["headers"]["Retry-After"] =
        header("Seconds after which to ask again");
  }
  return answer;
}

Json parameters_of(const Route& route, bool is_get,
                   const std::vector<std::string>& formats) {
  Json parameters = Json::array();
  if (route.has_name()) {
    parameters.push_back({{"name", "name"},
                          {"in", "path"},
                          {"required", true},
                          {"description", "A design of /designs"},
                          {"schema", {{"type", "string"}}}});
  }
  if (route.takes_format()) {
    parameters.push_back(
        {{"name", "format"},
         {"in", "query"},
         {"schema",
          {{"type", "string"}, {"enum", formats}, {"default", "slc"}}}});
  }
  if (route.takes_order() && is_get) {
    parameters.push_back(
        {{"name", "order"},
         {"in", "query"},
         {"content", content_json("application/json", "Order")}});
    parameters.push_back({{"name", "If-None-Match"},
                          {"in", "header"},
                          {"schema", {{"type", "string"}}}});
  }
  return parameters;
}

Json answers_of(const Route& route, bool is_get) {
  Json answers;
  Json& good = answers["200"];
  good = {{"description", route.summary},
          {"content", content_json(route.type, route.schema)}};
  if (route.takes_order()) {
    good["headers"]["ETag"] =
        header("Equal for equal answers; missing while a file changes");
    if (is_get) answers["304"] = {{"description", "As the client has it"}};
    for (const unsigned status : {422U, 429U, 503U}) {
      answers[std::to_string(status)] = problem_answer(status);
    }
    if (!is_get) answers["415"] = problem_answer(415);
  }
  if (route.action == Action::kParameters) {
    answers["422"] = problem_answer(422);
  }
  if (route.action == Action::kParameters || route.action == Action::kReady) {
    answers["503"] = problem_answer(503);
  }
  if (route.has_name()) answers["404"] = problem_answer(404);
  answers["default"] = problem_answer(400);
  answers["default"]["description"] = "Any other problem";
  return answers;
}

Json operation_of(const Route& route, bool is_get,
                  const std::vector<std::string>& formats) {
  const bool is_second = route.takes_order() && is_get;
  Json operation = {
      {"operationId", std::string(route.name) + (is_second ? "ByQuery" : "")},
      {"summary", route.summary},
      {"parameters", parameters_of(route, is_get, formats)}};
  if (!is_get) {
    operation["requestBody"] = {
        {"content", content_json("application/json", "Order")}};
  }
  operation["responses"] = answers_of(route, is_get);
  return operation;
}

}  // namespace

std::string openapi(const std::vector<std::string>& formats) {
  Json paths = Json::object();
  for (const Route& route : routes()) {
    Json& path = paths[std::string(route.path)];
    path["get"] = operation_of(route, true, formats);
    if (route.takes_order()) path["post"] = operation_of(route, false, formats);
  }
  return serve::text_of(
      {{"openapi", "3.1.0"},
       {"info",
        {{"title", "lamina: quotes of designs"}, {"version", version()}}},
       {"paths", std::move(paths)},
       {"components", {{"schemas", Json::parse(kDescribedSchemas)}}}});
}

}  // namespace lamina::shop
