// The module lamina_http.so: connections, by Boost.Beast and Boost.Asio.
//
// A connection is in one state at a time:
//
//    kHead ──▶ kBody ──▶ kAnswering ──▶ kHead          (the next request)
//      │         │           ├───▶ kStreaming          (begin())
//      └─────────┴───────────┴───────────┴──▶ kLingering ──▶ kClosed
//
// Memory has a bound: a connection reads a head up to its limit and judges it
// before it reads the body; while an answer is under way it reads nothing. One
// timer for each connection covers the state that it is in.
//
// To close a connection while bytes of the peer are unread would reset it, and
// the peer might lose the answer. So the server ends its own side, drops what
// comes for a moment (kLingering), and closes then.

#include <algorithm>
#include <array>
#include <cerrno>
#include <deque>
#include <exception>
#include <map>
#include <memory>
#include <new>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <boost/asio/basic_socket_acceptor.hpp>
#include <boost/asio/generic/stream_protocol.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http/empty_body.hpp>
#include <boost/beast/http/file_body.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/serializer.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <fcntl.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "serve/http/detail/engine.h"
#include "serve/http/detail/rules.h"

namespace lamina::http {
namespace {

namespace net = boost::asio;
namespace bh = boost::beast::http;
using boost::beast::file_mode;
// TCP and Unix sockets alike.
using Stream = net::generic::stream_protocol;
using Acceptor = net::basic_socket_acceptor<Stream>;
using Error = boost::system::error_code;
using std::chrono::milliseconds;

// How long a peer may send on after the last answer.
constexpr milliseconds kLingerTime{2000};

// How long to wait where no connection can be accepted (no descriptor is free).
constexpr milliseconds kAcceptPause{100};

class Connection;

// What connections share.
class Hub {
 public:
  virtual ~Hub() = default;
  virtual const Limits& limits() const = 0;
  virtual const Rules& rules() const = 0;
  virtual const Policy& policy() const = 0;
  // Whether each connection ends with the answer that is under way.
  virtual bool is_ending() const = 0;
  // An answer is the server's own.
  virtual void report_refusal(unsigned status) = 0;
  virtual void handle(const Request& request,
                      std::unique_ptr<Answer> answer) = 0;
  // Makes a call from run(), not from within another.
  virtual void post(std::function<void()> call) = 0;
  virtual void remove(const std::shared_ptr<Connection>& connection) = 0;
  // There is no memory: run() ends.
  virtual void fail() noexcept = 0;
};

Refusal refusal_of(const Error& error) {
  if (error == bh::error::body_limit) return {413, "The body is too long"};
  return {400, "This is not HTTP/1.1"};
}

template <typename Fields>
Head head_of(const Fields& message, std::string_view bytes) {
  Head head;
  head.bytes = bytes;
  head.method = message.method_string();
  head.target = message.target();
  head.version = message.version();
  for (const auto& field : message) {
    head.fields.emplace_back(field.name_string(), field.value());
  }
  return head;
}

bool may_have_body(unsigned status) { return status != 204 && status != 304; }

class Connection : public std::enable_shared_from_this<Connection> {
 public:
  // host  the IP address at the other end; empty for a Unix socket
  Connection(Hub& hub, Stream::socket socket, std::string host)
      : hub_(&hub),
        limits_(hub.limits()),
        wire_(std::move(socket)),
        host_(std::move(host)) {}

  void start() {
    arm(limits_.header_time);
    take_request();
  }

  bool is_open() const { return wire_.has_value(); }

  void send(Response response) {
    if (!is_open()) return;
    if (!is_sendable(response)) {
      return send_own({500, "The answer cannot be sent"});
    }
    if (hub_->is_ending()) keeps_alive_ = false;
    if (!response.file.empty()) return send_file(response);
    const std::size_t size = response.body.size();
    if (is_head_ || !may_have_body(response.status)) {
      auto message = message_of<bh::empty_body>(response);
      if (may_have_body(response.status)) message.content_length(size);
      return write(std::move(message));
    }
    auto message = message_of<bh::string_body>(response);
    message.body() = std::move(response.body);
    message.content_length(size);
    write(std::move(message));
  }

  // An answer of the server's own, not of the handler.
  void send_own(const Refusal& refusal) {
    if (!is_open()) return;
    hub_->report_refusal(refusal.status);
    send(refusal_response(refusal, hub_->policy()));
  }

