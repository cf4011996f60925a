#include "csg/eval/value/value.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

#include "base/utf8.h"
#include "csg/eval/value/memory.h"
#include "csg/eval/value/object.h"

namespace lamina::csg {

namespace {

constexpr std::size_t kMaxLength = std::numeric_limits<std::uint32_t>::max();

// Bytes of a Buffer with `count` elements behind it.
template <typename Buffer>
std::size_t buffer_bytes(std::size_t count) {
  return sizeof(Buffer) + count * sizeof(*std::declval<Buffer>().data());
}
template <typename Buffer>
std::size_t bytes_of(const Buffer& buffer) {
  return buffer_bytes<Buffer>(buffer.capacity);
}

template <typename Buffer>
Buffer* allocate(std::size_t capacity) {
  if (capacity > kMaxLength) throw std::bad_alloc();
  auto* buffer = new (allocate_block(buffer_bytes<Buffer>(capacity))) Buffer;
  buffer->capacity = static_cast<std::uint32_t>(capacity);
  return buffer;
}

VectorBuffer* resize_vector(VectorBuffer* buffer, std::size_t capacity) {
  if (capacity > kMaxLength) throw std::bad_alloc();
  buffer = static_cast<VectorBuffer*>(resize_block(
      buffer, bytes_of(*buffer), buffer_bytes<VectorBuffer>(capacity)));
  buffer->capacity = static_cast<std::uint32_t>(capacity);
  return buffer;
}

void copy_values(std::string_view from, char* to) {
  std::copy(from.begin(), from.end(), to);
}
void copy_values(std::span<const Value> from, Value* to) {
  for (const Value& value : from) new (to++) Value(value);
}

// Room for what will be appended next: a long buffer that was appended to once
// is likely to be appended to again.
std::size_t grown(std::size_t needed, std::size_t long_size) {
  return needed < long_size ? needed : needed + needed / 2;
}
constexpr std::size_t kLongString = 64;
constexpr std::size_t kLongVector = 8;

// The 128 strings of one ASCII character: indexing a string mostly gives these.
// One reference too many keeps them alive.
struct AsciiStrings {
  struct Entry {
    StringBuffer buffer;
    char character;
  };
  Entry entries[128] = {};
  AsciiStrings() {
    for (int i = 0; i < 128; ++i) {
      Entry& entry = entries[i];
      *entry.buffer.data() = static_cast<char>(i);
      entry.buffer.used = entry.buffer.capacity = entry.buffer.ascii = 1;
    }
  }
};

StringBuffer* ascii_string(unsigned char c) {
  thread_local AsciiStrings table;
  return &table.entries[c].buffer;
}

}  // namespace

std::string_view type_name(Type type) {
  // In the order of the types.
  constexpr std::string_view kNames[] = {
      "undefined", "undefined", "bool",     "number", "string",
      "vector",    "range",     "function", "object", "undefined"};
  return kNames[static_cast<std::size_t>(type)];
}

std::uint32_t Range::count() const {
  constexpr std::uint32_t kEndless = std::numeric_limits<std::uint32_t>::max();
  if (std::isnan(begin) || std::isnan(end) || std::isnan(step)) return 0;
  if (step < 0 ? begin < end : begin > end) return 0;
  if (begin == end || std::isinf(step)) return 1;
  if (std::isinf(begin) || std::isinf(end) || step == 0) return kEndless;
  // One ulp makes good a quotient that rounding left just below an integer.
  const double steps = std::nextafter((end - begin) / step, kEndless);
  return steps >= kEndless ? kEndless : static_cast<std::uint32_t>(steps) + 1;
}

Value Value::string(std::string_view text) {
  if (text.size() == 1 && static_cast<unsigned char>(text[0]) < 128) {
    StringBuffer* shared = ascii_string(static_cast<unsigned char>(text[0]));
    ++shared->references;
    return adopt(Type::kString, shared, 1);
  }
  StringBuffer* buffer = allocate<StringBuffer>(text.size());
  copy_values(text, buffer->data());
  buffer->used = static_cast<std::uint32_t>(text.size());
  return adopt(Type::kString, buffer, buffer->used);
}

Value Value::vector(std::span<const Value> elements) {
  VectorBuffer* buffer = allocate<VectorBuffer>(elements.size());
  copy_values(elements, buffer->data());
  buffer->used = buffer->capacity;
  return adopt(Type::kVector, buffer, buffer->used);
}

Value Value::numbers(std::span<const double> elements) {
  VectorBuilder builder(elements.size());
  for (const double element : elements) builder.push(Value(element));
  return builder.finish();
}

Value Value::range(double begin, double step, double end) {
  auto* range = new Range;
  range->begin = begin;
  range->step = step;
  range->end = end;
  return adopt(Type::kRange, range, 0);
}

const Members& Value::as_object() const {
  return *static_cast<const Members*>(payload_.counted);
}

// --- Characters -----------------------------------------------------------

namespace {

// Counts the leading ASCII bytes among the first `length`.
void extend_ascii(StringBuffer& buffer, std::uint32_t length) {
  std::uint32_t i = buffer.ascii;
  while (i < length && static_cast<unsigned char>(buffer.data()[i]) < 128) ++i;
  buffer.ascii = i;
}

// Makes the index reach at least `length` bytes.
CharacterIndex& index_characters(StringBuffer& buffer, std::uint32_t length) {
  if (buffer.characters == nullptr) buffer.characters = new CharacterIndex;
  CharacterIndex& index = *buffer.characters;
  while (index.bytes < length) {
    index.bytes += utf8_length(buffer.data()[index.bytes]);
    ++index.characters;
    if (index.characters % CharacterIndex::kStride == 0) {
      index.offsets.push_back(index.bytes);
    }
  }
  return index;
}

}  // namespace

std::uint32_t Value::character_count() const {
  StringBuffer& buffer = string_buffer();
  if (buffer.ascii < length_) extend_ascii(buffer, length_);
  if (buffer.ascii >= length_) return length_;
  const CharacterIndex& index = index_characters(buffer, length_);
  // Count on from the last mark before the end; a character cut off by the end
  // does not count.
  const auto after =
      std::upper_bound(index.offsets.begin(), index.offsets.end(), length_);
  const auto mark =
      static_cast<std::uint32_t>(after - index.offsets.begin()) - 1;
  std::uint32_t count = mark * CharacterIndex::kStride;
  std::uint32_t offset = index.offsets[mark];
  while (offset < length_) {
    offset += utf8_length(buffer.data()[offset]);
    if (offset <= length_) ++count;
  }
  return count;
}

std::uint32_t Value::character_offset(std::uint32_t i) const {
  StringBuffer& buffer = string_buffer();
  if (i <= buffer.ascii) return i;
  extend_ascii(buffer, length_);
  if (i <= buffer.ascii) return i;
  const CharacterIndex& index = index_characters(buffer, length_);
  std::uint32_t offset = index.offsets[i / CharacterIndex::kStride];
  for (std::uint32_t k = i % CharacterIndex::kStride; k > 0; --k) {
    offset += utf8_length(buffer.data()[offset]);
  }
  return offset;
}

Value Value::character(std::uint32_t i) const {
  const std::uint32_t begin = character_offset(i);
  const std::string_view text = as_string();
  return string(text.substr(begin, utf8_length(text[begin])));
}

// --- Appending ------------------------------------------------------------

// Where a value ends where the used part of its buffer does, and there is room,
// what it grows by is written there, and the buffer is shared.

Value Value::with_appended(std::string_view text) const {
  if (text.empty()) return *this;
  StringBuffer& old = string_buffer();
  const std::size_t needed = length_ + text.size();
  StringBuffer* buffer = &old;
  if (length_ != old.used || needed > old.capacity) {
    buffer = allocate<StringBuffer>(grown(needed, kLongString));
    copy_values(as_string(), buffer->data());
  } else {
    ++old.references;
  }
  copy_values(text, buffer->data() + length_);
  buffer->used = static_cast<std::uint32_t>(needed);
  return adopt(Type::kString, buffer, buffer->used);
}

Value Value::with_appended(std::span<const Value> elements) const {
  if (elements.empty()) return *this;
  VectorBuffer& old = vector_buffer();
  const std::size_t needed = length_ + elements.size();
  std::uint32_t begin = start();
  VectorBuffer* buffer = &old;
  if (begin + length_ != old.used || begin + needed > old.capacity) {
    const std::size_t size = grown(needed, kLongVector);
    // What has grown at its front may do so again.
    begin = old.first > 0 ? room_in_front(size - needed) : 0;
    buffer = allocate<VectorBuffer>(begin + size);
    buffer->first = begin;
    copy_values(as_vector(), buffer->data() + begin);
  } else {
    ++old.references;
  }
  copy_values(elements, buffer->data() + begin + length_);
  buffer->used = static_cast<std::uint32_t>(begin + needed);
  return adopt(Type::kVector, buffer, static_cast<std::uint32_t>(needed),
               begin);
}

Value Value::with_prepended(std::span<const Value> elements) const {
  if (elements.empty()) return *this;
  VectorBuffer& old = vector_buffer();
  const std::size_t needed = length_ + elements.size();
  std::size_t begin = start();
  VectorBuffer* buffer = &old;
  if (begin != old.first || elements.size() > begin) {
    const std::size_t size = grown(needed, kLongVector);
    begin = elements.size() + room_in_front(size - needed);
    // As much room behind it: some vectors grow at both ends.
    buffer = allocate<VectorBuffer>(begin - elements.size() + size);
    copy_values(as_vector(), buffer->data() + begin);
    buffer->used = static_cast<std::uint32_t>(begin + length_);
  } else {
    ++old.references;
  }
  begin -= elements.size();
  copy_values(elements, buffer->data() + begin);
  buffer->first = static_cast<std::uint32_t>(begin);
  return adopt(Type::kVector, buffer, static_cast<std::uint32_t>(needed),
               buffer->first);
}

std::uint32_t Value::room_in_front(std::size_t wanted) {
  return static_cast<std::uint32_t>(std::min(wanted, std::size_t{kMostStart}));
}

// --- Freeing --------------------------------------------------------------

// Lets a vector that nobody refers to any more, or the values of such an
// object, join the queue of what is to be freed.
void Value::join(VectorBuffer*& dying) {
  if (is_object()) {
    auto* members = static_cast<Members*>(payload_.counted);
    Value values = std::move(members->values);
    delete members;
    if (--values.payload_.counted->references == 0) values.join(dying);
    values.head_ = head_of(Type::kUndef);
    return;
  }
  VectorBuffer& buffer = vector_buffer();
  buffer.next_dying = dying;
  dying = &buffer;
}

void Value::destroy() {
  switch (type()) {
    case Type::kString: {
      StringBuffer& buffer = string_buffer();
      delete buffer.characters;
      free_block(&buffer, bytes_of(buffer));
      return;
    }
    case Type::kRange:
      delete static_cast<Range*>(payload_.counted);
      return;
    case Type::kFunction:
      delete static_cast<Closure*>(payload_.counted);
      return;
    case Type::kBox:
      as_box().leave_list();
      delete &as_box();
      return;
    default:
      break;
  }
  // What dies with a vector or object joins a queue instead of a recursion.
  VectorBuffer* dying = nullptr;
  join(dying);
  while (dying != nullptr) {
    VectorBuffer* buffer = dying;
    dying = buffer->next_dying;
    for (std::uint32_t i = buffer->first; i < buffer->used; ++i) {
      Value& value = buffer->data()[i];
      if (!value.is_counted()) continue;
      if (--value.payload_.counted->references != 0) continue;
      if (value.is_vector() || value.is_object()) {
        value.join(dying);
      } else {
        value.destroy();
      }
    }
    free_block(buffer, bytes_of(*buffer));
  }
}

// --- VectorBuilder --------------------------------------------------------

VectorBuilder::~VectorBuilder() {
  if (buffer_ != nullptr) finish();
}

void VectorBuilder::reserve(std::size_t capacity) {
  if (capacity <= capacity_) return;
  buffer_ = buffer_ == nullptr ? allocate<VectorBuffer>(capacity)
                               : resize_vector(buffer_, capacity);
  capacity_ = buffer_->capacity;
}

void VectorBuilder::make_room(std::size_t count) {
  const std::size_t needed = size_ + count;
  if (needed <= capacity_) return;
  reserve(std::max({needed, capacity_ * std::size_t{2}, std::size_t{4}}));
}

void VectorBuilder::push_all(std::span<const Value> values) {
  if (values.empty()) return;
  make_room(values.size());
  copy_values(values, buffer_->data() + size_);
  size_ += static_cast<std::uint32_t>(values.size());
}

Value VectorBuilder::finish() {
  if (buffer_ == nullptr) {
    buffer_ = allocate<VectorBuffer>(0);
  } else if (capacity_ != size_) {
    buffer_ = resize_vector(buffer_, size_);
  }
  buffer_->used = size_;
  Value result = Value::adopt(Type::kVector, buffer_, size_);
  buffer_ = nullptr;
  size_ = capacity_ = 0;
  return result;
}

// --- VectorGrower ---------------------------------------------------------

void VectorGrower::push_all(const Value& vector) {
  const std::span<const Value> elements = vector.as_vector();
  const std::size_t before = base_.elements().size() + rest_.size();
  if (elements.size() < kLongVector || elements.size() <= before) {
    rest_.push_all(elements);
    return;
  }
  const Value rest = rest_.finish();
  base_ =
      vector.with_prepended(rest.as_vector()).with_prepended(base_.elements());
}

Value VectorGrower::finish() {
  if (!base_.is_vector()) return rest_.finish();
  const Value base = std::move(base_);
  const Value rest = rest_.finish();
  return base.with_appended(rest.as_vector());
}

}  // namespace lamina::csg
