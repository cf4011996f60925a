#pragma once
// Values of the language: undef, booleans, numbers, strings, vectors, ranges,
// functions and objects.
//
// A Value is 16 bytes: a type, a length and either the number itself or a
// pointer to a counted, immutable object; copying one never allocates. The
// counts are not atomic: one evaluator runs on one thread.
//
// The length of a string or vector stands in the Value, not in the buffer. So a
// longer string may share the buffer of its own beginning: appending where the
// used part of the buffer ends writes behind it, which no other holder can see.
// Where a vector begins in its buffer stands there, too, so that it grows at
// its front in the same way. `str(s, c)`, `concat(v, [x])`, `[x, each v]` and
// their like cost amortised O(1) in a loop.
//
// Freeing never recurses: a vector nested a million deep dies in a loop.

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string_view>
#include <utility>
#include <vector>

namespace lamina::ast {
struct FunctionLiteral;
}

namespace lamina::csg {

class Frame;  // csg/eval/code: the variables of one activation

enum class Type : std::uint8_t {
  kUnset,  // no value of the language: a variable not assigned yet
  kUndef,
  kBool,
  kNumber,
  kString,
  kVector,
  kRange,
  kFunction,
  kObject,
  kBox,  // no value of the language: a variable that closures share
};

// "undefined", "bool", …, as OpenSCAD's messages name types.
std::string_view type_name(Type type);

class Value;

// The counted part of a value. `references` counts the Values that point here.
struct Counted {
  std::uint32_t references = 1;
};

// Where the characters of a string that is not plain ASCII begin: the offset
// of every 64th one, as far as `bytes` reaches.
struct CharacterIndex {
  static constexpr std::uint32_t kStride = 64;
  std::vector<std::uint32_t> offsets = {0};
  std::uint32_t bytes = 0;
  std::uint32_t characters = 0;
};

struct StringBuffer : Counted {
  std::uint32_t capacity = 0;
  std::uint32_t used = 0;
  std::uint32_t ascii = 0;  // this many leading bytes are known to be ASCII
  CharacterIndex* characters = nullptr;  // made when first asked for

  char* data() { return reinterpret_cast<char*>(this + 1); }
  const char* data() const { return reinterpret_cast<const char*>(this + 1); }
};

struct VectorBuffer : Counted {
  std::uint32_t capacity = 0;
  std::uint32_t first = 0;  // elements [first, used) are there
  std::uint32_t used = 0;
  VectorBuffer* next_dying = nullptr;

  Value* data() { return reinterpret_cast<Value*>(this + 1); }
  const Value* data() const { return reinterpret_cast<const Value*>(this + 1); }
};

// [begin : step : end].
struct Range : Counted {
  double begin = 0;
  double step = 1;
  double end = 0;

  // OpenSCAD's count of elements: 2³²-1 for endless ones.
  std::uint32_t count() const;
  // By multiplication, so that no error adds up.
  double at(std::uint32_t index) const {
    return index == 0 ? begin : begin + step * index;
  }
};

struct Box;
struct Closure;
struct Members;  // of an object: csg/eval/value/object.h

class Value {
 public:
  Value() = default;  // undef
  explicit Value(double number) : head_(head_of(Type::kNumber)) {
    payload_.number = number;
  }
  explicit Value(bool boolean) : head_(head_of(Type::kBool)) {
    payload_.boolean = boolean;
  }
  template <typename T>
  explicit Value(T*) = delete;  // no pointer is a boolean

  Value(const Value& other)
      : head_(other.head_), length_(other.length_), payload_(other.payload_) {
    if (is_counted()) ++payload_.counted->references;
  }
  Value(Value&& other) noexcept
      : head_(other.head_), length_(other.length_), payload_(other.payload_) {
    other.head_ = head_of(Type::kUndef);
  }
  Value& operator=(const Value& other) {
    Value copy(other);
    swap(copy);
    return *this;
  }
  Value& operator=(Value&& other) noexcept {
    const Value old(std::move(*this));
    head_ = other.head_;
    length_ = other.length_;
    payload_ = other.payload_;
    other.head_ = head_of(Type::kUndef);
    return *this;
  }
  ~Value() {
    if (is_counted()) release();
  }
  void swap(Value& other) noexcept {
    std::swap(head_, other.head_);
    std::swap(length_, other.length_);
    std::swap(payload_, other.payload_);
  }

