#include "serve/studio/studio.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/random.h>
#include <unistd.h>

#include "base/paths.h"
#include "base/text.h"
#include "compiler/validate.h"
#include "serve/run/messages.h"
#include "serve/run/pipe.h"
#include "serve/studio/events.h"
#include "serve/studio/page.h"

namespace lamina::studio {
namespace {

using http::content;
using http::Request;
using http::Response;
using serve::DesignProcess;
using serve::FileWatcher;
using serve::FrameKind;
using serve::FrameReader;

constexpr std::size_t kMostClients = 16;
constexpr std::size_t kMostFiles = 16;  // that can be fetched

constexpr const char* kGivenUp = "This was given up: something has changed.";
constexpr const char* kLost = "The process of the design has ended.";

constexpr std::string_view kJson = "application/json";
constexpr std::string_view kHtml = "text/html; charset=utf-8";

Response text(unsigned status, std::string words) {
  Response response;
  response.status = status;
  response.body = std::move(words);
  return response;
}

std::string cookie_name(std::uint16_t port) {
  return fmt::format("lamina-{}", port);
}

}  // namespace

std::string random_digits() {
  std::array<unsigned char, 16> bytes{};
  while (::getrandom(bytes.data(), bytes.size(), 0) < 0) {
  }
  std::string digits;
  for (const unsigned char byte : bytes) digits += fmt::format("{:02x}", byte);
  return digits;
}

Studio::Studio(StudioOptions options, http::Server& server,
               TemporaryFiles& temporary_files,
               std::function<void(const std::string&)> say)
    : options_(std::move(options)),
      server_(server),
      temporary_files_(temporary_files),
      say_(std::move(say)),
      names_(serve::known_names(options_.request, options_.designs)),
      token_(random_digits()) {
  if (options_.secret.empty()) options_.secret = random_digits();
  server_.on_readable(watcher_.descriptor(), [this] { look_at_files(); });
}

Studio::~Studio() { server_.forget(watcher_.descriptor()); }

std::string Studio::address(std::uint16_t port) {
  port_ = port;
  return fmt::format("http://127.0.0.1:{}/?token={}", port, token_);
}

void Studio::answer(const Request& request, const Reply& reply) {
  try {
    if (request.method == "POST") {
      answer_post(request, reply);
    } else {
      answer_get(request, reply);
    }
  } catch (const Error& error) {
    // Of a choice that is not as docs/studio.md says, or beyond limits.
    reply->send(text(400, error.diagnostic().message));
  }
}

bool Studio::is_known(const Request& request) const {
  return request.cookie(cookie_name(port_)) == options_.secret;
}

void Studio::answer_get(const Request& request, const Reply& reply) {
  if (request.query.starts_with("token=")) return open_by_token(request, reply);
  if (!is_known(request)) {
    return reply->send(text(
        403, "Open the studio by the address that 'lamina studio' prints."));
  }
  constexpr std::string_view kFile = "/file/";
  if (request.path == "/") {
    reply->send(content(kHtml, page_html()));
  } else if (request.path == "/studio.css") {
    reply->send(content("text/css; charset=utf-8", page_style()));
  } else if (request.path == "/studio.js") {
    reply->send(content("text/javascript; charset=utf-8", page_script()));
  } else if (request.path == "/events") {
    open_events(reply);
  } else if (request.path.starts_with(kFile)) {
    send_file(std::string_view(request.path).substr(kFile.size()), reply);
  } else {
    reply->send(text(404, "There is nothing here."));
  }
}

// The token is good once: who finds the address later, in a history or a list
// of processes, cannot use it.
void Studio::open_by_token(const Request& request, const Reply& reply) {
  const bool is_right =
      request.path == "/" && request.query == "token=" + token_;
  if (!is_right && !is_known(request)) {
    return reply->send(
        text(403,
             "This address has been used. Open the last one that 'lamina "
             "studio' has printed."));
  }
  Response response = text(303, "");
  response.headers = {{"Location", "/"}};
  if (is_right) {
    token_ = random_digits();
    say_(fmt::format("in another browser: {}", address(port_)));
    response.headers.emplace_back(
        "Set-Cookie", fmt::format("{}={}; HttpOnly; SameSite=Strict; Path=/",
                                  cookie_name(port_), options_.secret));
  }
  reply->send(std::move(response));
}

void Studio::open_events(const Reply& reply) {
  if (clients_.size() >= kMostClients) {
    return reply->send(text(503, "Too many windows are open."));
  }
  auto client = std::make_unique<Client>();
  client->name = random_digits();
  client->events = reply;
  reply->begin(content("text/event-stream", ""));
  send(*client, hello_event(client->name, names_, names_.designs.front(),
                            job_of(options_.request)));
  const std::string name = client->name;
  clients_[name] = std::move(client);
  reply->on_close([this, name] { drop(name); });
}

void Studio::send_file(std::string_view number, const Reply& reply) {
  const auto wanted = parse_number(number);
  const auto found = wanted && *wanted >= 0 && *wanted < 1e9
                         ? made_files_.find(static_cast<std::uint64_t>(*wanted))
                         : made_files_.end();
  if (found == made_files_.end()) {
    return reply->send(text(404, "This file is not kept any more."));
  }
  const MadeFile& made = found->second;
  Response response = content("application/octet-stream", "");
  response.file = fmt::format("/proc/self/fd/{}", made.file.descriptor());
  response.headers = {http::attachment(made.name)};
  reply->send(std::move(response));
}

void Studio::answer_post(const Request& request, const Reply& reply) {
  if (!is_known(request)) return reply->send(text(403, "Who asks?"));
  if (request.content_type != kJson) {
    return reply->send(text(415, "JSON was expected."));
  }
  const bool is_source = request.path == "/source";
  if (request.path != "/change" && request.path != "/output" && !is_source) {
    return reply->send(text(404, "There is nothing here."));
  }
  const Choice choice = read_choice(request.body);
  const auto client = clients_.find(choice.client);
  if (client == clients_.end()) {
    return reply->send(text(404, "The studio does not know this window."));
  }
  if (std::ranges::find(names_.designs, choice.design) ==
      names_.designs.end()) {
    return reply->send(text(404, "There is no such design."));
  }
  request_of(choice, options_.request, names_);  // throws
  if (request.path == "/change") {
    return change(*client->second, choice, request.body, reply);
  }
  if (!is_source && choice.format.empty()) {
    return reply->send(text(400, "'format' is missing."));
  }
  make(*client->second, choice, request.body,
       is_source ? Task::kSource : Task::kWrite, reply);
}

DesignProcess& Studio::process_for(Client& client, const std::string& design) {
  if (client.process && client.design == design) return *client.process;
  compiler::Request request = options_.request;
  request.design.path = options_.folder + design;
  ChoiceWork work(request, names_);
  client.design = design;
  client.process = std::make_unique<DesignProcess>(
      DesignProcess::Options{.request = std::move(request),
                             .work = work,
                             .temporary_files = temporary_files_,
                             .evaluation_stack = options_.evaluation_stack,
                             .most_seconds = options_.most_seconds});
  return *client.process;
}

void Studio::change(Client& client, const Choice& choice,
                    const std::string& body, const Reply& reply) {
  end_shown(client);
  client.begin = FileWatcher::now();
  client.shown = process_for(client, choice.design)
                     .start({static_cast<char>(Task::kShow), body});
  if (!client.shown.output) {
    client.process.reset();
    return reply->send(text(503, "The system grants no process."));
  }
  client.number = choice.number;
  reply->send(text(202, ""));
  server_.on_readable(client.shown.output.descriptor(),
                      [this, &client] { read_shown(client); });
}

void Studio::make(Client& client, const Choice& choice, const std::string& body,
                  Task task, const Reply& reply) {
  end_made(client, kGivenUp);
  DesignProcess& process = process_for(client, choice.design);
  if (task == Task::kWrite) {
    client.file = OpenFile(temporary_files_.open_nameless());
    if (!client.file) {
      return reply->send(text(503, "There is no room for the file."));
    }
  }
  client.made =
      process.start({static_cast<char>(task), body}, client.file.descriptor());
  if (!client.made.output) {
    return reply->send(text(503, "The system grants no process."));
  }
  client.waiting = reply;
  server_.on_readable(client.made.output.descriptor(),
                      [this, &client] { read_made(client); });
}

void Studio::read_shown(Client& client) {
  const std::optional<std::string> bytes =
      serve::read_some(client.shown.output.descriptor());
  if (!bytes) return;
  if (bytes->empty()) {
    end_shown(client);
    return say_lost(client);
  }
  client.frames.add(*bytes, [&](FrameKind kind, const std::string& frame) {
    if (kind == FrameKind::kFiles) return take_files(client, frame);
    if (kind == FrameKind::kLast) client.number = 0;
    send(client, frame);
  });
}

// Ends a choice whose process has ended before it: the design's own, too.
void Studio::say_lost(Client& client) {
  const std::uint64_t number = std::exchange(client.number, 0);
  if (number == 0) return;
  client.process.reset();
  const Diagnostic why{Severity::kError,
                       {},
                       "the process of the design was ended by the system"};
  send(client,
       messages_event(number, serve::text_of(serve::messages_json({why}, ""))));
  send(client, end_event(number, false, -1, 0));
}

void Studio::read_made(Client& client) {
  const std::optional<std::string> bytes =
      serve::read_some(client.made.output.descriptor());
  if (!bytes) return;
  std::optional<std::string> answer;
  client.made_frames.add(*bytes, [&](FrameKind kind, std::string frame) {
    if (kind == FrameKind::kAnswer) answer = std::move(frame);
  });
  if (answer) return finish_made(client, *answer);
  if (bytes->empty()) end_made(client, kLost);
}

// answer  "200 {…}"
void Studio::finish_made(Client& client, const std::string& answer) {
  const Reply reply = std::exchange(client.waiting, nullptr);
  auto [status, json] = serve::read_answer(answer);
  if (status == 200 && client.file) {
    const std::uint64_t number = ++last_file_;
    const std::string name = name_in_answer(json);
    made_files_[number] = {name, std::move(client.file)};
    if (made_files_.size() > kMostFiles) made_files_.erase(made_files_.begin());
    json = file_answer(number, name);
  }
  end_made(client, kLost);
  Response response = content(kJson, std::move(json));
  response.status = status;
  if (reply) reply->send(std::move(response));
}

void Studio::end_shown(Client& client) {
  if (client.shown.output) {
    server_.forget(client.shown.output.descriptor());
    if (client.process) client.process->end(client.shown.number);
  }
  client.shown = {};
  client.frames = FrameReader();
}

void Studio::end_made(Client& client, const char* why) {
  if (client.made.output) {
    server_.forget(client.made.output.descriptor());
    if (client.process) client.process->end(client.made.number);
  }
  client.made = {};
  client.made_frames = FrameReader();
  client.file = OpenFile();
  if (const Reply reply = std::exchange(client.waiting, nullptr)) {
    reply->send(text(503, why));
  }
}

void Studio::drop(const std::string& name) {
  const auto found = clients_.find(name);
  if (found == clients_.end()) return;
  end_shown(*found->second);
  end_made(*found->second, kGivenUp);
  clients_.erase(found);
}

void Studio::take_files(Client& client, const std::string& list) {
  std::set<std::string> files = serve::read_files(list);
  if (files == client.files) return;
  client.files = std::move(files);
  watch_files(client.begin);
}

void Studio::watch_files(std::filesystem::file_time_type since) {
  std::set<std::string> files;
  for (const auto& [name, client] : clients_) {
    files.insert(client->files.begin(), client->files.end());
  }
  watcher_.watch(files, since);
  look_at_files();
}

// One save is several events: what has changed is said when no more come.
void Studio::look_at_files() {
  if (!watcher_.look() || waits_for_quiet_) return;
  waits_for_quiet_ = true;
  server_.after(std::chrono::milliseconds(FileWatcher::kQuietMilliseconds),
                [this] {
                  waits_for_quiet_ = false;
                  tell_changes();
                });
}

void Studio::tell_changes() {
  const std::set<std::string> changed = watcher_.take_changes();
  for (const auto& [name, client] : clients_) {
    std::vector<std::string> files;
    std::ranges::set_intersection(changed, client->files,
                                  std::back_inserter(files));
    if (files.empty()) continue;
    // The process has read the design as it was.
    end_shown(*client);
    end_made(*client, kGivenUp);
    client->process.reset();
    for (std::string& file : files) file = shown_path(file);
    send(*client, changed_event(files));
  }
}

void Studio::send(Client& client, std::string_view event) {
  client.events->write(fmt::format("data: {}\n\n", event));
}

}  // namespace lamina::studio
