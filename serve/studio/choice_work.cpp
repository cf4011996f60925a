#include "serve/studio/choice_work.h"

#include <string>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "serve/run/frames.h"
#include "serve/run/messages.h"
#include "serve/studio/run.h"

namespace lamina::studio {
namespace {

using serve::FrameKind;

void make(compiler::Compilation& compilation, const Choice& choice,
          const Form* form, int output) {
  if (choice.format.empty()) {
    show_choice(compilation, choice, form, output);
  } else {
    write_output(compilation, choice, output);
  }
}

}  // namespace

ChoiceWork::ChoiceWork(compiler::Request base, serve::Names names,
                       bool reads_anew)
    : base_(std::move(base)),
      names_(std::move(names)),
      reads_anew_(reads_anew) {}

void ChoiceWork::take_design(compiler::Compilation& design, int /*output*/) {
  if (!design.is_read()) return;
  form_ = form_of(design.design.program, base_.design.path,
                  design.file_access(), design.diagnostics);
}

void ChoiceWork::run(compiler::Compilation& design,
                     const serve::Command& command, int output) {
  const Choice choice = read_choice(command.body);
  compiler::Request request = request_of(choice, base_, names_);
  if (static_cast<Task>(command.kind) == Task::kSource) {
    return write_source(design, choice, output);
  }
  serve::go_on_from_read(design, std::move(request), reads_anew_ || !form_,
                         [&](compiler::Compilation& compilation) {
                           const bool is_read = &compilation == &design;
                           make(compilation, choice,
                                is_read ? &*form_ : nullptr, output);
                         });
}

void ChoiceWork::report_fault(const serve::Command& command, ChildFault fault,
                              int output) {
  const Diagnostic why{Severity::kError, {}, serve::words_of(fault)};
  const std::string messages = serve::text_of(serve::messages_json({why}, ""));
  if (static_cast<Task>(command.kind) != Task::kShow) {
    serve::write_frame(output, FrameKind::kAnswer,
                       fmt::format(R"(422 {{"messages":{}}})", messages));
    return;
  }
  const std::uint64_t number = read_choice(command.body).number;
  serve::write_frame(output, FrameKind::kEvent,
                     messages_event(number, messages));
  serve::write_frame(output, FrameKind::kLast, end_event(number, false, -1, 0));
}

}  // namespace lamina::studio
