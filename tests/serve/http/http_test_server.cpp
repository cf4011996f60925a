// A server for tests: answers each request with what has reached the handler,
// as JSON. It prints its port, and ends with its standard input.
//
// usage: http_test_server [--programs] [ADDRESS]
//
//   /stream   an answer without end, as fast as it is taken
//   /late     answers after 300 ms
//   /short    answers with an empty object
//   /nothing  gives the reply up

#include <chrono>
#include <cstdint>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>
#include <unistd.h>

#include "base/diagnostic.h"
#include "serve/http/server.h"

using namespace lamina;

namespace {

using Json = nlohmann::json;
using std::chrono::milliseconds;

std::string echo(const http::Request& request) {
  Json json;
  json["method"] = request.method;
  json["path"] = request.path;
  json["query"] = request.query;
  json["type"] = request.content_type;
  json["size"] = request.body.size();
  json["body"] = request.body;
  json["cookies"] = request.cookies;
  return json.dump(-1, ' ', true, Json::error_handler_t::replace);
}

http::Response json_response(std::string body) {
  http::Response response;
  response.type = "application/json";
  response.body = std::move(body);
  return response;
}

void pour(http::Server& server, const std::shared_ptr<http::Reply>& reply) {
  if (!reply->is_open()) return;
  reply->write(std::string(std::size_t{256} << 10, 'x'));
  server.after(milliseconds(1), [&server, reply] { pour(server, reply); });
}

void answer(http::Server& server, const http::Request& request,
            const std::shared_ptr<http::Reply>& reply) {
  if (request.path == "/stream") {
    reply->begin({});
    pour(server, reply);
  } else if (request.path == "/late") {
    server.after(milliseconds(300), [reply, text = echo(request)] {
      reply->send(json_response(text));
    });
  } else if (request.path == "/short") {
    reply->send(json_response("{}"));
  } else if (request.path != "/nothing") {
    reply->send(json_response(echo(request)));
  }
}

}  // namespace

int main(int count, char** words) {
  std::vector<std::string> arguments(words + 1, words + count);
  http::Policy policy;
  if (!arguments.empty() && arguments.front() == "--programs") {
    policy.peers = http::Peers::kPrograms;
    policy.has_problems = true;
    arguments.erase(arguments.begin());
  }
  Diagnostics diagnostics;
  http::Limits limits;
  limits.queued_bytes = std::size_t{4} << 20;
  const auto server =
      http::make_server(limits, policy, {LAMINA_MODULES}, diagnostics);
  OpenFile listener = http::open_listener(
      http::parse_address(arguments.empty() ? "0" : arguments.front()));
  const std::uint16_t port = http::address_of(listener).port;
  server->listen(std::move(listener));
  std::cout << port << std::endl;
  server->on_readable(STDIN_FILENO, [&] { server->stop(); });
  server->run([&](const http::Request& request,
                  const std::shared_ptr<http::Reply>& reply) {
    answer(*server, request, reply);
  });
  server->forget(STDIN_FILENO);
  return 0;
}
