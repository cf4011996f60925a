// search() (see functions.h).

#include <vector>

#include "base/utf8.h"
#include "csg/eval/builtin/call.h"
#include "csg/eval/builtin/functions.h"
#include "csg/eval/value/operators.h"
#include "csg/eval/value/text.h"

namespace lamina::csg {

namespace {

struct SearchLimits {
  std::uint32_t matches = 1;  // per value; 0: all
  std::uint32_t column = 0;
};

// Appends the result for one value of a list.
void push_matches(std::vector<Value> matches, const SearchLimits& limits,
                  bool keeps_empty, VectorBuilder& out) {
  if (limits.matches != 1) {
    out.push(Value::vector(matches));
  } else if (!matches.empty()) {
    out.push(matches[0]);
  } else if (keeps_empty) {
    out.push(Value::vector({}));
  }
}

// Indices of the elements for which `is_match`, as many as are asked for.
template <typename IsMatch>
std::vector<Value> find_matches(std::size_t count, std::uint32_t most,
                                const IsMatch& is_match) {
  std::vector<Value> matches;
  for (std::size_t i = 0; i < count; ++i) {
    if (!is_match(i)) continue;
    matches.emplace_back(static_cast<double>(i));
    if (most != 0 && matches.size() >= most) break;
  }
  return matches;
}

std::vector<Value> find_value(const Value& wanted, std::span<const Value> table,
                              const SearchLimits& limits) {
  return find_matches(table.size(), limits.matches, [&](std::size_t i) {
    if (limits.column == 0 && are_equal(wanted, table[i])) return true;
    const std::span<const Value> row = table[i].elements();
    return limits.column < row.size() && are_equal(wanted, row[limits.column]);
  });
}

std::vector<std::uint32_t> code_points(const Value& text) {
  std::vector<std::uint32_t> points;
  const std::uint32_t count = text.character_count();
  for (std::uint32_t i = 0; i < count; ++i) {
    points.push_back(
        first_code_point(text.as_string().substr(text.character_offset(i))));
  }
  return points;
}

Value search_in_string(const Value& wanted, const Value& text,
                       const SearchLimits& limits) {
  const std::vector<std::uint32_t> table = code_points(text);
  VectorBuilder out;
  for (const std::uint32_t point : code_points(wanted)) {
    push_matches(find_matches(table.size(), limits.matches,
                              [&](std::size_t i) { return table[i] == point; }),
                 limits, false, out);
  }
  return out.finish();
}

// Looks for each character of a string among the first characters of a column.
Value search_in_table(const Value& wanted, const Value& table,
                      const SearchLimits& limits, const CallCode& code,
                      Frame& frame) {
  const std::span<const Value> rows = table.elements();
  std::vector<std::uint32_t> firsts;
  std::size_t bad_row = rows.size();
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::span<const Value> row = rows[i].elements();
    if (row.size() <= limits.column) {
      bad_row = i;
      break;
    }
    const std::string text = to_text(row[limits.column]);
    firsts.push_back(text.empty() ? 0 : first_code_point(text));
  }
  VectorBuilder out;
  const std::vector<std::uint32_t> points = code_points(wanted);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    std::vector<Value> matches =
        find_matches(firsts.size(), limits.matches,
                     [&](std::size_t j) { return firsts[j] == points[i]; });
    const bool is_full =
        limits.matches != 0 && matches.size() >= limits.matches;
    if (bad_row < rows.size() && !is_full) {
      warn(code, frame,
           "Invalid entry in search vector at index {}, required number of "
           "values in the entry: {}. Invalid entry: {}",
           bad_row, limits.column + 1, to_echo(rows[bad_row]));
      return Value::vector({});
    }
    if (matches.empty() && frame.in.is_2021()) {
      warn(code, frame, "search term not found: \"{}\"",
           to_text(wanted.character(i)));
    }
    push_matches(std::move(matches), limits, false, out);
  }
  return out.finish();
}

std::uint32_t to_count(double number) {
  return static_cast<std::uint32_t>(cut_to<std::int64_t>(number));
}

}  // namespace

Value builtin_search(const CallCode& code, Frame& frame) {
  const std::size_t n = code.arguments.size();
  if (n < 2 || (n > 4 && !frame.in.is_2021())) {
    return wrong_count(code, frame, "between 2 and 4");
  }
  const Value wanted = argument(code, 0, frame);
  const Value table = argument(code, 1, frame);
  SearchLimits limits;
  if (n > 2)
    limits.matches = to_count(argument(code, 2, frame).number_or_zero());
  if (n > 3)
    limits.column = to_count(argument(code, 3, frame).number_or_zero());
  switch (wanted.type()) {
    case Type::kNumber:
      return Value::vector(find_value(wanted, table.elements(), limits));
    case Type::kString:
      return table.is_string()
                 ? search_in_string(wanted, table, limits)
                 : search_in_table(wanted, table, limits, code, frame);
    case Type::kVector: {
      VectorBuilder out;
      for (const Value& one : wanted.as_vector()) {
        push_matches(find_value(one, table.elements(), limits), limits, true,
                     out);
      }
      return out.finish();
    }
    default:
      return Value();
  }
}

}  // namespace lamina::csg
