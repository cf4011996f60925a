#include "csg/eval/builtin/json.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file/file_bytes.h"
#include "csg/eval/value/object.h"

namespace lamina::csg {

namespace {

using Json = nlohmann::json;

// Builds a value from what the parser meets, without a recursion that a deeply
// nested file could exhaust.
class ValueReader : public nlohmann::json_sax<Json> {
 public:
  Value value;
  std::string fault;

  bool null() override { return add(Value()); }
  bool boolean(bool boolean) override { return add(Value(boolean)); }
  bool number_integer(std::int64_t number) override {
    return add(Value(static_cast<double>(number)));
  }
  bool number_unsigned(std::uint64_t number) override {
    return add(Value(static_cast<double>(number)));
  }
  bool number_float(double number, const std::string&) override {
    return add(Value(number));
  }
  bool string(std::string& text) override { return add(Value::string(text)); }
  bool binary(Json::binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(); }
  bool start_array(std::size_t) override { return open(); }
  bool key(std::string& name) override {
    open_.back().keys.push_back(name);
    return true;
  }
  bool end_array() override {
    const Container array = close();
    return add(Value::vector(array.values));
  }
  bool end_object() override { return add(make_object(close())); }

  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::detail::exception& error) override {
    fault = error.what();
    return false;
  }

 private:
  struct Container {
    std::vector<std::string> keys;  // of an object
    std::vector<Value> values;
  };

  bool add(Value added) {
    if (open_.empty()) {
      value = std::move(added);
    } else {
      open_.back().values.push_back(std::move(added));
    }
    return true;
  }

  bool open() {
    // As deep as calls may be nested: echo and == go as deep as the value.
    constexpr std::size_t kDeepest = 200000;
    open_.emplace_back();
    if (open_.size() <= kDeepest) return true;
    fault = "nested too deeply";
    return false;
  }

  Container close() {
    Container closed = std::move(open_.back());
    open_.pop_back();
    return closed;
  }

  static Value make_object(const Container& container) {
    const std::vector<std::string>& keys = container.keys;
    std::vector<std::size_t> order(keys.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(
        order.begin(), order.end(),
        [&](std::size_t a, std::size_t b) { return keys[a] < keys[b]; });
    ObjectBuilder builder;
    for (const std::size_t i : order) {
      builder.set(Value::string(keys[i]), container.values[i]);
    }
    return builder.finish();
  }

  std::vector<Container> open_;
};

}  // namespace

JsonResult read_json(const std::string& path, const FileAccess& access) {
  JsonResult result;
  const auto bytes = FileBytes::open(path, access);
  if (!bytes) {
    result.can_read = false;
    return result;
  }
  ValueReader reader;
  Json::sax_parse(bytes->view(), &reader);
  result.fault = std::move(reader.fault);
  if (result.fault.empty()) result.value = std::move(reader.value);
  return result;
}

}  // namespace lamina::csg
