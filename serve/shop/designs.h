#pragma once
// The designs of a service: a process for each that has been asked for, which
// has read it and makes what orders ask (order_work.h).

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/file/temporary_files.h"
#include "compiler/request.h"
#include "serve/http/server.h"
#include "serve/run/design_process.h"
#include "serve/run/file_watcher.h"
#include "serve/run/frames.h"
#include "serve/run/names.h"
#include "serve/shop/offer.h"

namespace lamina::shop {

struct DesignOptions {
  compiler::Request request;  // of all designs but for the path
  serve::Names names;
  std::string settings;              // what the request was asked for, for keys
  std::string folder;                // ends with '/'
  std::size_t evaluation_stack = 0;  // bytes
  unsigned most_seconds = 0;         // of processor time, for one order
  std::uint64_t most_bytes = 0;      // of memory, likewise
};

// A design as its process has read it.
struct ReadDesign {
  // Orders that run keep it after the design has changed.
  std::shared_ptr<serve::DesignProcess> process;
  std::optional<Offer> offer;
  nlohmann::ordered_json messages;  // why there is no offer
};

class Designs {
 public:
  // changed  is called when files of a design have changed, or its process has
  //          ended: what is known of it is not right any more
  //
  // All but `options` outlive this. Throws FileError where files cannot be
  // watched.
  Designs(DesignOptions options, http::Server& server,
          TemporaryFiles& temporary_files,
          std::function<void(const std::string& name)> changed);
  ~Designs();
  Designs(const Designs&) = delete;
  Designs& operator=(const Designs&) = delete;

  // The names of all designs, in alphabetical order.
  std::vector<std::string> names() const;

  // Whether there is a design of this name.
  bool has(const std::string& name) const;

  // Calls `take` once the design has been read, at once if it has; with null
  // where its process has ended before. The design is valid in that call. Its
  // process may be given up for others later. Throws Error where the system
  // grants no process.
  using Take = std::function<void(ReadDesign* design)>;
  void read(const std::string& name, Take take);

  // Ends the process of a design: the next order starts another one.
  void give_up(const std::string& name);

  // Watches what an order of the design has read.
  //
  // list  of paths, each with '\n'
  void add_files(const std::string& name, const std::string& list);

  // Designs that have a process.
  std::size_t size() const { return entries_.size(); }

 private:
  // What a design has while it has a process.
  struct Entry {
    ReadDesign design;
    bool is_read = false;
    serve::FrameReader frames;
    std::set<std::string> files;
    std::filesystem::file_time_type begin;  // of reading
    std::vector<Take> waiting;
    std::uint64_t last_use = 0;
  };
  using Entries = std::map<std::string, Entry>;

  std::string path_of(const std::string& name) const;
  Entry& begin_to_read(const std::string& name);
  void make_room();
  void take_frames(const std::string& name);
  void finish_reading(Entry& entry, const std::string& event);
  void watch_files(std::filesystem::file_time_type since);
  void look_at_files();
  void drop_changed();

  const DesignOptions options_;
  http::Server& server_;
  TemporaryFiles& temporary_files_;
  const std::function<void(const std::string&)> changed_;
  Entries entries_;
  std::uint64_t uses_ = 0;
  serve::FileWatcher watcher_;
  bool waits_for_quiet_ = false;
};

}  // namespace lamina::shop
