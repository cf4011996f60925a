#include "compiler/compilation.h"

#include <algorithm>
#include <utility>

namespace lamina::compiler {

Compilation::Compilation(Request its_request, TemporaryFiles& files,
                         Diagnostics::Observer observer)
    : request(std::move(its_request)),
      temporary_files(files),
      diagnostics(std::move(observer)),
      loader(sources, diagnostics, library_folders(files.file_access()),
             request.design.definitions, files.file_access()),
      readers(request.design, files.file_access(), diagnostics) {
  diagnostics.set_hard_warnings(request.design.has_hard_warnings);
  if (request.design.language == "2026") loader.set_language(Language::k2026);
}

std::size_t Compilation::count(Severity severity) const {
  return static_cast<std::size_t>(
      std::ranges::count(diagnostics.all(), severity, &Diagnostic::severity));
}

bool is_among(const Diagnostics& diagnostics, const Diagnostic& message) {
  return std::ranges::any_of(diagnostics.all(), [&](const Diagnostic& one) {
    return one.message == message.message &&
           one.range.source == message.range.source &&
           one.range.begin == message.range.begin;
  });
}

std::vector<std::string> files_read(const Compilation& c) {
  std::vector<std::string> files = c.loader.files();
  const auto add = [&](const std::vector<std::string>& more) {
    files.insert(files.end(), more.begin(), more.end());
  };
  add(c.loader.missing());
  add(c.tree.files);
  add(c.readers.typesetter.files_read());
  // Printers and materials can be names too, which are no files then.
  const Request& request = c.request;
  for (const std::string& file :
       {request.design.parameter_file, request.output.printer,
        request.output.material, request.output.metal}) {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

}  // namespace lamina::compiler
