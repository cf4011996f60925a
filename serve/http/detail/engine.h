#pragma once
// What the program sees of the module lamina_http.so.
//
// Nothing is thrown across the border (base/file/module.h): where the module
// gets no memory, run() returns ENOMEM. What the program's calls throw is kept
// on its side (server.cpp), so none of the calls handed over throws.

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "serve/http/server.h"

namespace lamina::http {

// As Reply.
class Answer {
 public:
  virtual ~Answer() = default;

  virtual void send(Response response) noexcept = 0;
  virtual void begin(Response response) noexcept = 0;
  virtual void write(std::string bytes) noexcept = 0;
  virtual bool is_open() const noexcept = 0;
  // Does not call where the connection has ended before.
  virtual void on_close(std::function<void()> call) noexcept = 0;
};

using AnswerHandler =
    std::function<void(const Request& request, std::unique_ptr<Answer> answer)>;

// As Server. Functions return an errno, or 0.
class Engine {
 public:
  virtual ~Engine() = default;

  // Closes the descriptor at the end.
  //
  // own  where it listens
  virtual int listen(int descriptor, const Address& own) noexcept = 0;
  virtual int stop_listening(std::function<void()> call) noexcept = 0;
  virtual void on_refusal(
      std::function<void(unsigned status)> call) noexcept = 0;
  virtual int on_readable(int descriptor,
                          std::function<void()> call) noexcept = 0;
  virtual void forget(int descriptor) noexcept = 0;
  virtual int after(std::chrono::milliseconds time,
                    std::function<void()> call) noexcept = 0;
  virtual int run(const AnswerHandler& handler) noexcept = 0;
  virtual void stop() noexcept = 0;
};

// Grows with every change above, and of Limits, Policy, Request and Response.
constexpr int kEngineVersion = 2;

// The module's function: a new engine; null if it has another version, or
// there is no memory (errno is ENOMEM then).
using MakeEngine = Engine*(int version, const Limits* limits,
                           const Policy* policy);

}  // namespace lamina::http