  void begin(const Response& response) {
    if (!is_open()) return;
    if (!is_sendable(response)) {
      return send_own({500, "The answer cannot be sent"});
    }
    keeps_alive_ = false;
    auto message = message_of<bh::empty_body>(response);
    // A HEAD has its answer with that.
    if (!is_head_) {
      state_ = State::kStreaming;
      is_writing_ = true;
    }
    write(std::move(message));
  }

  void write_more(std::string bytes) {
    if (state_ != State::kStreaming || is_ending_) return;
    queued_ += bytes.size();
    if (queued_ > limits_.queued_bytes) return close();
    queue_.push_back(std::move(bytes));
    if (!is_writing_) flush();
  }

  // Ends an answer that has begun.
  void end_stream() {
    if (state_ != State::kStreaming) return;
    is_ending_ = true;
    if (!is_writing_) flush();
  }

  // While it is open.
  void on_close(std::function<void()> call) {
    closings_.push_back(std::move(call));
  }

  void close() {
    if (!is_open()) return;
    const auto self = shared_from_this();
    ++deadline_;
    // Children that were forked meanwhile may have copies of the descriptor.
    // release() takes it out of the reactor, and shutdown() ends the connection
    // for all copies.
    Error ignored;
    const int descriptor = wire_->socket.release(ignored);
    ::shutdown(descriptor, SHUT_RDWR);
    ::close(descriptor);
    wire_.reset();
    state_ = State::kClosed;
    input_.clear();
    queue_.clear();
    for (auto& call : std::exchange(closings_, {})) {
      hub_->post(std::move(call));
    }
    std::exchange(hub_, nullptr)->remove(self);
  }

  // Closes, if no request has begun.
  void close_if_idle() {
    if (state_ != State::kHead || !input_.empty()) return;
    if (!has_input()) close();
  }

  // Closes, as the server goes: makes no call.
  void abandon() {
    closings_.clear();
    close();
  }

  void fail() noexcept {
    if (hub_ != nullptr) hub_->fail();
  }

 private:
  enum class State {
    kHead,
    kBody,
    kAnswering,
    kStreaming,
    kLingering,
    kClosed
  };

  // What a connection has while it is open.
  struct Wire {
    explicit Wire(Stream::socket open)
        : socket(std::move(open)), timer(socket.get_executor()) {}
    Stream::socket socket;
    net::steady_timer timer;
  };

  template <typename Body>
  struct Outgoing {
    explicit Outgoing(bh::response<Body> whole)
        : message(std::move(whole)), serializer(message) {}
    bh::response<Body> message;
    bh::response_serializer<Body> serializer;
  };

  // --- Time -----------------------------------------------------------------

  void arm(milliseconds time) {
    const std::uint64_t number = ++deadline_;
    wire_->timer.expires_after(time);
    wire_->timer.async_wait(
        [self = shared_from_this(), number](const Error& error) {
          if (!error && number == self->deadline_) self->time_out();
        });
  }

  void disarm() {
    ++deadline_;
    wire_->timer.cancel();
  }

  void time_out() {
    const bool is_request =
        state_ == State::kBody || (state_ == State::kHead && !input_.empty());
    if (!is_request) return close();
    // Of two reads that wait, the reactor may forget the second.
    Error ignored;
    wire_->socket.cancel(ignored);
    refuse({408, "The request takes too long"});
  }

  // --- Requests -------------------------------------------------------------

  // Takes the next one, of which some may have come already.
  void take_request() {
    state_ = State::kHead;
    closings_.clear();
    parser_.emplace();
    parser_->header_limit(static_cast<std::uint32_t>(limits_.header_bytes));
    parser_->body_limit(limits_.body_bytes);
    parsed_ = 0;
    is_head_ = false;
    if (input_.empty()) {
      read_more(limits_.header_bytes, &Connection::take_head);
    } else {
      take_head();
    }
  }

  void take_head() {
    if (const auto refusal = hub_->rules().judge_line(input_)) {
      return refuse(*refusal);
    }
    Error error;
    parsed_ += parser_->put(
        net::buffer(input_.data() + parsed_, input_.size() - parsed_), error);
    if (parser_->is_header_done() && !error) return take_whole_head();
    if (const auto refusal = hub_->rules().judge_length(input_)) {
      return refuse(*refusal);
    }
    if (error && error != bh::error::need_more) {
      return refuse(refusal_of(error));
    }
    if (std::exchange(is_idle_, false)) arm(limits_.header_time);
    read_more(limits_.header_bytes - input_.size(), &Connection::take_head);
  }

