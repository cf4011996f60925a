#include "serve/shop/routes.h"

#include <array>

#include "serve/shop/order.h"

namespace lamina::shop {
namespace {

constexpr std::string_view kJson = "application/json";
constexpr std::string_view kName = "{name}";

constexpr std::array kRoutes = {
    Route{Action::kDesigns, "/designs", "listDesigns",
          "The names of all designs", kJson, "Designs"},
    Route{Action::kParameters, "/designs/{name}/parameters", "getParameters",
          "The design's parameters, as a JSON Schema of an order's values",
          "application/schema+json", "Schema"},
    Route{Action::kQuote, "/designs/{name}/quote", "quote",
          "What the piece weighs, costs and takes, and what is wrong with it",
          kJson, "Quote"},
    Route{Action::kLayers, "/designs/{name}/layers", "makeLayers",
          "The layers of the piece, as a file", "application/octet-stream", ""},
    Route{Action::kPage, "/designs/{name}/page", "makePage",
          "A page for browsers that shows the layers and the solid",
          "text/html; charset=utf-8", ""},
    Route{Action::kPicture, "/designs/{name}/picture.png", "drawPicture",
          "A picture of the solid", "image/png", ""},
    Route{Action::kDescription, "/openapi.json", "describe", "This description",
          kJson, ""},
    Route{Action::kHealth, "/healthz", "isAlive", "Whether the service lives",
          "text/plain; charset=utf-8", ""},
    Route{Action::kReady, "/readyz", "isReady",
          "Whether the service takes orders", "text/plain; charset=utf-8", ""},
    Route{Action::kMetrics, "/metrics", "measure",
          "Counts and times, as Prometheus reads them",
          "text/plain; version=0.0.4; charset=utf-8", ""},
};

}  // namespace

std::span<const Route> routes() { return kRoutes; }

std::optional<Match> find_route(std::string_view path) {
  for (const Route& route : kRoutes) {
    if (!route.has_name()) {
      if (path == route.path) return Match{&route, ""};
      continue;
    }
    const std::string_view before =
        route.path.substr(0, route.path.find(kName));
    const std::string_view behind =
        route.path.substr(before.size() + kName.size());
    if (path.size() <= before.size() + behind.size() ||
        !path.starts_with(before) || !path.ends_with(behind)) {
      continue;
    }
    const std::string_view name =
        path.substr(before.size(), path.size() - before.size() - behind.size());
    if (name.find('/') != std::string_view::npos) continue;
    return Match{&route, percent_decoded(name)};
  }
  return std::nullopt;
}

}  // namespace lamina::shop
