#include "compiler/compilation.h"

#include <algorithm>
#include <cstdint>

#include <fmt/format.h>

#include "base/file/module.h"
#include "base/paths.h"
#include "base/text.h"

namespace lamina::compiler {
namespace {

std::string place_of(const SourceRange& range) {
  if (!range.is_known()) return {};
  const LineColumn at = range.source->line_column(range.begin);
  return fmt::format("{}:{}:{}", on_one_line(shown_path(range.source->path())),
                     at.line, at.column);
}

FeatureOrigin origin_of(const csg::Instance& instance) {
  FeatureOrigin origin;
  origin.place = place_of(instance.range);
  for (const csg::CallSite* call = instance.caller; call != nullptr;
       call = call->caller) {
    origin.calls.push_back({std::string(call->name), place_of(call->range)});
  }
  return origin;
}

std::string text_of(const FeatureOrigin& origin) {
  if (origin.calls.empty()) return origin.place;
  return fmt::format("{} from {}", origin.place, origin.calls.back().place);
}

}  // namespace

std::vector<std::string> module_folders_of(const Request& request) {
  std::vector<std::string> folders = module_folders();
  if (!request.design.module_folder.empty()) {
    folders.insert(folders.begin(), request.design.module_folder);
  }
  return folders;
}

Compilation::Compilation(const Request& its_request, TemporaryFiles& files,
                         Diagnostics::Observer observer)
    : request(its_request),
      temporary_files(files),
      diagnostics(std::move(observer)),
      loader(sources, diagnostics, library_folders(files.file_access()),
             its_request.definitions, files.file_access()),
      typesetter(module_folders_of(its_request), diagnostics,
                 files.file_access()),
      cad_reader(module_folders_of(its_request), diagnostics) {
  diagnostics.set_hard_warnings(its_request.has_hard_warnings);
  if (request.design.language == "2026") loader.set_language(Language::k2026);
}

std::size_t Compilation::count(Severity severity) const {
  const std::vector<Diagnostic>& all = diagnostics.all();
  return static_cast<std::size_t>(std::count_if(
      all.begin(), all.end(),
      [&](const Diagnostic& d) { return d.severity == severity; }));
}

std::vector<FeatureOrigins> origins_of(
    const csg::Scene& scene, std::span<const slicer::ThinFeature> features) {
  std::vector<FeatureOrigins> all;
  for (const slicer::ThinFeature& feature : features) {
    FeatureOrigins& origins = all.emplace_back();
    // In the order of the design; kNoInstance comes last.
    const auto [first, second] =
        std::minmax(feature.instances[0], feature.instances[1]);
    for (const std::uint32_t instance : {first, second}) {
      if (instance == slicer::kNoInstance) continue;
      FeatureOrigin origin = origin_of(scene.instances[instance]);
      if (origins.empty() || text_of(origins[0]) != text_of(origin)) {
        origins.push_back(std::move(origin));
      }
    }
  }
  return all;
}

std::vector<FeatureOrigins> origins_of(
    const csg::Scene& scene, std::span<const slicer::Finding> findings) {
  std::vector<FeatureOrigins> all;
  for (const slicer::Finding& finding : findings) {
    FeatureOrigins& origins = all.emplace_back();
    if (finding.instance == slicer::kNoInstance) continue;
    origins.push_back(origin_of(scene.instances[finding.instance]));
  }
  return all;
}

std::vector<std::string> origin_texts(std::span<const FeatureOrigins> all) {
  std::vector<std::string> texts;
  for (const FeatureOrigins& origins : all) {
    std::string& text = texts.emplace_back();
    for (const FeatureOrigin& origin : origins) {
      if (!text.empty()) text += ", ";
      text += text_of(origin);
    }
  }
  return texts;
}

std::vector<std::string> files_read(const Compilation& c) {
  std::vector<std::string> files = c.loader.files();
  const auto add = [&](const std::vector<std::string>& more) {
    files.insert(files.end(), more.begin(), more.end());
  };
  add(c.tree.files);
  add(c.typesetter.files_read());
  // Printers and materials can be names too, which are no files then.
  const Request& request = c.request;
  for (const std::string& file :
       {request.design.parameter_file, request.output.printer,
        request.output.material}) {
    if (!file.empty()) files.push_back(file);
  }
  return files;
}

}  // namespace lamina::compiler
