#include "parser/parser.h"

#include <memory>
#include <new>

#include "parser/detail/builder.h"
#include "parser/detail/parser_stack.h"
#include "parser/detail/reader.h"
#include "parser/detail/syntax_errors.h"
#include "parser/loader.h"
#include "scad_grammar.h"

// Made by Flex.
int scadlex_init_extra(lamina::detail::Reader* reader, void** scanner);
int scadlex_destroy(void* scanner);

namespace lamina {

ast::Program parse(const Source& source, const Source* user, Loader& loader,
                   Diagnostics& diagnostics) {
  detail::SyntaxErrors errors(diagnostics);
  detail::Builder builder(source, user, loader.language(), errors,
                          loader.file_access(), diagnostics);
  detail::Reader reader(source, builder.arena(), loader, errors, diagnostics);
  detail::ParserStack stack;
  void* made = nullptr;
  if (scadlex_init_extra(&reader, &made) != 0) throw std::bad_alloc();
  // A hard warning ends the parser by exception.
  const std::unique_ptr<void, int (*)(void*)> scanner(made, scadlex_destroy);
  // `errors` counts the errors, so what the parser returns is not needed.
  scadparse(scanner.get(), reader, builder, errors, stack);
  return builder.finish();
}

}  // namespace lamina
