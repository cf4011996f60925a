#pragma once
// The events of docs/studio.md as JSON.

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "compiler/compilation.h"
#include "parser/ast.h"
#include "serve/studio/choice.h"
#include "slicer/check/defects/inspect.h"

namespace lamina::studio {

// The parameters of a design and the sets beside it, as a page shows them.
struct Form {
  std::string key;         // equal forms have equal keys
  std::string parameters;  // JSON
  std::string sets;        // JSON
};

// The file of sets that OpenSCAD keeps beside a design: ring.json beside
// ring.scad.
std::string sets_file(const std::string& path);

// Reads the customizer's comments, and the file of sets if there is one. Warns
// where it cannot be read.
Form form_of(const ast::Program& program, const std::string& path,
             const FileAccess& access, Diagnostics& diagnostics);

std::string form_event(std::uint64_t number, const Form& form);

// messages  of serve::messages_json()
std::string messages_event(std::uint64_t number, const std::string& messages);

// What the print weighs, in each metal that lamina knows, and what it takes.
std::string report_event(std::uint64_t number,
                         const compiler::Compilation& compilation,
                         const slicer::Inspection& found);

std::string hello_event(const std::string& client, const serve::Names& names,
                        const std::string& design, const JobChoice& job);

// The member "name" of a run's answer, and the page's answer to POST /output.
std::string name_in_answer(const std::string& json);
std::string file_answer(std::uint64_t number, const std::string& name);

std::string changed_event(const std::vector<std::string>& files);

// seconds_to_layer  from the beginning of the run; less than 0: none came
std::string end_event(std::uint64_t number, bool is_well,
                      double seconds_to_layer, double seconds);

}  // namespace lamina::studio
