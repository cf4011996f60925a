#pragma once
// What the passes of a compilation share, and keep for each other.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "base/diagnostic.h"
#include "base/file/output_file.h"
#include "base/source.h"
#include "compiler/report.h"
#include "compiler/request.h"
#include "csg/text/typesetter.h"
#include "csg/tree.h"
#include "parser/ast.h"
#include "parser/loader.h"

namespace lamina::compiler {

// Called with the number of layers done and of all that there can be: with 0
// before the first layer, after each, and with both equal after the last. By
// one thread at a time.
using Progress = std::function<void(std::uint64_t done, std::uint64_t all)>;

struct Compilation {
  // request   outlives the compilation, as do `files`
  // files     say what may be read and written
  // observer  gets every message as it comes up
  Compilation(const Request& its_request, TemporaryFiles& files,
              Diagnostics::Observer observer = nullptr);
  Compilation(const Compilation&) = delete;
  Compilation& operator=(const Compilation&) = delete;

  const FileAccess& file_access() const {
    return temporary_files.file_access();
  }

  // Messages of a severity so far.
  std::size_t count(Severity severity) const;

  const Request& request;
  TemporaryFiles& temporary_files;
  // Stack that evaluation may use below the caller's frame.
  std::size_t evaluation_stack = csg::EvaluateOptions().stack_bytes;
  Progress on_progress;

  SourceStore sources;
  Diagnostics diagnostics;
  Loader loader;
  text::Typesetter typesetter;
  // A pass failed and has reported why. The next ones may still run, for what
  // they report; no layers can be made.
  bool has_failed = false;
  // Products of the first passes; the scene points into the tree.
  ast::Program program;
  csg::Tree tree;
  Report report;
  const std::chrono::steady_clock::time_point begin =
      std::chrono::steady_clock::now();
};

}  // namespace lamina::compiler
