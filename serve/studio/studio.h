#pragma once
// The studio: answers the page's requests and sends it events (docs/studio.md).
//
// Who may ask: whoever opens the address that the program prints. Its token
// opens the page once, and leaves a cookie that all other requests need. All
// that a request can name is on a list: designs, printers, formats, files that
// the studio has made.

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "base/file/temporary_files.h"
#include "compiler/request.h"
#include "serve/http/server.h"
#include "serve/run/design_process.h"
#include "serve/run/file_watcher.h"
#include "serve/run/frames.h"
#include "serve/run/names.h"
#include "serve/studio/choice.h"
#include "serve/studio/choice_work.h"

namespace lamina::studio {

struct StudioOptions {
  compiler::Request request;         // of all designs but for the path
  std::string folder;                // of the designs, as it was given
  std::vector<std::string> designs;  // names in it; the first one is shown
  std::size_t evaluation_stack = 0;  // bytes
  unsigned most_seconds = 0;         // of processor time, for one run
  std::string secret;  // of the cookie; another one each time where it is empty
};

class Studio {
 public:
  // say  prints a line for the user
  //
  // All but `options` outlive the studio. Throws FileError where files cannot
  // be watched.
  Studio(StudioOptions options, http::Server& server,
         TemporaryFiles& temporary_files,
         std::function<void(const std::string&)> say);
  ~Studio();
  Studio(const Studio&) = delete;
  Studio& operator=(const Studio&) = delete;

  // The address that opens the page, once.
  //
  // port  that the server listens on
  std::string address(std::uint16_t port);

  void answer(const http::Request& request,
              const std::shared_ptr<http::Reply>& reply);

 private:
  using Reply = std::shared_ptr<http::Reply>;

  // A window with the page.
  struct Client {
    std::string name;
    Reply events;
    std::string design;  // that `process` has read
    // Null: none has been needed.
    std::unique_ptr<serve::DesignProcess> process;
    serve::DesignProcess::Run shown;  // the run that is shown
    std::uint64_t number =
        0;  // of the choice whose last event is to come, or 0
    serve::FrameReader frames;
    std::set<std::string> files;            // that the design depends on
    std::filesystem::file_time_type begin;  // of the run
    // An output or a source that is being made; null: none is.
    Reply waiting;
    serve::DesignProcess::Run made;
    serve::FrameReader made_frames;
    OpenFile file;  // the output's bytes
  };

  // An output that can be fetched.
  struct MadeFile {
    std::string name;
    OpenFile file;
  };

  void answer_get(const http::Request& request, const Reply& reply);
  void answer_post(const http::Request& request, const Reply& reply);
  bool is_known(const http::Request& request) const;
  void open_by_token(const http::Request& request, const Reply& reply);
  void open_events(const Reply& reply);
  void send_file(std::string_view number, const Reply& reply);
  void change(Client& client, const Choice& choice, const std::string& body,
              const Reply& reply);
  void make(Client& client, const Choice& choice, const std::string& body,
            Task task, const Reply& reply);

  // The client's process for the design. Throws Error where the system grants
  // none.
  serve::DesignProcess& process_for(Client& client, const std::string& design);
  void read_shown(Client& client);
  void read_made(Client& client);
  void finish_made(Client& client, const std::string& answer);
  void end_shown(Client& client);
  // why  for who waits for what is made, if somebody does
  void end_made(Client& client, const char* why);
  void say_lost(Client& client);
  void drop(const std::string& name);
  void take_files(Client& client, const std::string& list);
  void watch_files(std::filesystem::file_time_type since);
  void look_at_files();
  void tell_changes();
  static void send(Client& client, std::string_view event);

  StudioOptions options_;
  http::Server& server_;
  TemporaryFiles& temporary_files_;
  std::function<void(const std::string&)> say_;
  serve::Names names_;
  std::string token_;
  std::uint16_t port_ = 0;
  std::map<std::string, std::unique_ptr<Client>, std::less<>> clients_;
  std::map<std::uint64_t, MadeFile> made_files_;
  std::uint64_t last_file_ = 0;
  serve::FileWatcher watcher_;
  bool waits_for_quiet_ = false;
};

// Digits that nobody can guess.
std::string random_digits();

}  // namespace lamina::studio
