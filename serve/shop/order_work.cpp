#include "serve/shop/order_work.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <signal.h>
#include <sys/resource.h>

#include "base/file/output_digest.h"
#include "base/file/output_file.h"
#include "base/fingerprint.h"
#include "base/paths.h"
#include "base/version.h"
#include "compiler/compile.h"
#include "compiler/look_at.h"
#include "compiler/stage_text.h"
#include "compiler/tasks/quote.h"
#include "compiler/tasks/viewer_options.h"
#include "serve/run/frames.h"
#include "serve/run/messages.h"
#include "slicer/formats/output_format.h"
#include "slicer/picture/image.h"
#include "slicer/picture/stack_picture.h"
#include "slicer/picture/viewer_page.h"

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;

// An answer is no longer than this: images of the largest panels have less.
constexpr rlim_t kMostBytes = 256 << 20;

void send_answer(int output, unsigned status, const Json& json) {
  serve::send_answer(output, {status, serve::text_of(json)});
}

void send_files(const compiler::Compilation& c, int output) {
  serve::send_files(output, compiler::files_read(c));
}

Json messages_of(const compiler::Compilation& c) {
  return serve::messages_json(c.diagnostics.all(),
                              folder_of(c.request.design.path));
}

std::string stem_of(const compiler::Compilation& c) {
  return std::filesystem::path(c.request.design.path).stem();
}

// The layers of the design. No value where it failed, or where warnings count
// as errors.
std::optional<compiler::Inspection> look(compiler::Compilation& c,
                                         const compiler::LookOptions& options) {
  auto inspection = compiler::look_at(c, options);
  if (!inspection || compiler::ends_strictly(c)) return std::nullopt;
  if (inspection->found.layers.empty()) {
    throw GeometryError("there is no contour");
  }
  return inspection;
}

std::string page_of(const compiler::Compilation& c,
                    const compiler::Inspection& inspection) {
  const std::string title =
      std::filesystem::path(c.request.design.path).filename();
  return slicer::viewer_page(inspection.layers,
                             compiler::viewer_options(c, inspection, title));
}

void write_picture(compiler::Compilation& c,
                   const compiler::Inspection& inspection) {
  slicer::StackOptions options;
  options.shows_all = options.centers = true;
  OutputFile output = OutputFile::open("-", c.temporary_files);
  slicer::write_png(slicer::draw_stack(inspection.layers, options), output);
  output.commit();
}

std::optional<std::string> make_quote(compiler::Compilation& c) {
  const auto inspection = look(c, {});
  if (!inspection) return std::nullopt;
  Json quote = compiler::quote_json(c, *inspection);
  quote["warnings"] = messages_of(c);
  return serve::text_of(quote);
}

// Makes the product into standard output; of a quote it returns the text. No
// value where that fails, which is reported.
std::optional<std::string> make_product(compiler::Compilation& c,
                                        Product product) {
  if (product == Product::kQuote) return make_quote(c);
  if (product == Product::kLayers) {
    c.request.output.path = "-";
    if (!compiler::compile(c)) return std::nullopt;
    return std::string();
  }
  const bool is_page = product == Product::kPage;
  const auto inspection = look(
      c, {.makes_graph = is_page, .keeps_layers = true, .keeps_colors = true});
  if (!inspection) return std::nullopt;
  if (is_page) {
    compiler::write_file("-", page_of(c, *inspection), c.temporary_files);
  } else {
    write_picture(c, *inspection);
  }
  return std::string();
}

// The type and the name of the answer.
Json head_of(const compiler::Compilation& c, const Job& job) {
  switch (job.product) {
    case Product::kQuote:
      return {{"type", "application/json"}, {"name", ""}};
    case Product::kLayers:
      return {{"type", "application/octet-stream"},
              {"name", stem_of(c) + "." + job.format}};
    case Product::kPage:
      return {{"type", "text/html; charset=utf-8"}, {"name", ""}};
    case Product::kPicture:
      break;
  }
  return {{"type", "image/png"}, {"name", ""}};
}

