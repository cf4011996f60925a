#pragma once
// The functions that run instantiations (InstantiationCode::run).

#include "csg/eval/code/code.h"

namespace lamina::csg {

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
