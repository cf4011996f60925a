#pragma once
// Objects: members found by name, in the order in which they were first set.
//
// An object never changes, so it can hold nothing that holds it, and counts
// alone free it. A function with a parameter `this` must know its object all
// the same. OpenSCAD makes a cycle of the two; here a function is bound to the
// object when it is looked up (find_member).

#include <cstdint>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "csg/eval/value/value.h"

namespace lamina::csg {

struct Members : Counted {
  Value keys;    // a vector of strings
  Value values;  // a vector as long; functions are not bound
  std::unordered_map<std::string_view, std::uint32_t> places;  // views of keys
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
