#pragma once
// Values that the symbols of the grammar carry.
//
// They stand in a union and move with Bison's stack, so they are plain: no
// initialisers, no destructors.

#include <cstddef>
#include <cstdint>

#include "parser/ast.h"

namespace lamina::detail {

struct Text {
  const char* data;
  std::size_t size;
};

// Every expression knows its depth. Later passes recurse over trees, so a tree
// that their stack could not hold is an error of the parser: a chain like
// `1 + 1 + …` is as deep as it is long, without ever filling Bison's stack.
struct Tree {
  const ast::Expr* expr;  // null: none
  std::uint32_t depth;
};

// Lists grow on one scratch stack per kind and move to the arena when their
// closing bracket is read. Brackets nest, so lists end in reverse order of
// their beginnings and a list is always the top of its stack.
struct List {
  std::uint32_t begin;  // on the scratch stack; the end is its top
  std::uint32_t depth;  // of the deepest element
};

struct Scope {
  std::uint32_t begin;  // of its statements on the scratch stack
  std::uint32_t outer;  // id of the scope around it
};

}  // namespace lamina::detail
