#pragma once
// What the service offers: one table, by which requests are answered and which
// the description of the service (openapi.h) is made from.

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace lamina::shop {

enum class Action {
  kDesigns,
  kParameters,
  kQuote,
  kLayers,
  kPage,
  kPicture,
  kDescription,
  kHealth,
  kReady,
  kMetrics
};

struct Route {
  Action action;
  std::string_view path;  // "/designs/{name}/quote"
  std::string_view name;  // of the operation, and in the metrics
  std::string_view summary;
  std::string_view type;    // of the answer
  std::string_view schema;  // of the answer, in the description; empty: any

  bool has_name() const { return path.find('{') != std::string_view::npos; }
  // Whether it answers orders: by POST, and by GET with the order in the query.
  bool takes_order() const {
    return action == Action::kQuote || action == Action::kLayers ||
           action == Action::kPage || action == Action::kPicture;
  }
  // Whether the query says a format.
  bool takes_format() const { return action == Action::kLayers; }
};

std::span<const Route> routes();

struct Match {
  const Route* route = nullptr;
  std::string name;  // of the design, decoded
};

// The route of a path without its query. No value where there is none. Throws
// MalformedOrder where the name cannot be decoded.
std::optional<Match> find_route(std::string_view path);

}  // namespace lamina::shop
