#include "csg/eval/value/object.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "csg/eval/value/operators.h"
#include "parser/ast.h"

namespace lamina::csg {

// --- ObjectBuilder ----------------------------------------------------------

void ObjectBuilder::set(const Value& key, Value value) {
  // A method is bound anew wherever it is looked up.
  if (value.is_function() && value.as_function().method != nullptr) {
    value = Value(value.as_function().method->function);
  }
  const auto count = static_cast<std::uint32_t>(keys_.size());
  const auto [place, is_new] = places_.try_emplace(key.as_string(), count);
  if (is_new) {
    keys_.push_back(key);
    values_.push_back(std::move(value));
  } else {
    values_[place->second] = std::move(value);
  }
}

void ObjectBuilder::set_all(const Value& object) {
  const Members& members = object.as_object();
  const std::span<const Value> keys = members.keys.as_vector();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    set(keys[i], members.values.as_vector()[i]);
  }
}

void ObjectBuilder::remove(std::string_view key) {
  const auto place = places_.find(key);
  if (place == places_.end()) return;
  const std::uint32_t i = place->second;
  places_.erase(place);
  keys_[i] = Value::unset();
  values_[i] = Value();
}

Value ObjectBuilder::finish() {
  auto members = std::make_unique<Members>();
  VectorBuilder keys(places_.size());
  VectorBuilder values(places_.size());
  members->places = std::move(places_);
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (keys_[i].is_unset()) continue;
    members->places[keys_[i].as_string()] =
        static_cast<std::uint32_t>(keys.size());
    keys.push(std::move(keys_[i]));
    values.push(std::move(values_[i]));
  }
  const auto count = static_cast<std::uint32_t>(keys.size());
  members->keys = keys.finish();
  members->values = values.finish();
  *this = ObjectBuilder();
  return Value::adopt(Type::kObject, members.release(), count);
}

// --- Looking up -------------------------------------------------------------

namespace {

const Value* find(const Members& members, std::string_view key) {
  const auto place = members.places.find(key);
  if (place == members.places.end()) return nullptr;
  return &members.values.as_vector()[place->second];
}

bool takes_this(const Value& value) {
  if (!value.is_function()) return false;
  const ast::Arguments parameters =
      value.as_function().code->definition->parameters;
  return std::any_of(
      parameters.begin(), parameters.end(),
      [](const ast::Argument& parameter) { return parameter.name == "this"; });
}

Value bind(const Value& function, const Value& object) {
  const Closure& closure = function.as_function();
  auto bound = std::make_unique<Closure>();
  bound->code = closure.code;
  bound->link = closure.link;
  bound->captured = closure.captured;
  bound->method = std::make_unique<const Method>(Method{function, object});
  return Value::adopt(Type::kFunction, bound.release(), 0);
}

}  // namespace

bool has_member(const Value& object, std::string_view key) {
  return find(object.as_object(), key) != nullptr;
}

Value find_member(const Value& object, std::string_view key) {
  const Value* value = find(object.as_object(), key);
  if (value == nullptr) return Value();
  return takes_this(*value) ? bind(*value, object) : *value;
}

// --- Comparing --------------------------------------------------------------

bool are_equal_objects(const Value& left, const Value& right) {
  if (left.is_identical(right)) return true;
  const Members& a = left.as_object();
  const Members& b = right.as_object();
  if (!are_equal(a.keys, b.keys)) return false;
  const std::span<const Value> values = a.values.as_vector();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Value& other = b.values.as_vector()[i];
    if (takes_this(values[i]) || !are_equal(values[i], other)) return false;
  }
  return true;
}

bool are_equal_functions(const Value& left, const Value& right) {
  if (left.is_identical(right)) return true;
  const Method* a = left.as_function().method.get();
  const Method* b = right.as_function().method.get();
  return a != nullptr && b != nullptr &&
         a->function.is_identical(b->function) &&
         a->object.is_identical(b->object);
}

}  // namespace lamina::csg
