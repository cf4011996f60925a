#include "serve/http/server.h"

#include <cerrno>
#include <exception>
#include <new>
#include <utility>

#include "base/check.h"
#include "serve/http/detail/engine.h"

namespace lamina::http {
namespace {

// Throws what an engine's errno means, other than 0.
void check(int error) {
  if (error == ENOMEM) throw std::bad_alloc();
  LAMINA_CHECK_EQ(error, 0);
}

// Keeps what calls throw while the module runs them, and stops it.
class Guard {
 public:
  void set_engine(Engine& engine) { engine_ = &engine; }

  // The call, which throws no more.
  template <typename... Arguments>
  std::function<void(Arguments...)> guarded(
      std::function<void(Arguments...)> call) {
    return [this, call = std::move(call)](Arguments... arguments) {
      keep_fault([&] { call(arguments...); });
    };
  }

  template <typename Call>
  void keep_fault(const Call& call) noexcept {
    try {
      call();
    } catch (...) {
      if (!fault_) fault_ = std::current_exception();
      engine_->stop();
    }
  }

  void rethrow_fault() {
    if (fault_) std::rethrow_exception(std::exchange(fault_, nullptr));
  }

 private:
  Engine* engine_ = nullptr;
  std::exception_ptr fault_;
};

class GuardedReply final : public Reply {
 public:
  GuardedReply(std::unique_ptr<Answer> answer, Guard& guard)
      : answer_(std::move(answer)), guard_(guard) {}

  void send(Response response) override { answer_->send(std::move(response)); }
  void begin(Response response) override {
    answer_->begin(std::move(response));
  }
  void write(std::string bytes) override { answer_->write(std::move(bytes)); }
  bool is_open() const override { return answer_->is_open(); }
  void on_close(std::function<void()> call) override {
    if (!is_open()) return call();
    answer_->on_close(guard_.guarded(std::move(call)));
  }

 private:
  std::unique_ptr<Answer> answer_;
  Guard& guard_;
};

class ModuleServer final : public Server {
 public:
  explicit ModuleServer(std::unique_ptr<Engine> engine)
      : engine_(std::move(engine)) {
    guard_.set_engine(*engine_);
  }

  void listen(OpenFile listener) override {
    const Address own = address_of(listener);
    check(engine_->listen(listener.release(), own));
  }
  void stop_listening(std::function<void()> call) override {
    check(engine_->stop_listening(guard_.guarded(std::move(call))));
  }
  void on_refusal(std::function<void(unsigned status)> call) override {
    engine_->on_refusal(guard_.guarded(std::move(call)));
  }

  void on_readable(int descriptor, std::function<void()> call) override {
    check(engine_->on_readable(descriptor, guard_.guarded(std::move(call))));
  }
  void forget(int descriptor) override { engine_->forget(descriptor); }

  void after(std::chrono::milliseconds time,
             std::function<void()> call) override {
    check(engine_->after(time, guard_.guarded(std::move(call))));
  }

  void run(const Handler& handler) override {
    const int error = engine_->run(
        [&](const Request& request, std::unique_ptr<Answer> answer) {
          guard_.keep_fault([&] {
            handler(request,
                    std::make_shared<GuardedReply>(std::move(answer), guard_));
          });
        });
    guard_.rethrow_fault();
    check(error);
  }
  void stop() override { engine_->stop(); }

 private:
  Guard guard_;
  std::unique_ptr<Engine> engine_;
};

}  // namespace

std::unique_ptr<Server> make_server(const Limits& limits, const Policy& policy,
                                    const std::vector<std::string>& folders,
                                    Diagnostics& diagnostics) {
  auto* const make_engine =
      reinterpret_cast<MakeEngine*>(open_module(kModule, folders, diagnostics));
  std::unique_ptr<Engine> engine(make_engine(kEngineVersion, &limits, &policy));
  if (!engine) fail_without_engine(kModule, errno, diagnostics);
  return std::make_unique<ModuleServer>(std::move(engine));
}

Response content(std::string_view type, std::string body) {
  Response response;
  response.type = type;
  response.body = std::move(body);
  return response;
}

std::pair<std::string, std::string> attachment(std::string_view name) {
  std::string plain;
  for (const char c : name) {
    const bool is_plain = c > ' ' && c < 0x7F && c != '"' && c != '\\';
    plain += is_plain ? c : '_';
  }
  return {"Content-Disposition", "attachment; filename=\"" + plain + '"'};
}

}  // namespace lamina::http
