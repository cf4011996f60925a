#pragma once
// The functions that run code (Expression::run, Element::emit,
// InstantiationCode::run).

#include "csg/eval/code/code.h"
#include "csg/eval/value/value.h"
#include "parser/ast.h"

namespace lamina::csg {

Value run_constant(const Expression& expression, Frame& frame);
Value run_local(const Expression& expression, Frame& frame);
Value run_outer(const Expression& expression, Frame& frame);
Value run_far_outer(const Expression& expression, Frame& frame);
Value run_captured(const Expression& expression, Frame& frame);
Value run_dynamic(const Expression& expression, Frame& frame);
Value run_inexact_literal(const Expression& expression, Frame& frame);
Value run_unknown_variable(const Expression& expression, Frame& frame);

Value run_conditional(const Expression& expression, Frame& frame);
Value run_index(const Expression& expression, Frame& frame);
Value run_member(const Expression& expression, Frame& frame);
Value run_range(const Expression& expression, Frame& frame);
Value run_vector(const Expression& expression, Frame& frame);
Value run_let(const Expression& expression, Frame& frame);
Value run_echo(const Expression& expression, Frame& frame);
Value run_assert_expression(const Expression& expression, Frame& frame);
Value run_function_literal(const Expression& expression, Frame& frame);

// The functions that run an operator.
Expression::Runner unary_runner(ast::UnaryOp op);
Expression::Runner binary_runner(ast::BinaryOp op, const Expression& left,
                                 const Expression& right);

// Calls by a name that no variable has: of a user's function, of a built-in
// function of one number, of any other built-in function, of an unknown one.
Value run_call_function(const Expression& expression, Frame& frame);
Value run_call_math(const Expression& expression, Frame& frame);
Value run_call_builtin(const Expression& expression, Frame& frame);
Value run_call_unknown(const Expression& expression, Frame& frame);
// A call of what may be a function value.
Value run_call_value(const Expression& expression, Frame& frame);

void emit_value(const Element& element, Frame& frame, VectorGrower& out);
void emit_for(const Element& element, Frame& frame, VectorGrower& out);
void emit_for_c(const Element& element, Frame& frame, VectorGrower& out);
void emit_if(const Element& element, Frame& frame, VectorGrower& out);
void emit_each(const Element& element, Frame& frame, VectorGrower& out);
void emit_let(const Element& element, Frame& frame, VectorGrower& out);

void run_user_module(const InstantiationCode& instantiation, Frame& frame);
void run_builtin_module(const InstantiationCode& instantiation, Frame& frame);
void run_unknown_module(const InstantiationCode& instantiation, Frame& frame);
void run_if(const InstantiationCode& instantiation, Frame& frame);
// for and intersection_for.
void run_for(const InstantiationCode& instantiation, Frame& frame);
void run_let_module(const InstantiationCode& instantiation, Frame& frame);
void run_assign(const InstantiationCode& instantiation, Frame& frame);
void run_assert_module(const InstantiationCode& instantiation, Frame& frame);

}  // namespace lamina::csg
