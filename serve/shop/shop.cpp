#include "serve/shop/shop.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/mman.h>
#include <sys/stat.h>

#include "serve/run/messages.h"
#include "serve/run/pipe.h"
#include "serve/shop/openapi.h"
#include "serve/shop/order.h"
#include "serve/shop/problem.h"
#include "slicer/formats/output_format.h"

namespace lamina::shop {
namespace {

using http::content;
using http::Request;
using http::Response;
using Json = nlohmann::ordered_json;

// Of kept answers. Longer ones than the second are made again.
constexpr std::size_t kCacheBytes = 64 << 20;
constexpr std::size_t kMostKept = 256 << 10;

// Designs that are read at the start.
constexpr std::size_t kReadAtStart = 16;

// The share of the queue that one client may take.
constexpr std::size_t kPeerShare = 4;

constexpr std::string_view kUsualFormat = "slc";

// The page that is made is one file, with its scripts in it.
constexpr std::string_view kPagePolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src "
    "'unsafe-inline'; img-src data: blob:; worker-src blob:; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'self'";

constexpr const char* kOverloaded = "Too many orders are waiting.";
constexpr const char* kEnded = "The process of this order was ended.";

// Why a run has made nothing.
const char* words_of(unsigned status) {
  switch (status) {
    case 422:
      return "The design fails with these values.";
    case 500:
      return "This is a fault of lamina: please report it.";
    default:
      return kEnded;
  }
}

Response not_allowed(const Route& route) {
  Response response = problem(405, "There is another method for this.");
  response.headers.emplace_back(
      "Allow", route.takes_order() ? "GET, HEAD, POST" : "GET, HEAD");
  return response;
}

std::string quoted(const std::string& key) { return '"' + key + '"'; }

// Whether a list of If-None-Match has a key.
bool matches(const std::string& list, const std::string& key) {
  return !key.empty() && (list == "*" || list.find(quoted(key)) != list.npos);
}

// The answer, or that the client has it already.
Response response_of(const Route& route, const Answer& answer,
                     const std::string& if_none_match) {
  Response response;
  response.type = answer.type;
  response.headers.emplace_back("Cache-Control", "no-cache");
  if (!answer.key.empty()) {
    response.headers.emplace_back("ETag", quoted(answer.key));
  }
  if (matches(if_none_match, answer.key)) {
    response.status = 304;
    return response;
  }
  if (!answer.name.empty()) {
    response.headers.push_back(http::attachment(answer.name));
  }
  if (route.action == Action::kPage) {
    response.headers.emplace_back("Content-Security-Policy", kPagePolicy);
  }
  response.body = answer.body;
  return response;
}

Product product_of(Action action) {
  switch (action) {
    case Action::kLayers:
      return Product::kLayers;
    case Action::kPage:
      return Product::kPage;
    case Action::kPicture:
      return Product::kPicture;
    default:
      return Product::kQuote;
  }
}

// The format that the query asks for.
std::string format_of(const Route& route, const Request& request,
                      const std::vector<std::string>& formats) {
  if (!route.takes_format()) return {};
  std::string format = query_value(request.query, "format");
  if (format.empty()) format = kUsualFormat;
  if (std::ranges::find(formats, format) == formats.end()) {
    throw OrderError(fmt::format("there is no format '{}'", format));
  }
  return format;
}

std::string order_text(const Request& request) {
  if (request.method == "POST") return request.body;
  return order_of_query(request.query);
}

// Of the formats those of layers: texts of stages before are none of a shop's
// business.
ShopOptions with_layer_formats(ShopOptions options) {
  std::erase_if(options.designs.names.formats, [](const std::string& format) {
    return !slicer::is_of_layers(*slicer::choose_output_format(format).format);
  });
  return options;
}

}  // namespace

Shop::Shop(ShopOptions options, http::Server& server,
           TemporaryFiles& temporary_files)
    : options_(with_layer_formats(std::move(options))),
      server_(server),
      cache_(kCacheBytes),
      designs_(options_.designs, server, temporary_files,
               [this](const std::string& name) { cache_.drop(name); }) {
  std::vector<std::string> names = designs_.names();
  names.resize(std::min(names.size(), kReadAtStart));
  unread_ = names.size();
  for (const std::string& name : names) {
    designs_.read(name, [this](ReadDesign*) { --unread_; });
  }
  server_.on_refusal([this](unsigned status) { metrics_.count("", status); });
}

void Shop::answer(const Request& request,
                  const std::shared_ptr<http::Reply>& reply) {
  const Route* route = nullptr;
  try {
    const std::optional<Match> match = find_route(request.path);
    if (!match) {
      return send(*reply, nullptr, problem(404, "There is nothing here."));
    }
    route = match->route;
    if (request.method == "POST" && !route->takes_order()) {
      return send(*reply, route, not_allowed(*route));
    }
    answer_route(*match, request, reply);
  } catch (const MalformedOrder& error) {
    send(*reply, route, problem(400, error.diagnostic().message));
  } catch (const OrderError& error) {
    send(*reply, route, problem(422, error.diagnostic().message));
  } catch (const serve::NameError& error) {
    send(*reply, route, problem(422, error.diagnostic().message));
  } catch (const InternalError&) {
    send(*reply, route, problem(500, words_of(500)));
  } catch (const Error& error) {
    // The system grants no process, or no pipe to it.
    send(*reply, route, problem(503, error.diagnostic().message));
  } catch (const std::logic_error&) {
    // One order that meets a fault of ours is not to end the others.
    send(*reply, route, problem(500, words_of(500)));
  }
}

void Shop::answer_route(const Match& match, const Request& request,
                        const std::shared_ptr<http::Reply>& reply) {
  const Route& route = *match.route;
  if (route.has_name() && !designs_.has(match.name)) {
    return send(*reply, &route, problem(404, "There is no such design."));
  }
  switch (route.action) {
    case Action::kDesigns:
      return send(*reply, &route,
                  content(route.type, serve::text_of(Json(designs_.names()))));
    case Action::kParameters:
      return show_parameters(match, reply);
    case Action::kDescription:
      return send(*reply, &route,
                  content(route.type, openapi(options_.designs.names.formats)));
    case Action::kHealth:
      return send(*reply, &route, content(route.type, "alive\n"));
    case Action::kReady:
      return send(*reply, &route,
                  unread_ > 0 || is_ending_ || is_full()
                      ? problem(503, "No orders are taken now.")
                      : content(route.type, "ready\n"));
    case Action::kMetrics:
      return send(*reply, &route, content(route.type, metrics()));
    default:
      return take_order(match, request, reply);
  }
}

void Shop::show_parameters(const Match& match,
                           const std::shared_ptr<http::Reply>& reply) {
  designs_.read(match.name, [this, match, reply](ReadDesign* design) {
    const Route& route = *match.route;
    if (design == nullptr) return send(*reply, &route, problem(503, kEnded));
    if (!design->offer) {
      return send(*reply, &route,
                  problem(422, "The design cannot be read.", design->messages));
    }
    send(
        *reply, &route,
        content(route.type, serve::text_of(design->offer->schema(match.name))));
  });
}

void Shop::take_order(const Match& match, const Request& request,
                      const std::shared_ptr<http::Reply>& reply) {
  const Route& route = *match.route;
  if (request.method == "POST" && request.content_type != "application/json") {
    return send(*reply, &route,
                problem(415, "The body must be application/json."));
  }
  const serve::Names& names = options_.designs.names;
  Ticket ticket{
      .number = ++last_ticket_,
      .reply = reply,
      .route = &route,
      .design = match.name,
      .job = {.product = product_of(route.action),
              .format = format_of(route, request, names.formats),
              .order = order_text(request)},
      .asked = {},
      .if_none_match = request.method == "GET" ? request.if_none_match : "",
      .peer = request.peer,
      .begin = Clock::now(),
      .is_running = false,
      .process = nullptr,
      .run = {},
      .file = OpenFile(),
      .frames = {},
      .answer = {},
      .body = {}};
  const Order order = read_order(ticket.job.order);
  request_of(order, {}, options_.designs.request, names);  // throws
  ticket.asked =
      fmt::format("{} {} {}", route.name, ticket.job.format, order.canonical);
  const std::size_t most = options_.queue / kPeerShare + options_.workers;
  if (tickets_of_peers_[ticket.peer] >= most) {
    return send(*reply, &route,
                problem(429, "Too many orders of this client are waiting."));
  }
  if (is_full()) {
    return send(*reply, &route, problem(503, kOverloaded));
  }
  const std::uint64_t number = ticket.number;
  const std::string design = ticket.design;
  add_ticket(std::move(ticket));
  try {
    designs_.read(design, [this, number, order](ReadDesign* read) {
      judge(number, order, read);
    });
  } catch (const Error&) {
    forget(tickets_.find(number));
    throw;
  }
}

void Shop::add_ticket(Ticket ticket) {
  const std::uint64_t number = ticket.number;
  ++tickets_of_peers_[ticket.peer];
  const auto reply = ticket.reply;
  tickets_.emplace(number, std::move(ticket));
  reply->on_close([this, number] { give_up(number); });
}

// Judges an order by what its design offers, and finds its answer or queues it.
void Shop::judge(std::uint64_t number, const Order& order, ReadDesign* design) {
  const auto found = tickets_.find(number);
  if (found == tickets_.end()) return;
  Ticket& ticket = found->second;
  if (design == nullptr) return end_ticket(ticket, problem(503, kEnded));
  if (!design->offer) {
    return end_ticket(
        ticket, problem(422, "The design cannot be read.", design->messages));
  }
  try {
    design->offer->check(order.values);
  } catch (const OrderError& error) {
    return end_ticket(ticket, problem(422, error.diagnostic().message));
  }
  if (answer_from_cache(ticket)) return;
  queue_.push_back(number);
  start_next();
}

// Of a long answer only its key is kept.
bool Shop::answer_from_cache(Ticket& ticket) {
  const Answer* const answer = cache_.find(ticket.design, ticket.asked);
  const bool is_known =
      answer != nullptr &&
      (answer->has_body || matches(ticket.if_none_match, answer->key));
  metrics_.count_cache(is_known);
  if (!is_known) return false;
  end_ticket(ticket, response_of(*ticket.route, *answer, ticket.if_none_match));
  return true;
}

void Shop::start_next() {
  while (running_ < options_.workers && !queue_.empty()) {
    const auto found = tickets_.find(queue_.front());
    queue_.pop_front();
    if (found != tickets_.end()) start(found->second);
  }
}

void Shop::start(Ticket& ticket) {
  ++running_;
  ticket.is_running = true;
  const std::uint64_t number = ticket.number;
  try {
    // Nearly always it has been read.
    designs_.read(ticket.design, [this, number](ReadDesign* design) {
      const auto found = tickets_.find(number);
      if (found == tickets_.end()) return;
      if (design == nullptr) {
        return end_ticket(found->second, problem(503, kEnded));
      }
      run(found->second, *design);
    });
  } catch (const Error& error) {
    end_ticket(ticket, problem(503, error.diagnostic().message));
  }
}

void Shop::run(Ticket& ticket, ReadDesign& design) {
  if (ticket.job.product != Product::kQuote) {
    ticket.file = OpenFile(::memfd_create("answer", MFD_CLOEXEC));
  }
  ticket.process = design.process;
  ticket.run =
      design.process->start(ticket.job.command(), ticket.file.descriptor());
  if (!ticket.run.output) {
    designs_.give_up(ticket.design);
    return end_ticket(ticket, problem(503, kEnded));
  }
  const std::uint64_t number = ticket.number;
  server_.on_readable(ticket.run.output.descriptor(),
                      [this, number] { read_run(number); });
}

void Shop::read_run(std::uint64_t number) {
  const auto found = tickets_.find(number);
  if (found == tickets_.end()) return;
  Ticket& ticket = found->second;
  const auto bytes = serve::read_some(ticket.run.output.descriptor());
  if (!bytes) return;
  if (bytes->empty()) return finish(ticket);
  ticket.frames.add(*bytes, [&](serve::FrameKind kind, std::string frame) {
    if (kind == serve::FrameKind::kFiles) {
      designs_.add_files(ticket.design, frame);
    } else if (kind == serve::FrameKind::kAnswer) {
      ticket.answer = std::move(frame);
    } else {
      ticket.body = std::move(frame);
    }
  });
}

void Shop::finish(Ticket& ticket) {
  if (ticket.answer.empty()) {
    metrics_.count_ended("lost");
    return end_ticket(ticket, problem(503, kEnded));
  }
  const auto [status, head] = serve::read_answer(ticket.answer);
  if (status != 200) {
    if (status != 422) metrics_.count_ended(status == 500 ? "crash" : "kill");
    return end_ticket(ticket, problem(status, words_of(status),
                                      Json::parse(head)["messages"]));
  }
  const Answer answer = take_answer(ticket, head);
  Response response = response_of(*ticket.route, answer, ticket.if_none_match);
  if (!answer.has_body && response.status == 200) {
    response.file = fmt::format("/proc/self/fd/{}", ticket.file.descriptor());
  }
  metrics_.time(
      ticket.route->name,
      std::chrono::duration<double>(Clock::now() - ticket.begin).count());
  if (!answer.key.empty()) cache_.keep(ticket.design, ticket.asked, answer);
  end_ticket(ticket, std::move(response));
}

// head  of the run's answer
Answer Shop::take_answer(Ticket& ticket, const std::string& head) {
  const Json json = Json::parse(head);
  Answer answer{.type = json["type"],
                .name = json["name"],
                .key = json["key"],
                .body = std::move(ticket.body),
                .has_body = true};
  if (!ticket.file) return answer;
  struct stat status {};
  ::fstat(ticket.file.descriptor(), &status);
  answer.has_body = static_cast<std::size_t>(status.st_size) <= kMostKept;
  if (answer.has_body) {
    answer.body =
        ticket.file.read_at(0, static_cast<std::size_t>(status.st_size))
            .value_or("");
  }
  return answer;
}

// The client has gone, or has had its answer.
void Shop::give_up(std::uint64_t number) {
  const auto found = tickets_.find(number);
  if (found == tickets_.end()) return;
  forget(found);
  start_next();
}

void Shop::end_ticket(Ticket& ticket, Response response) {
  const auto reply = ticket.reply;
  const Route* const route = ticket.route;
  send(*reply, route, std::move(response));
  forget(tickets_.find(ticket.number));
  start_next();
}

void Shop::forget(Tickets::iterator found) {
  Ticket& ticket = found->second;
  const auto peer = tickets_of_peers_.find(ticket.peer);
  if (--peer->second == 0) tickets_of_peers_.erase(peer);
  if (ticket.run.output) {
    server_.forget(ticket.run.output.descriptor());
    ticket.process->end(ticket.run.number);
  }
  if (ticket.is_running) --running_;
  std::erase(queue_, ticket.number);
  tickets_.erase(found);
}

void Shop::send(http::Reply& reply, const Route* route, Response response) {
  metrics_.count(route == nullptr ? "" : route->name, response.status);
  reply.send(std::move(response));
}

std::string Shop::metrics() const {
  return metrics_.text({.workers = options_.workers,
                        .running = running_,
                        .waiting = tickets_.size() - running_,
                        .designs = designs_.size(),
                        .cache_bytes = cache_.bytes()});
}

void Shop::end(std::chrono::milliseconds most_time) {
  is_ending_ = true;
  server_.stop_listening([this] { server_.stop(); });
  server_.after(most_time, [this] { server_.stop(); });
}

}  // namespace lamina::shop