  void take_whole_head() {
    const Head head =
        head_of(parser_->get(), std::string_view(input_).substr(0, parsed_));
    is_head_ = head.method == "HEAD";
    if (const auto refusal = hub_->rules().judge(head)) return refuse(*refusal);
    request_ = request_of(head, host_);
    keeps_alive_ = parser_->keep_alive();
    is_old_ = head.version == 10;
    body_size_ = parser_->content_length().value_or(0);
    input_.erase(0, parsed_);
    state_ = State::kBody;
    is_idle_ = false;
    // A body that has come needs no time.
    if (input_.size() < body_size_) arm(limits_.body_time);
    take_body();
  }

  void take_body() {
    const std::size_t size =
        std::min(input_.size(), body_size_ - request_.body.size());
    request_.body.append(input_, 0, size);
    input_.erase(0, size);
    const std::size_t missing = body_size_ - request_.body.size();
    if (missing > 0) return read_more(missing, &Connection::take_body);
    disarm();
    hand_over();
  }

  void read_more(std::size_t most, void (Connection::*next)()) {
    const State state = state_;
    wire_->socket.async_read_some(
        net::buffer(chunk_, most), [self = shared_from_this(), state, next](
                                       const Error& error, std::size_t size) {
          // It may have been refused meanwhile.
          if (self->state_ != state) return;
          if (error) return self->close();
          self->input_.append(self->chunk_.data(), size);
          (self.get()->*next)();
        });
  }

  void hand_over();

  // Looks for the peer's end while nothing is read.
  void watch_peer() {
    if (is_watching_ || !is_open()) return;
    is_watching_ = true;
    wire_->socket.async_wait(Stream::socket::wait_read,
                             [self = shared_from_this()](const Error& error) {
                               self->is_watching_ = false;
                               if (!error) self->look_at_peer();
                             });
  }

  // The error is would_block where nothing has come.
  Error peek() {
    std::array<char, 1> byte{};
    Error error;
    wire_->socket.receive(net::buffer(byte), Stream::socket::message_peek,
                          error);
    return error;
  }

  bool has_input() { return !peek(); }

  void look_at_peer() {
    if (state_ != State::kAnswering && state_ != State::kStreaming) return;
    const Error error = peek();
    if (error == net::error::would_block) return watch_peer();
    // A next request can wait, but not behind a stream.
    if (error || state_ == State::kStreaming) close();
  }

  // --- Answers --------------------------------------------------------------

  void refuse(const Refusal& refusal) {
    state_ = State::kAnswering;
    keeps_alive_ = false;
    send_own(refusal);
  }

  void send_file(const Response& response) {
    bh::file_body::value_type file;
    Error error;
    file.open(response.file.c_str(), file_mode::scan, error);
    if (error) return send_own({404, "The file is gone"});
    const std::uint64_t size = file.size();
    if (is_head_) {
      auto message = message_of<bh::empty_body>(response);
      message.content_length(size);
      return write(std::move(message));
    }
    auto message = message_of<bh::file_body>(response);
    message.body() = std::move(file);
    message.content_length(size);
    write(std::move(message));
  }

  // The head of an answer. What the server itself says of it counts.
  template <typename Body>
  bh::response<Body> message_of(const Response& response) const {
    bh::response<Body> message;
    message.version(11);
    message.result(response.status);
    for (const auto& [name, value] : response.headers) {
      message.insert(name, value);
    }
    message.erase(bh::field::transfer_encoding);
    message.erase(bh::field::content_length);
    message.erase(bh::field::connection);
    message.keep_alive(keeps_alive_);
    if (keeps_alive_ && is_old_) {
      message.set(bh::field::connection, "keep-alive");
    }
    message.set(bh::field::content_type, response.type);
    // What is not modified keeps its type.
    if (response.status == 304) message.erase(bh::field::content_type);
    for (const auto& [name, value] : headers_of_all()) {
      if (message.find(name) == message.end()) message.set(name, value);
    }
    return message;
  }

