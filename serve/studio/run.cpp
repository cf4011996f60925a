#include "serve/studio/run.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <exception>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/paths.h"
#include "base/text.h"
#include "compiler/compile.h"
#include "compiler/look_at.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/viewer_options.h"
#include "serve/run/frames.h"
#include "serve/run/messages.h"
#include "serve/studio/source_text.h"
#include "slicer/picture/viewer_part.h"

namespace lamina::studio {
namespace {

using serve::FrameKind;
using serve::text_of;

constexpr double kStep = 1e-3;  // of coordinates on the wire [mm]

// Of the contours of a part: some 8 million corners. A window that takes none
// of it holds up as much as two of these (http::Limits::queued_bytes).
constexpr std::size_t kMostBytes = 16 << 20;

std::string messages_of(const compiler::Compilation& c) {
  return text_of(serve::messages_json(c.diagnostics.all(),
                                      folder_of(c.request.design.path)));
}

std::string title_of(const compiler::Compilation& c) {
  return std::filesystem::path(c.request.design.path).filename();
}

// Answers that the messages say why nothing could be made.
void send_messages(const compiler::Compilation& c, int output) {
  serve::send_answer(
      output, {422, fmt::format(R"({{"messages":{}}})", messages_of(c))});
}

class ShownChoice {
 public:
  ShownChoice(compiler::Compilation& c, const Choice& choice, const Form* form,
              int output)
      : c_(c), choice_(choice), form_(form), output_(output) {}

  void show() {
    const bool is_well =
        serve::run_caught(c_, [&] { return make(); }) == serve::Ending::kDone;
    send_files();
    send_messages();
    serve::send_frame(
        output_, FrameKind::kLast,
        end_event(choice_.number, is_well, seconds_to_layer_, seconds()));
  }

 private:
  bool make() {
    if (!c_.is_read()) compiler::read_design(c_);
    if (form_ != nullptr) {
      send_form(*form_);
    } else {
      send_form(form_of(c_.design.program, c_.request.design.path,
                        c_.file_access(), c_.diagnostics));
    }
    if (!compiler::make_tree(c_)) return false;
    send_files();
    send_messages();
    c_.report.machine =
        compiler::choose_machine(c_.request.output, c_.file_access());
    const csg::Lowered lowered = compiler::lower_tree(c_);
    const ldni::LayerGrid grid = compiler::plan(
        lowered, compiler::settings_of(c_.request, c_.report.machine));
    send_layer_in_view(lowered, grid);
    send_all(lowered, grid);
    return true;
  }

  void send_form(const Form& form) {
    if (form.key != choice_.form) send(form_event(choice_.number, form));
  }

  // The layer that the page shows now, before all others.
  void send_layer_in_view(const csg::Lowered& lowered,
                          const ldni::LayerGrid& grid) {
    const csg::Scene* scene = lowered.scene();
    if (scene == nullptr) return;
    slicer::Settings settings = settings_of(c_.request, c_.report.machine);
    settings.min_feature = 0;
    settings.finds_makers = false;
    const std::uint32_t count = grid.layer_count();
    if (count == 0) return;
    const double bottom = grid.layer_bottom(0);
    const double z =
        bottom + choice_.z.value_or((grid.layer_top(count - 1) - bottom) / 2);
    const std::uint32_t index = std::min(count - 1, grid.layers_below(z));
    // At the very height of the layer, it has the contours that it has among
    // all.
    settings.heights = {grid.section_z(index)};
    slicer::LayerList list;
    Diagnostics unshown;  // slicing all layers will say it
    slicer::slice(*scene, ldni::LayerGrid::at_heights(settings.heights),
                  settings, list, unshown);
    slicer::Layer& shown = list.layers.front();
    shown.bottom = grid.layer_bottom(index);
    shown.top = grid.layer_top(index);
    const Box2 box{Vec2(scene->box.low), Vec2(scene->box.high)};
    const slicer::ViewerLayer layer = slicer::viewer_layer(shown, box, kStep);
    seconds_to_layer_ = seconds();
    send(fmt::format(
        R"({{"kind":"layer","number":{},"index":{},"count":{},"bottom":{},)"
        R"("low":[{},{}],"high":[{},{}],"step":{},"row":{},"contours":"{}"}})",
        choice_.number, index, count, bottom, box.low.x, box.low.y, box.high.x,
        box.high.y, layer.step, layer.row, base64(layer.contours)));
  }