  static Value unset() {
    Value value;
    value.head_ = head_of(Type::kUnset);
    return value;
  }
  static Value string(std::string_view text);
  static Value vector(std::span<const Value> elements);
  static Value numbers(std::span<const double> elements);
  static Value range(double begin, double step, double end);
  // Takes over the caller's count.
  //
  // start  of a vector: where in its buffer it begins
  static Value adopt(Type type, Counted* counted, std::uint32_t length,
                     std::uint32_t start = 0) {
    Value value;
    value.head_ = head_of(type) | start << kStartShift;
    value.length_ = length;
    value.payload_.counted = counted;
    return value;
  }

  Type type() const { return static_cast<Type>(head_ & kTypeMask); }
  bool is_unset() const { return type() == Type::kUnset; }
  bool is_undef() const { return type() <= Type::kUndef; }
  bool is_bool() const { return type() == Type::kBool; }
  bool is_number() const { return type() == Type::kNumber; }
  bool is_string() const { return type() == Type::kString; }
  bool is_vector() const { return type() == Type::kVector; }
  bool is_range() const { return type() == Type::kRange; }
  bool is_function() const { return type() == Type::kFunction; }
  bool is_object() const { return type() == Type::kObject; }

  // Only for a value of that type.
  double as_number() const { return payload_.number; }
  bool as_bool() const { return payload_.boolean; }
  std::string_view as_string() const {
    return {static_cast<const StringBuffer*>(payload_.counted)->data(),
            length_};
  }
  std::span<const Value> as_vector() const {
    return {
        static_cast<const VectorBuffer*>(payload_.counted)->data() + start(),
        length_};
  }
  const Range& as_range() const {
    return *static_cast<const Range*>(payload_.counted);
  }
  const Closure& as_function() const;
  const Members& as_object() const;
  Box& as_box() const;

  // Elements of a vector that no other value holds, to be overwritten; none of
  // any other value.
  std::span<Value> own_elements() {
    if (!is_vector() || payload_.counted->references != 1) return {};
    return {vector_buffer().data() + start(), length_};
  }
  // Whether it is a vector that another value holds, too.
  bool is_shared_vector() const {
    return is_vector() && payload_.counted->references > 1;
  }
  // Elements of a vector; none for any other type.
  std::span<const Value> elements() const {
    return is_vector() ? as_vector() : std::span<const Value>();
  }
  // The number; 0 for any other type.
  double number_or_zero() const { return is_number() ? payload_.number : 0.0; }

  // What `if` takes it for.
  bool is_true() const {
    switch (type()) {
      case Type::kBool:
        return payload_.boolean;
      case Type::kNumber:
        return payload_.number != 0;
      case Type::kString:
      case Type::kVector:
      case Type::kObject:
        return length_ != 0;
      default:
        return is_range() || is_function();
    }
  }

  // Number of characters of a string, and one of them as a string of its own
  // (index < character_count). O(1) but for the first use of a buffer.
  std::uint32_t character_count() const;
  Value character(std::uint32_t index) const;
  // Byte offset of a character (index ≤ character_count).
  std::uint32_t character_offset(std::uint32_t index) const;

  // This string or vector with more behind it; may share the buffer.
  Value with_appended(std::string_view text) const;
  Value with_appended(std::span<const Value> elements) const;
  // This vector with more in front of it; may share the buffer.
  Value with_prepended(std::span<const Value> elements) const;

  // Whether both share one buffer or function (functions compare so).
  bool is_identical(const Value& other) const {
    return payload_.counted == other.payload_.counted;
  }

 private:
  bool is_counted() const { return type() >= Type::kString; }
  void release() {
    if (--payload_.counted->references == 0) destroy();
  }
  void destroy();
  void join(VectorBuffer*& dying);
  StringBuffer& string_buffer() const {
    return *static_cast<StringBuffer*>(payload_.counted);
  }
  VectorBuffer& vector_buffer() const {
    return *static_cast<VectorBuffer*>(payload_.counted);
  }