  template <typename Body>
  void write(bh::response<Body> message) {
    write_some(std::make_shared<Outgoing<Body>>(std::move(message)));
  }

  template <typename Body>
  void write_some(std::shared_ptr<Outgoing<Body>> outgoing) {
    arm(limits_.idle_time);
    auto& serializer = outgoing->serializer;
    bh::async_write_some(
        wire_->socket, serializer,
        [self = shared_from_this(), outgoing = std::move(outgoing)](
            const Error& error, std::size_t) mutable {
          if (!self->is_open()) return;
          if (error) return self->close();
          if (outgoing->serializer.is_done()) return self->finish_write();
          self->write_some(std::move(outgoing));
        });
  }

  void finish_write() {
    disarm();
    if (state_ == State::kStreaming) return flush();
    if (!keeps_alive_ || hub_->is_ending()) return linger();
    is_idle_ = true;
    arm(limits_.idle_time);
    take_request();
  }

  // Writes what is queued.
  void flush() {
    is_writing_ = !queue_.empty();
    if (!is_writing_) {
      disarm();
      return is_ending_ ? linger() : watch_peer();
    }
    arm(limits_.idle_time);
    wire_->socket.async_write_some(
        net::buffer(queue_.front().data() + written_,
                    queue_.front().size() - written_),
        [self = shared_from_this()](const Error& error, std::size_t size) {
          if (!self->is_open()) return;
          if (error) return self->close();
          self->drop_written(size);
          self->flush();
        });
  }

  void drop_written(std::size_t size) {
    written_ += size;
    queued_ -= size;
    if (written_ < queue_.front().size()) return;
    queue_.pop_front();
    written_ = 0;
  }

  // --- The end --------------------------------------------------------------

  void linger() {
    state_ = State::kLingering;
    Error ignored;
    wire_->socket.shutdown(Stream::socket::shutdown_send, ignored);
    arm(kLingerTime);
    drop_input();
  }

  void drop_input() {
    wire_->socket.async_read_some(
        net::buffer(chunk_),
        [self = shared_from_this()](const Error& error, std::size_t) {
          if (!self->is_open()) return;
          if (error) return self->close();
          self->drop_input();
        });
  }

  Hub* hub_;  // null once it is closed
  const Limits limits_;
  std::optional<Wire> wire_;  // none once it is closed
  const std::string host_;
  State state_ = State::kHead;
  std::uint64_t deadline_ = 0;  // number of the timer's wait that counts
  bool is_idle_ = false;        // between two requests
  bool is_watching_ = false;

  // The request. No more has been read than its limits allow.
  std::array<char, 4096> chunk_{};
  std::string input_;
  std::optional<bh::request_parser<bh::empty_body>> parser_;
  std::size_t parsed_ = 0;  // bytes of the input
  Request request_;
  std::size_t body_size_ = 0;

  // The answer.
  bool is_head_ = false;  // to HEAD
  bool keeps_alive_ = false;
  bool is_old_ = false;  // HTTP/1.0, which ends connections
  std::deque<std::string> queue_;
  std::size_t queued_ = 0;   // bytes
  std::size_t written_ = 0;  // of the first
  bool is_writing_ = false;
  bool is_ending_ = false;
  std::vector<std::function<void()>> closings_;
};

class ConnectionAnswer final : public Answer {
 public:
  explicit ConnectionAnswer(std::shared_ptr<Connection> connection)
      : connection_(std::move(connection)) {}
  ~ConnectionAnswer() override {
    if (has_begun_) guard([&] { connection_->end_stream(); });
    if (is_answered_) return;
    guard([&] { connection_->send_own({500, "There is no answer"}); });
  }
  ConnectionAnswer(const ConnectionAnswer&) = delete;
  ConnectionAnswer& operator=(const ConnectionAnswer&) = delete;

  void send(Response response) noexcept override {
    if (std::exchange(is_answered_, true)) return;
    guard([&] { connection_->send(std::move(response)); });
  }
  void begin(Response response) noexcept override {
    if (std::exchange(is_answered_, true)) return;
    has_begun_ = true;
    guard([&] { connection_->begin(response); });
  }
  void write(std::string bytes) noexcept override {
    if (!has_begun_) return;
    guard([&] { connection_->write_more(std::move(bytes)); });
  }
  bool is_open() const noexcept override { return connection_->is_open(); }
  void on_close(std::function<void()> call) noexcept override {
    if (!is_open()) return;
    guard([&] { connection_->on_close(std::move(call)); });
  }

