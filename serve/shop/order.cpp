#include "serve/shop/order.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <functional>
#include <iterator>
#include <set>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/similar.h"
#include "base/text.h"
#include "compiler/machine.h"
#include "compiler/validate.h"
#include "serve/shop/detail/json_number.h"

namespace lamina::shop {
namespace {

using ReadJson = nlohmann::json;

constexpr int kDeepest = 8;  // levels of objects and lists

constexpr std::array<std::string_view, 9> kMembers = {
    "values", "layer",   "minFeature", "supports", "hollow",
    "sprue",  "printer", "material",   "metal"};

// Refuses what readers of JSON understand in different ways.
class Watch {
 public:
  bool operator()(int depth, ReadJson::parse_event_t event,
                  const ReadJson& parsed) {
    switch (event) {
      case ReadJson::parse_event_t::object_start:
      case ReadJson::parse_event_t::array_start:
        if (depth >= kDeepest) {
          throw OrderError(fmt::format(
              "an order is nested at most {} levels deep", kDeepest));
        }
        members_.emplace_back();
        break;
      case ReadJson::parse_event_t::object_end:
      case ReadJson::parse_event_t::array_end:
        members_.pop_back();
        break;
      case ReadJson::parse_event_t::key:
        take_key(parsed.get_ref<const std::string&>());
        break;
      case ReadJson::parse_event_t::value:
        break;
    }
    return true;
  }

 private:
  void take_key(const std::string& name) {
    if (members_.back().insert(name).second) return;
    throw OrderError(fmt::format("'{}' is there twice", short_name(name)));
  }

  std::vector<std::set<std::string>> members_;  // of each open level
};

ReadJson parse(std::string_view text) {
  // Where the parser would see the end.
  if (text.find('\0') != std::string_view::npos) {
    throw MalformedOrder("the order is not JSON: it has a zero byte");
  }
  Watch watch;
  try {
    return ReadJson::parse(text, std::ref(watch));
  } catch (const ReadJson::parse_error& error) {
    throw MalformedOrder(
        fmt::format("the order is not JSON: see its character {}", error.byte));
  } catch (const ReadJson::out_of_range&) {
    throw OrderError("a number of the order is beyond those of a double");
  }
}

void refuse_zero_bytes(const std::string& text) {
  if (text.find('\0') == std::string::npos) return;
  throw OrderError("a text of the order has a zero byte");
}

void drop_nulls(ReadJson& object) {
  for (auto member = object.begin(); member != object.end();) {
    refuse_zero_bytes(member.key());
    member = member->is_null() ? object.erase(member) : std::next(member);
  }
}

// Makes equal values equal texts.
void normalize(ReadJson& json) {
  if (json.is_number()) {
    json = detail::json_number<ReadJson>(json.get<double>());
  }
  if (json.is_string()) refuse_zero_bytes(json.get_ref<const std::string&>());
  if (json.is_object()) drop_nulls(json);
  if (json.is_structured()) std::ranges::for_each(json, normalize);
}

void refuse_unknown(const ReadJson& order) {
  for (const auto& [name, value] : order.items()) {
    if (std::ranges::find(kMembers, name) != kMembers.end()) continue;
    const std::string guess = did_you_mean(name, kMembers);
    throw OrderError(fmt::format("'{}' is not a member of an order{}{}",
                                 short_name(name), guess.empty() ? "" : ": ",
                                 guess));
  }
}

template <typename T>
std::optional<T> member(const ReadJson& order, const char* name,
                        bool (ReadJson::*is_fit)() const noexcept,
                        const char* type) {
  const auto found = order.find(name);
  if (found == order.end()) return std::nullopt;
  if (!((*found).*is_fit)()) {
    throw OrderError(fmt::format("{} must be {}", name, type));
  }
  return found->get<T>();
}

std::optional<double> number(const ReadJson& order, const char* name) {
  return member<double>(order, name, &ReadJson::is_number, "a number");
}
std::optional<bool> truth(const ReadJson& order, const char* name) {
  return member<bool>(order, name, &ReadJson::is_boolean, "true or false");
}
std::optional<std::string> text(const ReadJson& order, const char* name) {
  return member<std::string>(order, name, &ReadJson::is_string, "a text");
}

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

// Adds what is asked for, with the usual sizes where the service has none, or
// takes it away.
template <typename Sizes>
void ask_for(bool is_asked, const Sizes& usual, std::optional<Sizes>& sizes) {
  if (!is_asked) sizes.reset();
  if (is_asked && !sizes) sizes = usual;
}

void ask_for_supports(bool is_asked, compiler::Request& request) {
  ask_for(is_asked, slicer::SupportSizes{.tip = 0}, request.supports);
  if (is_asked) return;
  request.support_lines = {};
  request.raft_label.clear();
}

void ask_for_walls(double thickness, compiler::Request& request) {
  ask_for(thickness != 0, slicer::HollowSizes{}, request.hollow);
  if (request.hollow) request.hollow->wall = thickness;
}

// The material that a price is of.
const std::string& priced(const compiler::OutputRequest& output,
                          const slicer::Price& price) {
  return compiler::is_price_of_metal(price, !output.material.empty(),
                                     !output.metal.empty())
             ? output.metal
             : output.material;
}

void choose_materials(const Order& order, const compiler::OutputRequest& base,
                      const serve::Names& names,
                      compiler::OutputRequest& output) {
  if (order.printer) output.printer = *order.printer;
  if (order.material) output.material = names.own_name(*order.material);
  if (order.metal) output.metal = names.own_name(*order.metal);
  std::erase_if(output.prices, [&](const slicer::Price& price) {
    return priced(output, price) != priced(base, price);
  });
}

// A fault of a request in the names of an order: "--min-feature: must be …" is
// "minFeature must be …".
std::string in_own_names(std::string_view words) {
  std::string text = compiler::rename_options(words, [](std::string name) {
    std::size_t hyphen = 0;
    while ((hyphen = name.find('-', hyphen)) != name.npos) {
      name.erase(hyphen, 1);
      if (hyphen == name.size()) break;
      name[hyphen] = static_cast<char>(std::toupper(name[hyphen]));
    }
    return name;
  });
  // The name begins a sentence.
  if (const std::size_t colon = text.find(": must"); colon != text.npos) {
    text.erase(colon, 1);
  }
  return text;
}

}  // namespace

Order read_order(std::string_view json) {
  if (json.empty()) return {};
  ReadJson all = parse(json);
  if (!all.is_object()) {
    throw OrderError("an order must be an object, such as {\"layer\": 0.05}");
  }
  normalize(all);
  refuse_unknown(all);
  Order order;
  if (const auto values = all.find("values"); values != all.end()) {
    if (!values->is_object()) throw OrderError("values must be an object");
    order.values = values->dump();
    if (values->empty()) all.erase(values);
  }
  order.layer = number(all, "layer");
  order.min_feature = number(all, "minFeature");
  order.supports = truth(all, "supports");
  order.hollow = number(all, "hollow");
  order.sprue = truth(all, "sprue");
  order.printer = text(all, "printer");
  order.material = text(all, "material");
  order.metal = text(all, "metal");
  order.canonical = all.dump();
  return order;
}

std::string percent_decoded(std::string_view text) {
  std::string decoded;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '%') {
      decoded += text[i];
      continue;
    }
    const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
    const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
    if (high < 0 || low < 0) {
      throw MalformedOrder("the address has a '%' without two hex digits");
    }
    decoded += static_cast<char>(high * 16 + low);
    i += 2;
  }
  return decoded;
}

