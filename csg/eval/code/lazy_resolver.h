#pragma once
// What running code asks of the resolver.
//
// The resolver stands above the interpreter, since it must know how each node
// is run; but bodies are resolved when they are first entered. So running code
// reaches the resolver through this interface, and sees what it makes as const.

#include <cstdint>
#include <string>
#include <string_view>

#include "csg/eval/code/code.h"

namespace lamina::csg {

// How many numbers were given out: the interpreter's tables have that many
// rows.
struct CodeCounts {
  std::uint32_t units = 0;
  std::uint32_t calls = 0;          // CallCode::number
  std::uint32_t tail_defaults = 0;  // CallCode::TailDefault::number
};

enum class Named : std::uint8_t { kVariable, kFunction, kModule };

class LazyResolver {
 public:
  virtual ~LazyResolver() = default;

  // Resolves a body for the first time; for a file that is resolved already it
  // does nothing.
  virtual void resolve(const Unit& unit) = 0;
  virtual void resolve(const Function& function) = 0;
  virtual void resolve(const Module& module) = 0;

  // The plan for a call of a literal. Made once for each pair.
  virtual const LiteralCall& plan_for(const CallCode& call,
                                      const FunctionLiteral& literal) = 0;

  // A hint for a name that nothing has: the similar one of all that the design
  // and its files define at their top, and OpenSCAD itself. Empty: none, or
  // so much was compared before that the run guesses no more.
  virtual std::string did_you_mean(Named kind, std::string_view name) = 0;

  virtual CodeCounts counts() const = 0;
};

}  // namespace lamina::csg
