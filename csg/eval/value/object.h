#pragma once
// Objects: members found by name, in the order in which they were first set.
//
// An object never changes, so it can hold nothing that holds it, and counts
// alone free it. A function with a parameter `this` must know its object all
// the same. OpenSCAD makes a cycle of the two; here a function is bound to the
// object when it is looked up (find_member).
//
// An object that another one is made of with more members behind shares the
// table of places with it, so that `object(o, [[key, value]])` costs amortised
// O(1) in a loop, as appending to a vector does (value.h).

#include <cstdint>
#include <memory>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "csg/eval/value/value.h"

namespace lamina::csg {

// Where keys stand in all objects that share them.
struct KeyPlaces {
  Value keys;  // of the longest object
  std::unordered_map<std::string_view, std::uint32_t> places;  // views of keys
};

struct Members : Counted {
  Value keys;    // a vector of strings
  Value values;  // a vector as long; functions are not bound
  std::shared_ptr<KeyPlaces> places;  // may hold more keys behind these

  std::optional<std::uint32_t> find(std::string_view key) const;
};

// Collects the members of an object.
class ObjectBuilder {
 public:
  // A new member goes to the end, one that is there keeps its place.
  void set(const Value& key, Value value);
  void set_all(const Value& object);
  void remove(std::string_view key);

  // Leaves the builder empty.
  Value finish();

 private:
  void copy_base();

  Value base_;         // the object that came first, or undef
  Value base_values_;  // its values, or what they have become
  // What comes behind it.
  std::vector<Value> keys_;  // unset: removed
  std::vector<Value> values_;
  std::unordered_map<std::string_view, std::uint32_t> places_;
};

bool has_member(const Value& object, std::string_view key);

// undef where there is none. A function with a parameter `this` comes bound to
// the object.
Value find_member(const Value& object, std::string_view key);

// Whether both have the same members in the same order. Methods of two objects
// are never equal.
bool are_equal_objects(const Value& left, const Value& right);

// Whether both are one function, bound to one object if to any.
bool are_equal_functions(const Value& left, const Value& right);

}  // namespace lamina::csg