  void send_all(const csg::Lowered& lowered, const ldni::LayerGrid& grid) {
    const compiler::Inspection inspection = compiler::look_at_design(
        lowered, grid, c_.request, c_.report.machine,
        {.makes_graph = true, .keeps_layers = true, .keeps_colors = true},
        c_.on_progress, c_.diagnostics);
    slicer::ViewerOptions options =
        compiler::viewer_options(c_, inspection, title_of(c_));
    options.step = kStep;
    const slicer::ViewerPart part =
        slicer::viewer_part(inspection.layers, options);
    if (part.contours.size() / 3 * 4 + part.facts.size() > kMostBytes) {
      throw GeometryError(
          fmt::format("The layers are too many to show: {} MB, at most {}; "
                      "--layer makes them thicker",
                      part.contours.size() >> 20U, kMostBytes >> 20U));
    }
    send(fmt::format(
        R"({{"kind":"part","number":{},"facts":{},"contours":"{}"}})",
        choice_.number, part.facts, base64(part.contours)));
    send(report_event(choice_.number, c_, inspection.found));
  }

  void send_files() {
    std::vector<std::string> files = compiler::files_read(c_);
    files.push_back(sets_file(c_.request.design.path));
    serve::send_files(output_, files);
  }

  // All of them so far, where they are others than were sent.
  void send_messages() {
    std::string messages = messages_of(c_);
    if (messages == sent_messages_) return;
    send(messages_event(choice_.number, messages));
    sent_messages_ = std::move(messages);
  }

  void send(const std::string& event) {
    serve::send_frame(output_, FrameKind::kEvent, event);
  }

  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         begin_)
        .count();
  }

  compiler::Compilation& c_;
  const Choice& choice_;
  const Form* const form_;
  const int output_;
  const std::chrono::steady_clock::time_point begin_ =
      std::chrono::steady_clock::now();
  double seconds_to_layer_ = -1;
  std::string sent_messages_;
};

}  // namespace

void show_choice(compiler::Compilation& compilation, const Choice& choice,
                 const Form* form, int output) {
  ShownChoice(compilation, choice, form, output).show();
}

void write_output(compiler::Compilation& c, const Choice& choice, int output) {
  c.request.output.path = "-";
  if (serve::run_caught(c, [&] { return compiler::compile(c); }) !=
      serve::Ending::kDone) {
    send_messages(c, output);
    return;
  }
  const std::string stem = std::filesystem::path(c.request.design.path).stem();
  serve::send_answer(output,
                     {200, text_of({{"name", stem + "." + choice.format}})});
}

void write_source(compiler::Compilation& c, const Choice& choice, int output) {
  const std::string& path = c.request.design.path;
  const serve::Ending ending = serve::run_caught(c, [&] {
    if (!c.is_read()) compiler::read_design(c);
    const SourceEdit edit = edit_source(c.design.program, choice.values,
                                        c.design.language, c.diagnostics);
    if (choice.key.empty()) {
      serve::send_answer(
          output, {200, text_of({{"diff", edit.diff}, {"key", edit.key}})});
      return true;
    }
    // The file may have changed since it was read, or since it was shown.
    if (choice.key != edit.key || c.file_access().read(path) != edit.before) {
      serve::send_answer(output, {409, R"({"messages":[]})"});
      return true;
    }
    if (RunFiles* const files = c.file_access().run_files()) {
      files->begin_again(c.file_access());
    }
    compiler::write_file(path, edit.text, c.temporary_files);
    serve::send_answer(output, {200, text_of({{"written", title_of(c)}})});
    return true;
  });
  if (ending != serve::Ending::kDone) send_messages(c, output);
}

}  // namespace lamina::studio
