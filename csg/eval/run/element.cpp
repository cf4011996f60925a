// Running vectors and comprehensions (see runners.h).

#include <fmt/format.h>

#include "csg/eval/run/each_value.h"
#include "csg/eval/run/runners.h"

namespace lamina::csg {

Value run_vector(const Expression& expression, Frame& frame) {
  const auto& code = as<VectorCode>(expression);
  VectorGrower out(code.elements.size());
  for (const Element* element : code.elements) {
    element->emit(*element, frame, out);
  }
  return out.finish();
}

void emit_value(const Element& element, Frame& frame, VectorGrower& out) {
  out.end().push_made([&] { return run(element.value, frame); });
}

namespace {

void emit(const Element& element, Frame& frame, VectorGrower& out) {
  if (element.emit == emit_value) {
    emit_value(element, frame, out);
  } else {
    element.emit(element, frame, out);
  }
}

// How many values there will be, where that is cheap to know; else a guess.
std::size_t count_values(const Value& values) {
  if (values.is_vector()) return values.as_vector().size();
  if (values.is_range()) {
    const std::uint32_t count = values.as_range().count();
    return count < kMostElements ? count : 0;
  }
  return 1;
}

// Functions made in a loop see its last value in 2021.01, and since then that
// of their round.
void begin_round(const Target& target, SourceRange range, Frame& frame) {
  if (!frame.in.is_2021()) {
    prepare(target, frame);
  } else if (target.variable != nullptr && target.variable->is_boxed) {
    frame.in.note_difference(range, "functions made in a loop");
  }
}

}  // namespace

void warn_of_long_range(std::uint32_t count, SourceRange place, Frame& frame) {
  warn(frame, place,
       fmt::format(
           "Bad range parameter in for statement: too many elements ({})",
           count));
}

void emit_for(const Element& element, Frame& frame, VectorGrower& out) {
  const auto& code = static_cast<const ForElement&>(element);
  const Value values = run(code.binding.value, frame);
  const Target& target = code.binding.target;
  prepare(target, frame);
  if (code.body->emit == emit_value) {
    out.end().make_room(count_values(values));
  }
  const DynamicScope scope(frame.in);
  for_each_value(values, kMostElements, element.range, frame, [&](Value value) {
    frame.in.count_step();
    frame.in.unwind(scope.mark());
    begin_round(target, element.range, frame);
    frame.in.assign(target, std::move(value), frame);
    emit(*code.body, frame, out);
  });
}

void emit_for_c(const Element& element, Frame& frame, VectorGrower& out) {
  const auto& code = static_cast<const ForCElement&>(element);
  const DynamicScope scope(frame.in);
  for (const auto& [from, to] : code.copies) {
    frame.slots[to.index] = Value::unset();
    prepare(to, frame);
  }
  run_bindings(code.init, frame);
  std::uint32_t rounds = 0;
  while (is_true(code.condition, frame)) {
    frame.in.count_step();
    emit(*code.body, frame, out);
    if (rounds++ == kMostElements) {
      frame.in.fail(element.range, "For loop counter exceeded limit",
                    frame.document);
    }
    const DynamicScope update(frame.in);
    run_bindings(code.update, frame);
    for (const auto& [from, to] : code.copies) {
      begin_round(to, element.range, frame);
      const Value& value = frame.slots[from.index];
      Value copy = value.type() == Type::kBox ? value.as_box().value : value;
      frame.in.assign(to, std::move(copy), frame);
    }
  }
}

void emit_if(const Element& element, Frame& frame, VectorGrower& out) {
  const auto& code = static_cast<const IfElement&>(element);
  const Element* branch =
      is_true(code.condition, frame) ? code.if_true : code.if_false;
  if (branch != nullptr) emit(*branch, frame, out);
}

void emit_each(const Element& element, Frame& frame, VectorGrower& out) {
  const auto& code = static_cast<const EachElement&>(element);
  const auto spread = [&](const Value& value) {
    if (value.is_vector()) {
      out.push_all(value);
    } else if (value.is_object()) {
      out.push(value);  // `for` sees its keys, `each` the object
    } else {
      for_each_value(value, kMostElements, element.range, frame,
                     [&](Value one) { out.end().push(std::move(one)); });
    }
  };
  if (code.body->emit == emit_value) {
    Value spill;
    spread(look(code.body->value, frame, spill));
    return;
  }
  VectorGrower inner;
  emit(*code.body, frame, inner);
  const Value values = inner.finish();
  for (const Value& value : values.as_vector()) spread(value);
}

void emit_let(const Element& element, Frame& frame, VectorGrower& out) {
  const auto& code = static_cast<const LetElement&>(element);
  const DynamicScope scope(frame.in);
  run_bindings(code.bindings, frame);
  emit(*code.body, frame, out);
}

}  // namespace lamina::csg
