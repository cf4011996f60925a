#pragma once
// What a run makes of a choice, in a process of its own that has read the
// design (design_process.h).

#include <cstddef>

#include "compiler/compilation.h"
#include "serve/studio/choice.h"
#include "serve/studio/events.h"

namespace lamina::studio {

// Sends the events of a choice: the layer in view as soon as it can be cut,
// then all layers, then what they weigh.
//
// compilation  has the choice's request, and has read the design or will
// form         of the design; null: not known
// output       the pipe
void show_choice(compiler::Compilation& compilation, const Choice& choice,
                 const Form* form, int output);

// Compiles the choice to the format that it names, into standard output. Sends
// an answer: 200, or 422 with the messages.
void write_output(compiler::Compilation& compilation, const Choice& choice,
                  int output);

// Shows what it means to write the choice's values into the design's text, or
// writes them. Sends an answer: 200, or 409 where the file has changed since it
// was shown, or 422 where it cannot be done.
void write_source(compiler::Compilation& compilation, const Choice& choice,
                  int output);

}  // namespace lamina::studio