 private:
  template <typename Work>
  void guard(const Work& work) noexcept {
    try {
      work();
    } catch (...) {
      connection_->fail();
    }
  }

  std::shared_ptr<Connection> connection_;
  bool is_answered_ = false;
  bool has_begun_ = false;
};

void Connection::hand_over() {
  state_ = State::kAnswering;
  const Request request = std::exchange(request_, {});
  hub_->handle(request, std::make_unique<ConnectionAnswer>(shared_from_this()));
  watch_peer();
}

// Programs that are run meanwhile do not get the descriptor.
void keep_from_programs(int descriptor) {
  ::fcntl(descriptor, F_SETFD, FD_CLOEXEC);
}

// The IP address; empty for a Unix socket.
std::string host_of(const Stream::endpoint& endpoint) {
  const sockaddr* const address = endpoint.data();
  if (address->sa_family == AF_INET) {
    const auto& four = reinterpret_cast<const sockaddr_in&>(*address);
    return net::ip::address_v4(ntohl(four.sin_addr.s_addr)).to_string();
  }
  if (address->sa_family != AF_INET6) return "";
  const auto& six = reinterpret_cast<const sockaddr_in6&>(*address);
  net::ip::address_v6::bytes_type bytes{};
  std::copy_n(six.sin6_addr.s6_addr, bytes.size(), bytes.begin());
  const net::ip::address_v6 whole(bytes);
  // A socket for IPv6 takes IPv4, too.
  return whole.is_v4_mapped()
             ? net::ip::make_address_v4(net::ip::v4_mapped, whole).to_string()
             : whole.to_string();
}

// A descriptor of the program's.
struct Watch {
  explicit Watch(net::io_context& context) : descriptor(context) {}
  ~Watch() {
    if (descriptor.is_open()) descriptor.release();
  }
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  static void wait(const std::shared_ptr<Watch>& watch) {
    watch->descriptor.async_wait(net::posix::stream_descriptor::wait_read,
                                 [watch](const Error& error) {
                                   if (error) return;
                                   if (!watch->descriptor.is_open()) return;
                                   watch->call();
                                   if (watch->descriptor.is_open()) wait(watch);
                                 });
  }

  net::posix::stream_descriptor descriptor;
  std::function<void()> call;
};

class BeastEngine final : public Engine, private Hub {
 public:
  BeastEngine(const Limits& limits, const Policy& policy)
      : limits_(limits), policy_(policy), rules_(limits, policy, {}) {}

  ~BeastEngine() override {
    guard([&] { close(); });
  }
  BeastEngine(const BeastEngine&) = delete;
  BeastEngine& operator=(const BeastEngine&) = delete;

  int listen(int descriptor, const Address& own) noexcept override {
    return guard([&] {
      acceptor_.assign(Stream(family_of(own), 0), descriptor);
      rules_ = Rules(limits_, policy_, own);
      accept();
    });
  }

  int stop_listening(std::function<void()> call) noexcept override {
    return guard([&] {
      on_end_ = std::move(call);
      is_ending_ = true;
      close_listener();
      const auto connections = connections_;
      for (const auto& connection : connections) connection->close_if_idle();
      if (connections.empty()) post(std::exchange(on_end_, {}));
    });
  }

  void on_refusal(std::function<void(unsigned)> call) noexcept override {
    on_refusal_ = std::move(call);
  }

  int on_readable(int descriptor,
                  std::function<void()> call) noexcept override {
    return guard([&] {
      const auto watch = std::make_shared<Watch>(context_);
      watch->call = std::move(call);
      watch->descriptor.assign(descriptor);
      watch->descriptor.non_blocking(true);
      watches_[descriptor] = watch;
      Watch::wait(watch);
    });
  }

  void forget(int descriptor) noexcept override {
    const auto found = watches_.find(descriptor);
    if (found == watches_.end()) return;
    found->second->descriptor.release();
    watches_.erase(found);
  }

  int after(milliseconds time, std::function<void()> call) noexcept override {
    return guard([&] {
      const auto timer = std::make_shared<net::steady_timer>(context_, time);
      timer->async_wait([timer, call = std::move(call)](const Error& error) {
        if (!error) call();
      });
    });
  }

