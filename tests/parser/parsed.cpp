#include "tests/parser/parsed.h"

#include <cstddef>
#include <stdexcept>

#include <pthread.h>

#include "parser/customizer/program_printer.h"

namespace lamina {

namespace {

void* run(void* work) {
  (*static_cast<const std::function<void()>*>(work))();
  return nullptr;
}

}  // namespace

void run_on_large_stack(const std::function<void()>& work) {
  constexpr std::size_t kStackBytes = std::size_t{1} << 30;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, kStackBytes);
  pthread_t thread;
  void* argument = const_cast<void*>(static_cast<const void*>(&work));
  if (pthread_create(&thread, &attributes, run, argument) != 0) {
    throw std::runtime_error("no thread with a large stack");
  }
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

Parsed::Parsed(const std::string& text, const std::string& definitions)
    : loader_(sources_, diagnostics_, {}, definitions) {
  try {
    program_ = loader_.load_text("x.scad", text);
  } catch (const SyntaxError&) {
  }
}

std::string Parsed::ast() const {
  std::string text;
  if (program_) run_on_large_stack([&] { text = ast::print(*program_); });
  return text;
}

std::string Parsed::expression(const std::string& text) {
  const Parsed parsed("function f() = " + text + ";");
  const std::string printed = parsed.ast();
  const std::string head = "function f() = ";
  if (!printed.starts_with(head)) return "syntax error";
  return printed.substr(head.size(), printed.size() - head.size() - 2);
}

std::string Parsed::openscad_text() const {
  return lamina::openscad_text(messages(), "");
}

std::string Parsed::terminal_text() const {
  std::string text;
  for (const Diagnostic& message : messages()) text += caret_text(message);
  return text;
}

}  // namespace lamina
