#include "compiler/tasks/viewer_options.h"

#include <vector>

#include "base/paths.h"
#include "compiler/machine.h"
#include "compiler/source_lines.h"
#include "slicer/supports/support_contacts.h"

namespace lamina::compiler {
namespace {

std::vector<std::string> texts_from(const std::string& folder,
                                    const std::vector<SourceLines>& all) {
  std::vector<std::string> texts;
  for (const SourceLines& lines : all)
    texts.push_back(text_from(folder, lines));
  return texts;
}

}  // namespace

slicer::PrintEstimate estimate_of(const Compilation& compilation,
                                  const slicer::Inspection& found) {
  return slicer::estimate_print(
      compilation.report.machine, compilation.request.job.layer_thickness,
      found.layers.size(), found.volume,
      slicer::part_volume(found.volume, found.supports));
}

slicer::ViewerOptions viewer_options(const Compilation& compilation,
                                     const Inspection& inspection,
                                     const std::string& title) {
  const slicer::Inspection& found = inspection.found;
  slicer::ViewerOptions page;
  page.title = title;
  page.estimate = slicer::estimate_text(compilation.report.machine,
                                        estimate_of(compilation, found));
  page.min_feature = compilation.request.job.min_feature;
  page.features = found.features;
  const std::string folder = folder_of(compilation.request.design.path);
  page.source_lines = texts_from(folder, inspection.lines.features);
  page.print = found.print;
  page.finding_source_lines = texts_from(folder, inspection.lines.findings);
  if (found.supports) page.supports = size_text(*found.supports);
  return page;
}

}  // namespace lamina::compiler
