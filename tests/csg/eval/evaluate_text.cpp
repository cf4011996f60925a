#include "tests/csg/eval/evaluate_text.h"

#include <filesystem>
#include <fstream>
#include <functional>
#include <sstream>

#include <pthread.h>

#include "base/diagnostic.h"
#include "csg/csg_printer.h"
#include "csg/eval/evaluator.h"
#include "parser/loader.h"

namespace lamina::csg {

namespace {

void run_on_stack(std::size_t bytes, std::function<void()> work) {
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  pthread_attr_setstacksize(&attributes, bytes);
  pthread_t thread = {};
  const auto enter = [](void* argument) -> void* {
    (*static_cast<std::function<void()>*>(argument))();
    return nullptr;
  };
  pthread_create(&thread, &attributes, enter, &work);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

Evaluated evaluate_with(std::size_t stack_bytes, Language language,
                        const std::string& path, const std::string* text) {
  Evaluated result;
  run_on_stack(stack_bytes, [&] {
    SourceStore sources;
    Diagnostics diagnostics;
    try {
      Loader loader(sources, diagnostics, library_folders());
      const ast::Program program =
          text != nullptr ? loader.load_text(path, *text) : loader.load(path);
      EvaluateOptions options;
      options.language = language;
      options.stack_bytes = stack_bytes - (std::size_t{1} << 20);
      const Tree tree = evaluate(program, loader, options, diagnostics);
      result.csg = print_csg(tree, *select_root(tree, diagnostics));
    } catch (const SyntaxError&) {
      // Reported; there is no tree.
    }
    const std::string folder =
        std::filesystem::absolute(path).parent_path().string();
    result.echo = openscad_text(diagnostics.all(), folder);
    for (const Diagnostic& diagnostic : diagnostics.all()) {
      if (diagnostic.severity != Severity::kEcho) {
        result.terminal += caret_text(diagnostic);
      }
    }
  });
  return result;
}

}  // namespace

Evaluated evaluate_text(const std::string& text, std::size_t stack_bytes,
                        Language language) {
  return evaluate_with(stack_bytes, language, "test.scad", &text);
}

Evaluated evaluate_file(const std::string& path) {
  return evaluate_with(std::size_t{256} << 20, Language::k2021, path, nullptr);
}

std::string read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace lamina::csg