std::string query_value(std::string_view query, std::string_view name) {
  std::optional<std::string> value;
  while (!query.empty()) {
    const std::string_view part = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(part.size() + 1, query.size()));
    const std::size_t sign = std::min(part.find('='), part.size());
    if (part.substr(0, sign) != name) continue;
    if (value) {
      throw MalformedOrder(fmt::format("the query has '{}' twice", name));
    }
    std::string written(part.substr(std::min(sign + 1, part.size())));
    std::ranges::replace(written, '+', ' ');
    value = percent_decoded(written);
  }
  return value.value_or("");
}

std::string order_of_query(std::string_view query) {
  return query_value(query, "order");
}

compiler::Request request_of(const Order& order, const ParameterSet& values,
                             const compiler::Request& base,
                             const serve::Names& names) {
  compiler::Request request = base;
  request.design.parameters = values;
  request.job.layer_thickness = order.layer.value_or(base.job.layer_thickness);
  request.job.min_feature = order.min_feature.value_or(base.job.min_feature);
  if (order.supports) ask_for_supports(*order.supports, request);
  if (order.hollow) ask_for_walls(*order.hollow, request);
  if (order.sprue) ask_for(*order.sprue, slicer::SprueSizes{}, request.sprues);
  choose_materials(order, base.output, names, request.output);
  serve::require_name(names.printers, request.output.printer, "printer");
  serve::require_name(names.materials, request.output.material, "material");
  serve::require_name(names.metals, request.output.metal, "metal");
  try {
    compiler::validate(request);
  } catch (const compiler::RequestError& error) {
    throw OrderError(in_own_names(error.what()));
  }
  return request;
}

}  // namespace lamina::shop