  int run(const AnswerHandler& handler) noexcept override {
    has_failed_ = false;
    handler_ = &handler;
    const int error = guard([&] {
      context_.restart();
      context_.run();
    });
    return has_failed_ ? ENOMEM : error;
  }

  void stop() noexcept override { context_.stop(); }

 private:
  // Does it, and returns the errno of what it throws.
  template <typename Work>
  static int guard(const Work& work) noexcept {
    try {
      work();
      return 0;
    } catch (const std::bad_alloc&) {
      return ENOMEM;
    } catch (const boost::system::system_error& error) {
      return error.code().value();
    } catch (...) {
      return EIO;
    }
  }

  void close() {
    for (const auto& connection : std::exchange(connections_, {})) {
      connection->abandon();
    }
    for (auto& [descriptor, watch] : watches_) watch->descriptor.release();
    close_listener();
  }

  // As Connection::close(): children that were forked meanwhile would go on
  // listening.
  void close_listener() {
    pause_.cancel();
    if (!acceptor_.is_open()) return;
    const int descriptor = acceptor_.release();
    ::shutdown(descriptor, SHUT_RDWR);
    ::close(descriptor);
  }

  static int family_of(const Address& own) {
    if (own.host.empty()) return AF_UNIX;
    return own.host.find(':') == std::string::npos ? AF_INET : AF_INET6;
  }

  void accept() {
    if (!acceptor_.is_open()) return;
    acceptor_.async_accept(peer_,
                           [this](const Error& error, Stream::socket socket) {
                             take_connection(error, std::move(socket));
                           });
  }

  void take_connection(const Error& error, Stream::socket socket) {
    if (!acceptor_.is_open()) return;
    if (error) return accept_later();
    if (connections_.size() < limits_.connections) add(std::move(socket));
    accept();
  }

  void accept_later() {
    pause_.expires_after(kAcceptPause);
    pause_.async_wait([this](const Error& error) {
      if (!error) accept();
    });
  }

  void add(Stream::socket socket) {
    keep_from_programs(socket.native_handle());
    Error ignored;
    socket.non_blocking(true, ignored);
    socket.set_option(net::ip::tcp::no_delay(true), ignored);
    Hub& hub = *this;
    const auto connection =
        std::make_shared<Connection>(hub, std::move(socket), host_of(peer_));
    connections_.insert(connection);
    connection->start();
  }

  const Limits& limits() const override { return limits_; }
  const Rules& rules() const override { return rules_; }
  const Policy& policy() const override { return policy_; }
  bool is_ending() const override { return is_ending_; }
  void report_refusal(unsigned status) override {
    if (on_refusal_) on_refusal_(status);
  }
  void handle(const Request& request, std::unique_ptr<Answer> answer) override {
    (*handler_)(request, std::move(answer));
  }
  void post(std::function<void()> call) override {
    net::post(context_, std::move(call));
  }
  void remove(const std::shared_ptr<Connection>& connection) override {
    connections_.erase(connection);
    if (on_end_ && connections_.empty()) post(std::exchange(on_end_, {}));
  }
  void fail() noexcept override {
    has_failed_ = true;
    context_.stop();
  }

  const Limits limits_;
  const Policy policy_;
  Rules rules_;
  net::io_context context_{1};  // one thread
  Acceptor acceptor_{context_};
  Stream::endpoint peer_;  // of the connection that comes next
  net::steady_timer pause_{context_};
  std::set<std::shared_ptr<Connection>> connections_;
  std::map<int, std::shared_ptr<Watch>> watches_;
  const AnswerHandler* handler_ = nullptr;
  std::function<void(unsigned)> on_refusal_;
  std::function<void()> on_end_;
  bool is_ending_ = false;
  bool has_failed_ = false;
};

}  // namespace
}  // namespace lamina::http

extern "C" __attribute__((visibility("default"))) lamina::http::Engine*
lamina_make_http_engine(int version, const lamina::http::Limits* limits,
                        const lamina::http::Policy* policy) noexcept {
  errno = 0;
  if (version != lamina::http::kEngineVersion) return nullptr;
  try {
    return new lamina::http::BeastEngine(*limits, *policy);
  } catch (const std::exception&) {
    errno = ENOMEM;
    return nullptr;
  }
}