  union Payload {
    double number;
    bool boolean;
    Counted* counted;
  };

  static constexpr std::uint32_t kTypeMask = 0xff;
  static constexpr std::uint32_t kStartShift = 8;
  // Where a vector can begin at most in its buffer.
  static constexpr std::uint32_t kMostStart = 0xffffffff >> kStartShift;

  static constexpr std::uint32_t head_of(Type type) {
    return static_cast<std::uint32_t>(type);
  }
  std::uint32_t start() const { return head_ >> kStartShift; }
  static std::uint32_t room_in_front(std::size_t wanted);

  // The type, and where a vector begins in its buffer.
  std::uint32_t head_ = head_of(Type::kUndef);
  // Bytes of a string, elements of a vector, members of an object.
  std::uint32_t length_ = 0;
  Payload payload_ = {.counted = nullptr};
};
static_assert(sizeof(Value) == 16);

// A variable that lives on in the closures that captured it, used where it gets
// its value after they were made, or several times. A function that calls
// itself through such a variable is a cycle, which counts cannot free: so all
// boxes stand in a list, and the evaluator empties them when it ends.
struct Box : Counted {
  Value value = Value::unset();
  Box* previous = nullptr;
  Box* next = nullptr;

  void leave_list() {
    if (previous != nullptr) previous->next = next;
    if (next != nullptr) next->previous = previous;
    previous = next = nullptr;
  }
};

// What a function that was taken out of an object is: that function, and the
// object as its parameter `this`.
struct Method {
  Value function;
  Value object;
};

// The code of a function value, as far as values look at it. What runs it is
// the FunctionLiteral of csg/eval/code, made of this.
struct FunctionCode {
  const ast::FunctionLiteral* definition = nullptr;
};

// A function value: its code and the variables that it took along.
struct Closure : Counted {
  const FunctionCode* code = nullptr;
  Frame* link = nullptr;  // variables of the module or file around it
  std::vector<Value> captured;
  std::unique_ptr<const Method> method;  // mostly null
};

inline const Closure& Value::as_function() const {
  return *static_cast<const Closure*>(payload_.counted);
}

inline Box& Value::as_box() const {
  return *static_cast<Box*>(payload_.counted);
}

// Collects the elements of a vector.
class VectorBuilder {
 public:
  VectorBuilder() = default;
  explicit VectorBuilder(std::size_t capacity) { reserve(capacity); }
  VectorBuilder(const VectorBuilder&) = delete;
  VectorBuilder& operator=(const VectorBuilder&) = delete;
  ~VectorBuilder();

  // Room for `count` more; several calls cost no more than one.
  void make_room(std::size_t count);
  void push(Value value) {
    new (place_of_next()) Value(std::move(value));
    ++size_;
  }
  // Makes a value where it will stand; `make` must not touch the builder.
  template <typename Make>
  void push_made(const Make& make) {
    new (place_of_next()) Value(make());
    ++size_;
  }
  void push_all(std::span<const Value> values);
  std::size_t size() const { return size_; }
  std::span<const Value> values() const {
    return buffer_ ? std::span<const Value>(buffer_->data(), size_)
                   : std::span<const Value>();
  }

  // Leaves the builder empty.
  Value finish();

 private:
  void reserve(std::size_t capacity);
  void* place_of_next() {
    if (size_ == capacity_) make_room(1);
    assert(buffer_ != nullptr);
    return buffer_->data() + size_;
  }

  VectorBuffer* buffer_ = nullptr;
  std::uint32_t size_ = 0;
  std::uint32_t capacity_ = 0;
};

// Collects the elements of a vector that may be a long one with a few more at
// its ends: the longest that comes whole is not copied.
class VectorGrower {
 public:
  VectorGrower() = default;
  explicit VectorGrower(std::size_t capacity) : rest_(capacity) {}

  void push(const Value& value) { rest_.push(value); }
  void push_all(const Value& vector);
  // What is added here comes last.
  VectorBuilder& end() { return rest_; }

  // Leaves the grower empty.
  Value finish();

 private:
  Value base_;  // what comes first; undef: nothing
  VectorBuilder rest_;
};

}  // namespace lamina::csg