Job job_of(const serve::Command& command) {
  const std::size_t end = command.body.find('\n');
  return {static_cast<Product>(command.kind), command.body.substr(0, end),
          command.body.substr(end + 1)};
}

}  // namespace

serve::Command Job::command() const {
  return {static_cast<char>(product), format + '\n' + order};
}

OrderWork::OrderWork(compiler::Request base, serve::Names names,
                     std::string settings)
    : base_(std::move(base)),
      names_(std::move(names)),
      settings_(std::move(settings)) {}

void OrderWork::take_design(compiler::Compilation& design, int output) {
  begin_ = design.begin;
  // Where it could not be read, the second time says why.
  if (!design.is_read()) {
    serve::run_caught(design, [&] {
      compiler::read_design(design);
      return true;
    });
  }
  Json event;
  if (design.is_read()) {
    Json parameters = serve::parameters_of(design.design.program);
    offer_.emplace(parameters);
    event["parameters"] = std::move(parameters);
  } else {
    event["messages"] = messages_of(design);
  }
  send_files(design, output);
  serve::send_frame(output, serve::FrameKind::kEvent, serve::text_of(event));
}

void OrderWork::run(compiler::Compilation& design,
                    const serve::Command& command, int output) {
  const rlimit limit{kMostBytes, kMostBytes};
  ::setrlimit(RLIMIT_FSIZE, &limit);
  ::signal(SIGXFSZ, SIG_IGN);  // a write fails instead, which is reported
  const Job job = job_of(command);
  const Order order = read_order(job.order);
  compiler::Request request =
      request_of(order, offer_->check(order.values), base_, names_);
  if (job.product == Product::kLayers) {
    request.output.format = *slicer::choose_output_format(job.format).format;
  }
  request.job.finds_makers = job.product != Product::kLayers;
  serve::go_on_from_read(design, std::move(request), false,
                         [&](compiler::Compilation& compilation) {
                           make(compilation, job, order, output);
                         });
}

void OrderWork::make(compiler::Compilation& c, const Job& job,
                     const Order& order, int output) const {
  std::optional<std::string> text;
  const serve::Ending ending = serve::run_caught(c, [&] {
    text = make_product(c, job.product);
    return text.has_value();
  });
  send_files(c, output);
  if (ending != serve::Ending::kDone) {
    const unsigned status = ending == serve::Ending::kBroken ? 500 : 422;
    return send_answer(output, status, {{"messages", messages_of(c)}});
  }
  Json head = head_of(c, job);
  head["key"] = key_of(c, job, order);
  if (job.product == Product::kQuote) {
    serve::send_frame(output, serve::FrameKind::kEvent, *text);
  }
  send_answer(output, 200, head);
}

// Equal for two answers only where all that they depend on is. Empty where a
// file has changed since it was read, or may have.
std::string OrderWork::key_of(const compiler::Compilation& c, const Job& job,
                              const Order& order) const {
  std::vector<std::string> paths = compiler::files_read(c);
  std::ranges::sort(paths);
  const auto twice = std::ranges::unique(paths);
  paths.erase(twice.begin(), twice.end());
  std::string text =
      fmt::format("{}\n{}\n{}\n{}\n{}\n", version(), settings_,
                  static_cast<int>(job.product), job.format, order.canonical);
  for (const std::string& path : paths) {
    if (has_changed_since(begin_, path, c.file_access())) return {};
    const OpenFile file = c.file_access().open(path);
    const auto whole = file ? digest_of_file(file) : std::nullopt;
    text += fmt::format("{}\n{}\n", path, whole ? whole->digest : "");
  }
  return digest(text);
}

void OrderWork::report_fault(const serve::Command& /*command*/,
                             ChildFault fault, int output) {
  const bool is_ours = fault == ChildFault::kCrashed;
  const bool is_killed = fault == ChildFault::kKilled;
  const unsigned status = is_ours ? 500 : is_killed ? 503 : 422;
  const Diagnostic why{Severity::kError, {}, serve::words_of(fault)};
  send_answer(output, status, {{"messages", serve::messages_json({why}, "")}});
}

}  // namespace lamina::shop
