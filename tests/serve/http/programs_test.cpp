// A server for programs (Policy), on TCP and Unix sockets, and its end.

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include "serve/http/server.h"
#include "serve/http/status.h"
#include "tests/serve/http/serving.h"
#include "tests/support/temporary_folder.h"

namespace lamina::http {
namespace {

Policy for_programs(std::vector<std::string> hosts = {}) {
  Policy policy;
  policy.peers = Peers::kPrograms;
  policy.has_problems = true;
  policy.hosts = std::move(hosts);
  return policy;
}

class ServingPrograms : public Serving {
 protected:
  explicit ServingPrograms(const Limits& limits = {},
                           const Policy& policy = for_programs(),
                           const std::string& address = "0")
      : Serving(limits, policy, address) {}

  // The status, as text, of a request with these lines.
  std::string status_of(const std::string& lines,
                        const std::string& line = "GET / HTTP/1.1") {
    const std::string answer =
        answer_to(line + "\r\n" + lines + "Connection: close\r\n\r\n",
                  always(text("answer")));
    EXPECT_TRUE(answer.starts_with("HTTP/1.1 ")) << answer;
    return answer.substr(9, 3);
  }
  std::string status_of_host(const std::string& host) {
    return status_of("Host: " + host + "\r\n");
  }

  // The peer that a handler is shown.
  std::string peer_of(const std::string& lines) {
    std::string peer = "none";
    answer_to(get("/", lines),
              [&](const Request& request, const ReplyPointer& reply) {
                peer = request.peer;
                reply->send({});
              });
    return peer;
  }
};

// --- What programs may send --------------------------------------------------

TEST_F(ServingPrograms, HaveNoRulesForSites) {
  EXPECT_EQ(status_of(host() + "Origin: https://shop.example\r\n"), "200");
  EXPECT_EQ(status_of(host() + "Sec-Fetch-Site: cross-site\r\n"), "200");
  EXPECT_EQ(status_of(host() + "Content-Length: 0\r\n", "POST / HTTP/1.1"),
            "200");
}

TEST_F(ServingPrograms, MayNameALoopbackHostWhereTheServerListensOnOne) {
  EXPECT_EQ(status_of_host("127.0.0.1:" + port()), "200");
  EXPECT_EQ(status_of_host("LocalHost:" + port()), "200");
  EXPECT_EQ(status_of_host("[::1]:" + port()), "200");
  EXPECT_EQ(status_of_host("localhost"), "403");
  EXPECT_EQ(status_of_host("evil.example:" + port()), "403");
  EXPECT_EQ(status_of_host(""), "403");
  EXPECT_EQ(status_of(host() + host()), "400");
  EXPECT_EQ(status_of(""), "400");
}

class ServingHosts : public ServingPrograms {
 protected:
  ServingHosts()
      : ServingPrograms({},
                        for_programs({"quotes.example", "other.example:81"})) {}
};

TEST_F(ServingHosts, TakesTheHostsOfItsPolicyOnly) {
  EXPECT_EQ(status_of_host("quotes.example"), "200");
  EXPECT_EQ(status_of_host("QUOTES.example:8280"), "200");
  EXPECT_EQ(status_of_host("other.example:81"), "200");
  EXPECT_EQ(status_of_host("other.example"), "403");
  EXPECT_EQ(status_of_host("other.example:82"), "403");
  EXPECT_EQ(status_of_host("quotes.example.evil.example"), "403");
  EXPECT_EQ(status_of_host("127.0.0.1:" + port()), "403");
  EXPECT_EQ(status_of("", "GET / HTTP/1.0"), "400");
}

class ServingAnywhere : public ServingPrograms {
 protected:
  ServingAnywhere() : ServingPrograms({}, for_programs(), "0.0.0.0:0") {}
};

TEST_F(ServingAnywhere, TakesAnyHost) {
  EXPECT_EQ(status_of_host("quotes.example"), "200");
  EXPECT_EQ(status_of_host("192.0.2.1:80"), "200");
  EXPECT_EQ(status_of(host() + host()), "400");
  EXPECT_EQ(status_of(""), "400");
}

// --- HTTP/1.0 ----------------------------------------------------------------

TEST_F(ServingPrograms, MaySpeakHttp10WithoutHost) {
  const std::string answer =
      answer_to("GET / HTTP/1.0\r\n\r\n", always(text("answer")));
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << answer;
  EXPECT_TRUE(has(answer, "\r\nConnection: close\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "answer");
  EXPECT_EQ(status_of("Host: evil.example\r\n", "GET / HTTP/1.0"), "403");
  EXPECT_EQ(status_of(host() + host(), "GET / HTTP/1.0"), "400");
  EXPECT_EQ(status_of(host(), "GET / HTTP/1.2"), "400");
}

TEST_F(ServingPrograms, MayKeepAConnectionOfHttp10) {
  const std::string answer = answer_to(
      "GET /one HTTP/1.0\r\nConnection: keep-alive\r\n\r\n"
      "POST /two HTTP/1.0\r\nConnection: Keep-Alive\r\n"
      "Content-Length: 3\r\n\r\nabc"
      "GET /three HTTP/1.0\r\n\r\nGET /four HTTP/1.0\r\n\r\n",
      [](const Request& request, const ReplyPointer& reply) {
        reply->send(text("<" + request.path + request.body + ">"));
      });
  const std::size_t one = answer.find("</one>");
  const std::size_t two = answer.find("</twoabc>");
  ASSERT_NE(two, std::string::npos) << answer;
  EXPECT_TRUE(has(answer.substr(0, one), "\r\nConnection: keep-alive\r\n"));
  EXPECT_TRUE(
      has(answer.substr(one, two - one), "\r\nConnection: keep-alive\r\n"));
  EXPECT_TRUE(has(answer.substr(two), "\r\nConnection: close\r\n"));
  EXPECT_TRUE(answer.ends_with("</three>")) << answer;
}

// A stream of HTTP/1.0 ends with the connection, as each stream.
TEST_F(ServingPrograms, StreamByHttp10) {
  const std::string answer =
      answer_to("GET / HTTP/1.0\r\nConnection: keep-alive\r\n\r\n",
                [](const Request&, const ReplyPointer& reply) {
                  reply->begin({});
                  reply->write("stream");
                });
  EXPECT_TRUE(has(answer, "\r\nConnection: close\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "stream");
}

// --- What they get -----------------------------------------------------------

TEST_F(ServingPrograms, GetProblems) {
  const Handler handler = always(text("answer"));
  std::string answer = answer_to(
      "POST / HTTP/1.1\r\n" + host() + "Content-Length: 65537\r\n\r\n",
      handler);
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 413 ")) << answer;
  EXPECT_TRUE(has(answer, "\r\nContent-Type: application/problem+json\r\n"));
  EXPECT_EQ(body_of(answer),
            R"({"type":"about:blank","title":"Content Too Large",)"
            R"("status":413,"detail":"The body is too long"})");
  answer = answer_to(get("/", "", "PUT"), handler);
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 405 ")) << answer;
  EXPECT_TRUE(has(answer, "\r\nAllow: GET, HEAD, POST\r\n")) << answer;
  EXPECT_TRUE(has(answer, "\"Method Not Allowed\"")) << answer;
  // Of an answer that is given up, too.
  answer = answer_to(get("/"), [](const Request&, const ReplyPointer&) {});
  EXPECT_EQ(body_of(answer),
            R"({"type":"about:blank","title":"Internal Server Error",)"
            R"("status":500,"detail":"There is no answer"})");
}

TEST_F(ServingPrograms, HaveTheirRefusalsCounted) {
  std::vector<unsigned> statuses;
  server_->on_refusal([&](unsigned status) { statuses.push_back(status); });
  const Handler handler = always(text("answer"));
  answer_to(get("/"), handler);
  answer_to("nonsense\r\n\r\n", handler);
  answer_to(get("/", "", "PUT"), handler);
  answer_to(get("/", "Transfer-Encoding: chunked\r\n"), handler);
  answer_to(get("/"), [](const Request&, const ReplyPointer&) {});
  Response response;
  response.headers = {{"X", "a\nb"}};
  answer_to(get("/"), always(response));
  EXPECT_EQ(statuses, (std::vector<unsigned>{400, 405, 501, 500, 500}));
}

TEST_F(ServingPrograms, AreThrownAtByTheCounter) {
  server_->on_refusal(
      [](unsigned) { throw std::runtime_error("of the counter"); });
  EXPECT_THROW(answer_to("nonsense\r\n\r\n", {}), std::runtime_error);
}

TEST(TitleOf, IsTheReasonPhraseOfRfc9110) {
  EXPECT_EQ(title_of(200), "OK");
  EXPECT_EQ(title_of(404), "Not Found");
  EXPECT_EQ(title_of(422), "Unprocessable Content");
  EXPECT_EQ(title_of(503), "Service Unavailable");
  EXPECT_EQ(title_of(299), "");
}

// --- Who they are ------------------------------------------------------------

TEST_F(ServingPrograms, ShowTheHandlerWhatTheyHave) {
  std::string seen;
  answer_to(
      get("/", "If-None-Match: \"a\", W/\"b\"\r\nIf-None-Match: \"c\"\r\n"),
      [&](const Request& request, const ReplyPointer& reply) {
        seen = request.if_none_match;
        reply->send({});
      });
  EXPECT_EQ(seen, "\"a\", W/\"b\", \"c\"");
}

TEST_F(ServingPrograms, AreKnownByTheLastAddressThatWasForwarded) {
  EXPECT_EQ(peer_of(""), "127.0.0.1");
  EXPECT_EQ(peer_of("X-Forwarded-For: 192.0.2.1\r\n"), "192.0.2.1");
  EXPECT_EQ(peer_of("X-Forwarded-For: 192.0.2.1, \t2001:db8::1 \r\n"),
            "2001:db8::1");
  EXPECT_EQ(peer_of("x-forwarded-for: a\r\nX-Forwarded-For: b,c\r\n"), "c");
  EXPECT_EQ(peer_of("X-Forwarded-For: a,\r\n"), "127.0.0.1");
  EXPECT_EQ(peer_of("X-Forwarded-For:\r\n"), "127.0.0.1");
  EXPECT_EQ(peer_of("X-Forwarded-For: " + std::string(100, 'x') + "\r\n"),
            std::string(64, 'x'));
}

class ServingSix : public ServingPrograms {
 protected:
  ServingSix() : ServingPrograms({}, for_programs(), "[::1]:0") {}
};

TEST_F(ServingSix, TakesConnectionsOfIPv6) {
  EXPECT_EQ(status_of_host("[::1]:" + port()), "200");
  EXPECT_EQ(status_of_host("evil.example"), "403");
  EXPECT_EQ(peer_of(""), "::1");
  EXPECT_EQ(peer_of("X-Forwarded-For: 192.0.2.1\r\n"), "192.0.2.1");
}

class ServingBoth : public ServingPrograms {
 protected:
  ServingBoth() : ServingPrograms({}, for_programs(), "[::]:0") {}
};

TEST_F(ServingBoth, ShowsAnAddressOfIPv4AsSuch) {
  address_.host = "127.0.0.1";
  EXPECT_EQ(peer_of(""), "127.0.0.1");
}

// --- Unix sockets ------------------------------------------------------------

class ServingPath : public ServingPrograms {
 protected:
  explicit ServingPath(std::unique_ptr<support::TemporaryFolder> folder =
                           std::make_unique<support::TemporaryFolder>())
      : ServingPrograms({}, for_programs(), folder->file("socket")),
        folder_(std::move(folder)) {}

  const std::unique_ptr<support::TemporaryFolder> folder_;
};

TEST_F(ServingPath, AnswersAsOnAPort) {
  EXPECT_EQ(status_of_host("quotes.example"), "200");
  EXPECT_EQ(status_of("", "GET / HTTP/1.0"), "200");
  EXPECT_EQ(status_of(""), "400");
  EXPECT_EQ(peer_of(""), "");
  EXPECT_EQ(peer_of("X-Forwarded-For: a, 192.0.2.1\r\n"), "192.0.2.1");
}

TEST_F(ServingPath, SendsMuchAndSeesThePeerGo) {
  const std::string much(std::size_t{8} << 20, 'x');
  EXPECT_EQ(body_of(answer_to(get("/"), always(text(much)))).size(),
            much.size());
  expect_peer_is_seen_to_go();
}

// --- The end -----------------------------------------------------------------

TEST_F(ServingPrograms, AreAnsweredWhatIsUnderWayAtTheEnd) {
  ReplyPointer late;
  std::string answer;
  std::string of_idle;
  std::atomic<bool> has_ended = false;
  serve(
      [&](const Request& request, const ReplyPointer& reply) {
        if (request.path == "/idle") return reply->send(text("first"));
        late = reply;
        server_->stop_listening([&] { has_ended = true; });
        server_->after(milliseconds(100), [&] {
          EXPECT_FALSE(has_ended);
          late->send(text("late"));
        });
      },
      [&] {
        Client idle(address_);
        idle.send("GET /idle HTTP/1.1\r\n" + host() + "\r\n");
        of_idle = idle.receive_to("first");
        Client silent(address_);
        Client client(address_);
        std::this_thread::sleep_for(milliseconds(50));
        // Two at once: only the first is under way.
        client.send("GET / HTTP/1.1\r\n" + host() + "\r\n" + get("/two"));
        EXPECT_EQ(idle.receive(), "");
        EXPECT_EQ(silent.receive(), "");
        answer = client.receive();
        client.close();
        EXPECT_TRUE(wait_for(has_ended));
      });
  EXPECT_FALSE(has(of_idle, "Connection: close")) << of_idle;
  EXPECT_TRUE(answer.starts_with("HTTP/1.1 200 ")) << answer;
  EXPECT_TRUE(has(answer, "\r\nConnection: close\r\n")) << answer;
  EXPECT_EQ(body_of(answer), "late");
}

TEST_F(ServingPrograms, CanFinishARequestThatHasBegunAtTheEnd) {
  std::string answer;
  std::atomic<bool> has_ended = false;
  std::atomic<bool> ends = false;
  server_->after(milliseconds(100), [&] {
    server_->stop_listening([&] { has_ended = true; });
    ends = true;
  });
  serve(always(text("answer")), [&] {
    Client client(address_);
    client.send("GET / HTTP/1.1\r\n");
    EXPECT_TRUE(wait_for(ends));
    client.send(host() + "\r\n");
    answer = client.receive();
    client.close();
    EXPECT_TRUE(wait_for(has_ended));
  });
  EXPECT_EQ(body_of(answer), "answer");
  EXPECT_TRUE(has(answer, "\r\nConnection: close\r\n")) << answer;
}

void expect_end(Server& server, const Address& address) {
  bool has_ended = false;
  server.stop_listening([&] {
    has_ended = true;
    server.stop();
  });
  server.run({});
  EXPECT_TRUE(has_ended);
  // Nobody listens there any more.
  const OpenFile next = open_listener(address);
  EXPECT_EQ(text_of(address_of(next)), text_of(address));
}

TEST_F(ServingPrograms, AreRefusedAfterTheEnd) {
  expect_end(*server_, address_);
}
TEST_F(ServingPath, AreRefusedAfterTheEnd) { expect_end(*server_, address_); }

// --- Many connections --------------------------------------------------------

class ServingMany : public ServingPrograms {
 protected:
  ServingMany() : ServingPrograms(limits()) {}

  static Limits limits() {
    Limits limits;
    limits.connections = 300;
    return limits;
  }
};

TEST_F(ServingMany, HoldsAsManyAsItsLimit) {
  const std::string request = "GET / HTTP/1.1\r\n" + host() + "\r\n";
  serve(always(text("answer")), [&] {
    std::vector<std::unique_ptr<Client>> clients;
    for (int i = 0; i < 300; ++i) {
      clients.push_back(std::make_unique<Client>(address_));
      clients.back()->send(request);
      EXPECT_EQ(body_of(clients.back()->receive_to("answer")), "answer");
    }
    Client other(address_);
    EXPECT_EQ(other.receive(), "");
    for (const auto& client : clients) client->send(request);
    for (const auto& client : clients) {
      EXPECT_EQ(body_of(client->receive_to("answer")), "answer");
    }
  });
}

// The process has no descriptor for another connection for a while.
TEST_F(ServingPrograms, WaitWhereNoDescriptorIsFree) {
  serve(always(text("answer")), [&] {
    Client early(address_);
    early.send("GET / HTTP/1.1\r\n" + host() + "\r\n");
    EXPECT_EQ(body_of(early.receive_to("answer")), "answer");
    rlimit usual{};
    ::getrlimit(RLIMIT_NOFILE, &usual);
    // The client takes the last one.
    const int next = ::dup(0);
    ::close(next);
    const rlimit few{static_cast<rlim_t>(next) + 1, usual.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &few);
    Client late(address_);
    late.send(get("/"));
    std::this_thread::sleep_for(milliseconds(250));
    // Those that stand are served.
    early.send(get("/"));
    EXPECT_EQ(body_of(early.receive()), "answer");
    ::setrlimit(RLIMIT_NOFILE, &usual);
    EXPECT_EQ(body_of(late.receive()), "answer");
  });
}

}  // namespace
}  // namespace lamina::http
