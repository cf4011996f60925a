#include "serve/http/server.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/serve/http/serving.h"
#include "tests/support/temporary_folder.h"

namespace lamina::http {
namespace {

TEST(MakeServer, SaysWhereTheModuleIsMissing) {
  Diagnostics diagnostics;
  EXPECT_THROW(make_server({}, {}, {"/nonexistent"}, diagnostics),
               GeometryError);
}

TEST_F(Serving, AnswersByWhatTheHandlerSends) {
  Response response = text("hello");
  response.status = 202;
  response.type = "text/css";
  response.headers = {{"Set-Cookie", "a=b"}, {"X-More", "c"}};
  const std::string answer = answer_to(get("/"), always(response));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 202 ")) << answer;
  EXPECT_TRUE(has(answer, "\r\nContent-Type: text/css\r\n")) << answer;
  EXPECT_TRUE(has(answer, "\r\nContent-Length: 5\r\n")) << answer;
  EXPECT_TRUE(has(answer, "\r\nSet-Cookie: a=b\r\n")) << answer;
  EXPECT_TRUE(has(answer, "\r\nX-More: c\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "hello");
}

void expect_security_headers(const std::string& answer) {
  for (const std::string line :
       {"Content-Security-Policy: default-src 'none'; script-src 'self'; "
        "style-src 'self'; img-src 'self' data: blob:; connect-src 'self'; "
        "base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
        "X-Content-Type-Options: nosniff", "Referrer-Policy: no-referrer",
        "Cross-Origin-Opener-Policy: same-origin",
        "Cross-Origin-Resource-Policy: same-origin",
        "Cache-Control: no-store"}) {
    EXPECT_TRUE(has(answer, "\r\n" + line + "\r\n")) << line << "\n" << answer;
  }
}

TEST_F(Serving, SendsTheSecurityHeadersWithEveryAnswer) {
  expect_security_headers(answer_to(get("/"), always(text(""))));
  // Refusals, streams, files that are gone, answers given up.
  expect_security_headers(answer_to("nonsense\r\n\r\n", always(text(""))));
  expect_security_headers(answer_to(
      get("/"),
      [](const Request&, const ReplyPointer& reply) { reply->begin({}); }));
  Response gone;
  gone.file = "/nonexistent";
  expect_security_headers(answer_to(get("/"), always(gone)));
  expect_security_headers(
      answer_to(get("/"), [](const Request&, const ReplyPointer&) {}));
}

TEST_F(Serving, HandlersCannotBreakTheFraming) {
  Response response = text("hello");
  response.headers = {{"Content-Length", "1"},
                      {"Transfer-Encoding", "chunked"},
                      {"Connection", "upgrade"},
                      {"Content-Type", "text/html"}};
  const std::string answer = answer_to(get("/"), always(response));
  EXPECT_TRUE(has(answer, "\r\nContent-Length: 5\r\n")) << answer;
  EXPECT_FALSE(has(answer, "chunked")) << answer;
  EXPECT_FALSE(has(answer, "upgrade")) << answer;
  EXPECT_FALSE(has(answer, "text/html")) << answer;
}

TEST_F(Serving, SendsTheHandlersHeaderInsteadOfItsOwn) {
  Response response = text("hello");
  response.headers = {{"cache-control", "public, max-age=60"},
                      {"Content-Security-Policy", "default-src 'self'"}};
  const std::string answer = answer_to(get("/"), always(response));
  EXPECT_TRUE(has(answer, "\r\ncache-control: public, max-age=60\r\n"));
  EXPECT_FALSE(has(answer, "no-store")) << answer;
  EXPECT_TRUE(has(answer, "Policy: default-src 'self'\r\n")) << answer;
  EXPECT_FALSE(has(answer, "default-src 'none'")) << answer;
  EXPECT_TRUE(has(answer, "\r\nX-Content-Type-Options: nosniff\r\n"));
}

TEST_F(Serving, SendsNoBodyWhereNothingIsModified) {
  Response response = text("hello");
  response.status = 304;
  response.headers = {{"ETag", "\"a\""}};
  // The next answer of the connection follows at once.
  const std::string answer =
      answer_to("GET /one HTTP/1.1\r\n" + host() + "\r\n" + get("/two"),
                [&](const Request& request, const ReplyPointer& reply) {
                  reply->send(request.path == "/one" ? response : text("two"));
                });
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 304 ")) << answer;
  const std::size_t end = answer.find("\r\n\r\n");
  const std::string head = answer.substr(0, end);
  EXPECT_TRUE(has(head, "\r\nETag: \"a\"\r\n")) << head;
  EXPECT_FALSE(has(head, "\r\nContent-Length")) << head;
  EXPECT_FALSE(has(head, "\r\nContent-Type")) << head;
  EXPECT_TRUE(answer.substr(end + 4).starts_with("HTTP/1.1 200 ")) << answer;
  EXPECT_TRUE(answer.ends_with("\r\n\r\ntwo")) << answer;
}

TEST_F(Serving, AnswersBy500WhereAHeaderWouldInjectOthers) {
  const std::vector<std::pair<std::string, std::string>> bad = {
      {"X", "a\r\nSet-Cookie: b=c"},
      {"X", "a\nSet-Cookie: b=c"},
      {"X", std::string("a\0b", 3)},
      {"X\r\nSet-Cookie", "b=c"},
      {"X: a", "b"},
      {"", "b"}};
  for (const auto& header : bad) {
    Response response = text("hello");
    response.headers = {header};
    const std::string answer = answer_to(get("/"), always(response));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 500 ")) << answer;
    EXPECT_FALSE(has(answer, "Set-Cookie")) << answer;
  }
  Response response;
  response.type = "text/plain\r\nSet-Cookie: b=c";
  EXPECT_TRUE(
      answer_to(get("/"), always(response)).starts_with("HTTP/1.1 500 "));
  response = {};
  response.status = 1000;
  EXPECT_TRUE(
      answer_to(get("/"), always(response)).starts_with("HTTP/1.1 500 "));
}

TEST_F(Serving, ShowsTheRequestToTheHandler) {
  Request seen;
  const Handler keep = [&](const Request& request, const ReplyPointer& reply) {
    seen = request;
    reply->send({});
  };
  answer_to(get("/a/../b?c=d?e",
                "cookie: one=1; two=a=b\r\nCookie: three=\r\n"
                "Content-Type: Application/JSON; charset=utf-8\r\n"),
            keep);
  EXPECT_EQ(seen.method, "GET");
  EXPECT_EQ(seen.path, "/a/../b");
  EXPECT_EQ(seen.query, "c=d?e");
  EXPECT_EQ(seen.content_type, "application/json");
  EXPECT_EQ(seen.cookie("one"), "1");
  EXPECT_EQ(seen.cookie("two"), "a=b");
  EXPECT_EQ(seen.cookie("three"), "");
  EXPECT_EQ(seen.cookie("four"), "");
  EXPECT_EQ(seen.cookies.size(), 3U);

  const std::string body(65536, 'x');
  answer_to(post("/post", body), keep);
  EXPECT_EQ(seen.method, "POST");
  EXPECT_EQ(seen.body, body);
}

TEST_F(Serving, AnswersHeadLikeGetWithoutTheBody) {
  const std::string answer =
      answer_to(get("/", "", "HEAD"),
                [](const Request& request, const ReplyPointer& reply) {
                  reply->send(text(request.method));
                });
  EXPECT_TRUE(has(answer, "\r\nContent-Length: 3\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "");
}

TEST_F(Serving, SendsFilesOfAnySize) {
  const support::TemporaryFolder folder;
  std::string bytes;
  for (int i = 0; i < 1000000; ++i) bytes += std::to_string(i);
  Response response;
  response.file = folder.write("file", bytes);
  const std::string answer = answer_to(get("/"), always(response));
  EXPECT_TRUE(has(answer, "Content-Length: " + std::to_string(bytes.size())));
  EXPECT_TRUE(body_of(answer) == bytes);

  const std::string head = answer_to(get("/", "", "HEAD"), always(response));
  EXPECT_TRUE(has(head, "Content-Length: " + std::to_string(bytes.size())));
  EXPECT_EQ(body_of(head), "");

  response.file = folder.path() + "/other";
  EXPECT_TRUE(
      answer_to(get("/"), always(response)).starts_with("HTTP/1.1 404 "));
}

TEST_F(Serving, AnswersLater) {
  const std::string answer =
      answer_to(get("/"), [&](const Request&, const ReplyPointer& reply) {
        server_->after(milliseconds(50),
                       [reply] { reply->send(text("late")); });
      });
  EXPECT_EQ(body_of(answer), "late");
}

TEST_F(Serving, AnswersBy500WhatIsGivenUp) {
  const std::string answer =
      answer_to(get("/"), [](const Request&, const ReplyPointer&) {});
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 500 ")) << answer;
}

TEST_F(Serving, TakesTheFirstAnswerOnly) {
  const std::string answer =
      answer_to(get("/"), [](const Request&, const ReplyPointer& reply) {
        reply->send(text("one"));
        reply->send(text("two"));
        reply->begin(text("three"));
        reply->write("four");
      });
  EXPECT_EQ(body_of(answer), "one");
}

TEST_F(Serving, AnswersRequestsOfOneConnectionInTheirOrder) {
  const std::string two = "GET /one HTTP/1.1\r\n" + host() + "\r\n" +
                          "POST /two HTTP/1.1\r\n" + host() +
                          "Origin: http://localhost:" + port() +
                          "\r\nContent-Length: 3\r\n\r\nabc";
  // The first is answered after the others have come.
  const std::string answer = answer_to(
      two + get("/three"),
      [&](const Request& request, const ReplyPointer& reply) {
        const std::string words = "<" + request.path + request.body + ">";
        server_->after(milliseconds(request.path == "/one" ? 50 : 0),
                       [reply, words] { reply->send(text(words)); });
      });
  const std::size_t one = answer.find("</one>");
  const std::size_t two_at = answer.find("</twoabc>");
  const std::size_t three = answer.find("</three>");
  ASSERT_NE(three, std::string::npos) << answer;
  EXPECT_LT(one, two_at);
  EXPECT_LT(two_at, three);
}

TEST_F(Serving, TakesNothingAfterARefusal) {
  int count = 0;
  const std::string answer =
      answer_to("GET / HTTP/1.0\r\n" + host() + "\r\n" + get("/two"),
                [&](const Request&, const ReplyPointer& reply) {
                  ++count;
                  reply->send({});
                });
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 400 ")) << answer;
  EXPECT_EQ(answer.find("\nHTTP/1.1 "), std::string::npos) << answer;
  EXPECT_EQ(count, 0);
}

// --- Streams
// ------------------------------------------------------------------

TEST_F(Serving, WritesOnToWhatHasBegun) {
  const std::string answer =
      answer_to(get("/"), [&](const Request&, const ReplyPointer& reply) {
        Response response;
        response.type = "text/event-stream";
        reply->begin(response);
        reply->write("data: 1\n\n");
        server_->after(milliseconds(20),
                       [reply] { reply->write("data: 2\n\n"); });
      });
  EXPECT_TRUE(has(answer, "\r\nContent-Type: text/event-stream\r\n")) << answer;
  EXPECT_FALSE(has(answer, "Content-Length")) << answer;
  // It ends with the reply.
  EXPECT_EQ(body_of(answer), "data: 1\n\ndata: 2\n\n");
}

TEST_F(Serving, CallsOnceThePeerOfAStreamHasGone) {
  ReplyPointer stream;
  std::atomic<bool> has_closed = false;
  serve(
      [&](const Request&, const ReplyPointer& reply) {
        stream = reply;
        reply->begin({});
        reply->write("x");
        EXPECT_TRUE(reply->is_open());
        reply->on_close([&] {
          has_closed = true;
          EXPECT_FALSE(stream->is_open());
          // At once, where it has ended.
          int calls = 0;
          stream->on_close([&] { ++calls; });
          EXPECT_EQ(calls, 1);
          stream->write("nobody takes this");
          server_->stop();
        });
      },
      [&] {
        Client client(address_);
        client.send(get("/"));
        client.receive_to("\r\n\r\nx");
        client.close();
        EXPECT_TRUE(wait_for(has_closed));
      });
}

TEST_F(Serving, CallsOnceThePeerOfALateAnswerHasGone) {
  expect_peer_is_seen_to_go();
}

class ServingLittle : public Serving {
 protected:
  ServingLittle() : Serving(limits()) {}

  static Limits limits() {
    Limits limits;
    limits.queued_bytes = 1 << 20;
    limits.header_time = milliseconds(200);
    limits.body_time = milliseconds(200);
    limits.idle_time = milliseconds(200);
    limits.connections = 2;
    return limits;
  }
};

TEST_F(ServingLittle, CutsOffAStreamThatNobodyTakes) {
  std::atomic<bool> has_closed = false;
  serve(
      [&](const Request&, const ReplyPointer& reply) {
        reply->begin({});
        reply->on_close([&] { has_closed = true; });
        // The machine's own buffers take some.
        for (int i = 0; i < 64; ++i) reply->write(std::string(1 << 20, 'x'));
        EXPECT_FALSE(reply->is_open());
      },
      [&] {
        Client client(address_);
        client.send(get("/"));
        EXPECT_TRUE(wait_for(has_closed));
        EXPECT_LT(client.receive().size(), std::size_t{64} << 20);
      });
}

TEST_F(ServingLittle, CutsOffAReaderThatStops) {
  std::atomic<bool> has_closed = false;
  ReplyPointer kept;
  serve(
      [&](const Request&, const ReplyPointer& reply) {
        kept = reply;
        reply->on_close([&] { has_closed = true; });
        reply->send(text(std::string(64 << 20, 'x')));
      },
      [&] {
        Client client(address_);
        client.send(get("/"));
        EXPECT_TRUE(wait_for(has_closed));
      });
}

TEST_F(ServingLittle, EndsConnectionsThatTakeTooLong) {
  const Handler handler = always(text("answer"));
  EXPECT_EQ(answer_to("", handler), "");  // an idle one: no answer
  EXPECT_TRUE(answer_to("GET / HT", handler).starts_with("HTTP/1.1 408 "));
  std::string half = post("/", "abc");
  half.pop_back();
  EXPECT_TRUE(answer_to(half, handler).starts_with("HTTP/1.1 408 "));
  // After an answer it ends in silence.
  const std::string answer =
      answer_to("GET / HTTP/1.1\r\n" + host() + "\r\n", handler);
  EXPECT_EQ(body_of(answer), "answer");
}

class ServingTwo : public Serving {
 protected:
  ServingTwo() : Serving(limits()) {}

  static Limits limits() {
    Limits limits;
    limits.connections = 2;
    return limits;
  }
};

TEST_F(ServingTwo, ClosesConnectionsBeyondTheLimit) {
  serve(always(text("answer")), [&] {
    Client one(address_);
    const Client two(address_);
    EXPECT_EQ(Client(address_).receive(), "");
    one.close();
    EXPECT_TRUE(wait_until([&] {
      Client late(address_);
      late.send(get("/"));
      return body_of(late.receive()) == "answer";
    }));
  });
}

// --- Calls
// --------------------------------------------------------------------

TEST_F(Serving, CallsWhileADescriptorCanBeRead) {
  Pipe pipe;
  pipe.write('a');
  pipe.write('b');
  std::string read;
  server_->on_readable(pipe.reader(), [&] {
    read += pipe.read();
    if (read == "abc") {
      server_->forget(pipe.reader());
      // Nobody is called for this one.
      pipe.write('d');
      server_->after(milliseconds(50), [&] { server_->stop(); });
    }
  });
  server_->after(milliseconds(20), [&] { pipe.write('c'); });
  server_->run({});
  EXPECT_EQ(read, "abc");
  EXPECT_EQ(pipe.read(), 'd');  // it is still open
}

TEST_F(Serving, CallsAtTheEndOfADescriptor) {
  Pipe pipe;
  int calls = 0;
  server_->on_readable(pipe.reader(), [&] {
    ++calls;
    server_->stop();
  });
  server_->after(milliseconds(20), [&] { pipe.end(); });
  server_->run({});
  EXPECT_EQ(calls, 1);
  server_->forget(pipe.reader());
}

TEST_F(Serving, CallsInTheOrderOfTheirTimes) {
  std::string calls;
  server_->after(milliseconds(40), [&] { server_->stop(); });
  server_->after(milliseconds(20), [&] { calls += "b"; });
  server_->after(milliseconds(0), [&] { calls += "a"; });
  server_->run({});
  EXPECT_EQ(calls, "ab");
}

TEST_F(Serving, ThrowsWhatTheHandlerThrows) {
  EXPECT_THROW(answer_to(get("/"),
                         [](const Request&, const ReplyPointer&) {
                           throw std::runtime_error("of the handler");
                         }),
               std::runtime_error);
}

TEST_F(Serving, ThrowsWhatACallThrows) {
  server_->after(milliseconds(0), [] { throw std::runtime_error("late"); });
  EXPECT_THROW(server_->run({}), std::runtime_error);
  // It can go on.
  server_->after(milliseconds(0), [&] { server_->stop(); });
  server_->run({});
}

TEST_F(Serving, CannotListenOnAPortTwice) {
  EXPECT_EQ(error_of([&] { open_listener(address_); }),
            "can't serve on port " + port() + ": Address already in use");
}

// Runs of a design are forked, and hold copies of all descriptors.
TEST_F(Serving, EndsConnectionsWhoseDescriptorsAChildHolds) {
  std::vector<pid_t> children;
  const auto fork_a_child = [&] {
    children.push_back(::fork());
    if (children.back() == 0) {
      ::alarm(60);
      while (true) ::pause();
    }
  };
  const std::string answer =
      answer_to(get("/"), [&](const Request&, const ReplyPointer& reply) {
        fork_a_child();
        reply->send(text("answer"));
      });
  EXPECT_EQ(body_of(answer), "answer");
  // A stream is cut off, and its end is seen though the child lives.
  std::string stream;
  serve(
      [&](const Request&, const ReplyPointer& reply) {
        fork_a_child();
        reply->begin({});
        reply->write("x");
      },
      [&] {
        Client client(address_);
        client.send(get("/"));
        stream = client.receive();
      });
  EXPECT_EQ(body_of(stream), "x");
  server_.reset();
  EXPECT_EQ(address_of(open_listener(address_)).port, address_.port);
  for (const pid_t child : children) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
}

TEST_F(Serving, RepliesMayOutliveTheServer) {
  ReplyPointer kept;
  std::atomic<bool> has_come = false;
  serve(
      [&](const Request&, const ReplyPointer& reply) {
        kept = reply;
        has_come = true;
      },
      [&] {
        Client client(address_);
        client.send(get("/"));
        EXPECT_TRUE(wait_for(has_come));
      });
  server_.reset();
  EXPECT_FALSE(kept->is_open());
  kept->send(text("nobody"));
}

}  // namespace
}  // namespace lamina::http
