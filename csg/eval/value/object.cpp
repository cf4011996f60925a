#include "csg/eval/value/object.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "csg/eval/value/operators.h"
#include "parser/ast.h"

namespace lamina::csg {

namespace {

// A table with these keys that more can be added to: the one given, unless
// another object has grown out of it already.
std::shared_ptr<KeyPlaces> own_places(std::shared_ptr<KeyPlaces> shared,
                                      std::span<const Value> keys) {
  if (shared->places.size() == keys.size()) return shared;
  auto own = std::make_shared<KeyPlaces>();
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    own->places.emplace(keys[i].as_string(), i);
  }
  return own;
}

}  // namespace

std::optional<std::uint32_t> Members::find(std::string_view key) const {
  const auto place = places->places.find(key);
  if (place == places->places.end()) return std::nullopt;
  if (place->second >= keys.as_vector().size()) return std::nullopt;
  return place->second;
}

// --- ObjectBuilder ----------------------------------------------------------

void ObjectBuilder::set(const Value& key, Value value) {
  // A method is bound anew wherever it is looked up.
  if (value.is_function() && value.as_function().method != nullptr) {
    value = Value(value.as_function().method->function);
  }
  if (base_.is_object()) {
    if (const auto place = base_.as_object().find(key.as_string())) {
      if (base_values_.is_shared_vector()) {
        base_values_ = Value::vector(base_values_.as_vector());
      }
      base_values_.own_elements()[*place] = std::move(value);
      return;
    }
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
  if (!base_.is_object() && keys_.empty()) {
    base_ = object;
    base_values_ = members.values;
    return;
  }
  const std::span<const Value> keys = members.keys.as_vector();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    set(keys[i], members.values.as_vector()[i]);
  }
}

void ObjectBuilder::remove(std::string_view key) {
  if (base_.is_object() && base_.as_object().find(key)) copy_base();
  const auto place = places_.find(key);
  if (place == places_.end()) return;
  const std::uint32_t i = place->second;
  places_.erase(place);
  keys_[i] = Value::unset();
  values_[i] = Value();
}

// Makes of the base's members some that stand before the others.
void ObjectBuilder::copy_base() {
  ObjectBuilder copy;
  const Value base = std::move(base_);
  const std::span<const Value> keys = base.as_object().keys.as_vector();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    copy.set(keys[i], base_values_.as_vector()[i]);
  }
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (!keys_[i].is_unset()) copy.set(keys_[i], std::move(values_[i]));
  }
  *this = std::move(copy);
}

Value ObjectBuilder::finish() {
  auto members = std::make_unique<Members>();
  VectorBuilder keys(places_.size());
  VectorBuilder values(places_.size());
  for (std::size_t i = 0; i < keys_.size(); ++i) {
    if (keys_[i].is_unset()) continue;
    keys.push(std::move(keys_[i]));
    values.push(std::move(values_[i]));
  }
  const Value new_keys = keys.finish();
  const Value new_values = values.finish();
  std::uint32_t count = 0;
  if (base_.is_object()) {
    const Members& base = base_.as_object();
    members->keys = base.keys.with_appended(new_keys.as_vector());
    members->values = base_values_.with_appended(new_values.as_vector());
    members->places = base.places;
    count = static_cast<std::uint32_t>(base.keys.as_vector().size());
  } else {
    members->keys = new_keys;
    members->values = new_values;
    members->places = std::make_shared<KeyPlaces>();
  }
  if (!new_keys.as_vector().empty()) {
    members->places = own_places(std::move(members->places),
                                 members->keys.as_vector().first(count));
    members->places->keys = members->keys;
    for (const Value& key : new_keys.as_vector()) {
      members->places->places.emplace(key.as_string(), count++);
    }
  }
  *this = ObjectBuilder();
  return Value::adopt(Type::kObject, members.release(), count);
}

// --- Looking up -------------------------------------------------------------

namespace {

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
  return object.as_object().find(key).has_value();
}

Value find_member(const Value& object, std::string_view key) {
  const Members& members = object.as_object();
  const auto place = members.find(key);
  if (!place) return Value();
  const Value& value = members.values.as_vector()[*place];
  return takes_this(value) ? bind(value, object) : value;
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
