#pragma once
// The quote service: answers orders of designs (docs/serve.md).
//
// One thread takes requests and gives answers; what takes long is done in
// processes (designs.h). An order is judged as it comes: whether it is JSON,
// whether its design is there, whether the customizer offers its values. Then
// it gets an answer that is kept, or a worker, or a place in the queue, or,
// where all of these are taken, 503 at once.
//
//   order ─▶ judged ─▶ kept? ─▶ waits ─▶ runs ─▶ answered, and kept
//
// A worker is no process of its own but the right to have one: each order is a
// copy of its design's process.

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "base/file/open_file.h"
#include "base/file/temporary_files.h"
#include "serve/http/server.h"
#include "serve/run/design_process.h"
#include "serve/run/frames.h"
#include "serve/shop/answer_cache.h"
#include "serve/shop/designs.h"
#include "serve/shop/metrics.h"
#include "serve/shop/order_work.h"
#include "serve/shop/routes.h"

namespace lamina::shop {

struct ShopOptions {
  DesignOptions designs;
  std::size_t workers = 1;  // orders that run at once
  std::size_t queue = 64;   // orders that wait
};

class Shop {
 public:
  // Begins to read the first designs. All but `options` outlive the shop.
  // Throws FileError where files cannot be watched.
  Shop(ShopOptions options, http::Server& server,
       TemporaryFiles& temporary_files);
  Shop(const Shop&) = delete;
  Shop& operator=(const Shop&) = delete;

  void answer(const http::Request& request,
              const std::shared_ptr<http::Reply>& reply);

  // Takes no further connections, and stops the server when all orders are
  // answered, or after the time.
  void end(std::chrono::milliseconds most_time);

 private:
  using Clock = std::chrono::steady_clock;

  // An order from its arrival to its answer.
  struct Ticket {
    std::uint64_t number = 0;
    std::shared_ptr<http::Reply> reply;
    const Route* route = nullptr;
    std::string design;
    Job job;
    std::string asked;  // equal for orders that ask for the same
    std::string if_none_match;
    std::string peer;
    Clock::time_point begin;
    bool is_running = false;
    // While it runs.
    std::shared_ptr<serve::DesignProcess> process;
    serve::DesignProcess::Run run;
    OpenFile file;  // the bytes of products but quotes
    serve::FrameReader frames;
    std::string answer;  // "200 {…}"
    std::string body;    // of a quote
  };
  using Tickets = std::map<std::uint64_t, Ticket>;

  void answer_route(const Match& match, const http::Request& request,
                    const std::shared_ptr<http::Reply>& reply);
  void show_parameters(const Match& match,
                       const std::shared_ptr<http::Reply>& reply);
  void take_order(const Match& match, const http::Request& request,
                  const std::shared_ptr<http::Reply>& reply);
  void add_ticket(Ticket ticket);
  void judge(std::uint64_t number, const Order& order, ReadDesign* design);
  bool answer_from_cache(Ticket& ticket);
  void start_next();
  void start(Ticket& ticket);
  void run(Ticket& ticket, ReadDesign& design);
  void read_run(std::uint64_t number);
  void finish(Ticket& ticket);
  Answer take_answer(Ticket& ticket, const std::string& head);
  void give_up(std::uint64_t number);
  void end_ticket(Ticket& ticket, http::Response response);
  void forget(Tickets::iterator ticket);
  void send(http::Reply& reply, const Route* route, http::Response response);
  bool is_full() const {
    return tickets_.size() >= options_.queue + options_.workers;
  }
  std::string metrics() const;

  const ShopOptions options_;
  http::Server& server_;
  Metrics metrics_;
  AnswerCache cache_;
  Tickets tickets_;
  std::uint64_t last_ticket_ = 0;
  std::deque<std::uint64_t> queue_;
  std::size_t running_ = 0;
  std::map<std::string, std::size_t> tickets_of_peers_;
  std::size_t unread_ = 0;  // of the designs that were read at the start
  bool is_ending_ = false;
  Designs designs_;
};

}  // namespace lamina::shop
