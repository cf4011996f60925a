#pragma once
// Orders: what other programs ask for (docs/serve.md), and the request of the
// compiler that an order means.
//
// An order is JSON by strangers. Readers of JSON differ in what they make of a
// member that stands there twice, of deep nesting, of numbers beyond a double
// and of zero bytes in texts, so all of these are refused. The values of the
// design's parameters are kept as text: an Offer (serve/shop/offer.h) knows
// what they may be.

#include <optional>
#include <string>
#include <string_view>

#include "base/diagnostic.h"
#include "compiler/request.h"
#include "serve/run/names.h"

namespace lamina::shop {

// An order that is not as docs/serve.md says, or a value that is not offered.
struct OrderError : Error {
  using Error::Error;
};

// A text that is not JSON, or a query that cannot be decoded.
struct MalformedOrder : Error {
  using Error::Error;
};

// What is not given is the program's own setting, or the design's own value.
struct Order {
  std::string values = "{}";          // a JSON object, by names of parameters
  std::optional<double> layer;        // [mm]
  std::optional<double> min_feature;  // [mm]; 0: thin places are not searched
  std::optional<bool> supports;
  std::optional<double> hollow;  // thickness of walls [mm]; 0: solid
  std::optional<bool> sprue;
  std::optional<std::string> printer;  // names; empty: none
  std::optional<std::string> material;
  std::optional<std::string> metal;
  // The whole order as JSON, the same text for equal orders: members sorted,
  // those that are null left out, 1.0 and -0.0 written as 1 and 0.
  std::string canonical = "{}";
};

// Reads an order; of an empty text the empty one. Numbers are doubles. Throws
// MalformedOrder and OrderError.
Order read_order(std::string_view json);

// A part of an address, decoded. Throws MalformedOrder where it cannot be.
std::string percent_decoded(std::string_view text);

// The value of a member of a query ("order=%7B%7D&format=slc"), decoded; '+' is
// a blank. Empty where it is not there. Throws MalformedOrder where it cannot
// be decoded, or is there twice.
std::string query_value(std::string_view query, std::string_view name);
std::string order_of_query(std::string_view query);

// The request that the order makes of the service's own. Sizes of supports,
// drains and sprues are those of `base`, or the usual ones. A price of `base`
// counts only for the material that it was given for.
//
// values  that Offer::check() makes of the order's
// throws  serve::NameError for what is not among the names, OrderError where
//         numbers are beyond their limits or members contradict each other
compiler::Request request_of(const Order& order, const ParameterSet& values,
                             const compiler::Request& base,
                             const serve::Names& names);

}  // namespace lamina::shop
