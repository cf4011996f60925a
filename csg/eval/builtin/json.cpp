#include "csg/eval/builtin/json.h"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file/file_access.h"
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

  bool start_object(std::size_t) override { return open(true); }
  bool start_array(std::size_t) override { return open(false); }
  bool key(std::string& name) override {
    open_.back().key = name;
    return true;
  }
  bool end_array() override { return add(Value::vector(close().elements)); }
  bool end_object() override {
    ObjectBuilder builder;
    for (const auto& [name, member] : close().members) {
      builder.set(Value::string(name), member);
    }
    return add(builder.finish());
  }

  bool parse_error(std::size_t, const std::string&,
                   const nlohmann::detail::exception& error) override {
    fault = error.what();
    return false;
  }

 private:
  // An array, or an object, which sorts its members and keeps the last of one
  // name.
  struct Container {
    bool is_object = false;
    std::string key;  // of the member that comes next
    std::map<std::string, Value> members;
    std::vector<Value> elements;
  };

  bool add(Value added) {
    if (open_.empty()) {
      value = std::move(added);
    } else if (Container& container = open_.back(); container.is_object) {
      container.members[container.key] = std::move(added);
    } else {
      container.elements.push_back(std::move(added));
    }
    return true;
  }

  bool open(bool is_object) {
    // As deep as calls may be nested: echo and == go as deep as the value.
    constexpr std::size_t kDeepest = 200000;
    open_.emplace_back().is_object = is_object;
    if (open_.size() <= kDeepest) return true;
    fault = "nested too deeply";
    return false;
  }

  Container close() {
    Container closed = std::move(open_.back());
    open_.pop_back();
    return closed;
  }

  std::vector<Container> open_;
};

}  // namespace

JsonResult read_json(const std::string& path, const FileAccess& access) {
  JsonResult result;
  const auto bytes = access.read_regular(path);
  if (!bytes) {
    result.can_read = false;
    return result;
  }
  ValueReader reader;
  Json::sax_parse(*bytes, &reader);
  result.fault = std::move(reader.fault);
  if (result.fault.empty()) result.value = std::move(reader.value);
  return result;
}

}  // namespace lamina::csg
