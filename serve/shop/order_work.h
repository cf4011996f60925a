#pragma once
// What the service does in the processes of a design: it makes what orders ask
// for.

#include <chrono>
#include <optional>
#include <string>

#include "compiler/request.h"
#include "serve/run/design_process.h"
#include "serve/run/names.h"
#include "serve/shop/offer.h"
#include "serve/shop/order.h"

namespace lamina::shop {

enum class Product : char { kQuote, kLayers, kPage, kPicture };

// What is made, as it goes to the processes.
struct Job {
  Product product = Product::kQuote;
  std::string format;  // of layers: an extension
  std::string order;   // JSON

  serve::Command command() const;
};

// Frames (serve/run/frames.h) of the design itself: kFiles, and kEvent with
// {"parameters": […]} as serve::parameters_of() lists them, or where it cannot
// be read {"messages": […]}.
//
// Frames of a run: kFiles; of a quote kEvent with its text, while other
// products go to standard output; and last, when all is there, kAnswer with
// "200 {…}" and
// {"type", "name", "key"}. Where it fails: "422 {"messages": […]}", 500 or 503.
class OrderWork : public serve::DesignWork {
 public:
  // base      of the service, with the design's path
  // settings  a text that says what `base` was asked for, for keys
  OrderWork(compiler::Request base, serve::Names names, std::string settings);

  void take_design(compiler::Compilation& design, int output) override;
  void run(compiler::Compilation& design, const serve::Command& command,
           int output) override;
  void report_fault(const serve::Command& command, ChildFault fault,
                    int output) override;

 private:
  void make(compiler::Compilation& compilation, const Job& job,
            const Order& order, int output) const;
  std::string key_of(const compiler::Compilation& compilation, const Job& job,
                     const Order& order) const;

  compiler::Request base_;
  serve::Names names_;
  std::string settings_;
  std::optional<Offer> offer_;  // of the design, if it could be read
  std::chrono::steady_clock::time_point begin_;  // of reading it
};

}  // namespace lamina::shop
