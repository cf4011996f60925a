#include "parser/parser.h"

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

namespace {

// Frees the scanner also where a hard warning ends the parser by exception.
class Scanner {
 public:
  explicit Scanner(detail::Reader& reader) {
    if (scadlex_init_extra(&reader, &scanner_) != 0) throw std::bad_alloc();
  }
  ~Scanner() { scadlex_destroy(scanner_); }
  Scanner(const Scanner&) = delete;
  Scanner& operator=(const Scanner&) = delete;

  void* get() const { return scanner_; }

 private:
  void* scanner_ = nullptr;
};

}  // namespace

ast::Program parse(const Source& source, const Source* user, Loader& loader,
                   Diagnostics& diagnostics) {
  detail::SyntaxErrors errors(diagnostics);
  detail::Builder builder(source, user, errors, loader.file_access(),
                          diagnostics);
  detail::Reader reader(source, builder.arena(), loader, errors, diagnostics);
  detail::ParserStack stack;
  const Scanner scanner(reader);
  // `errors` counts the errors, so what the parser returns is not needed.
  scadparse(scanner.get(), reader, builder, errors, stack);
  return builder.finish();
}

}  // namespace lamina
