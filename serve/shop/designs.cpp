#include "serve/shop/designs.h"

#include <algorithm>
#include <chrono>
#include <iterator>
#include <string_view>
#include <utility>

#include "base/paths.h"
#include "serve/run/pipe.h"
#include "serve/shop/order_work.h"

namespace lamina::shop {
namespace {

using serve::DesignProcess;
using serve::FrameKind;

// Designs that have a process at once: some 6 MB each.
constexpr std::size_t kMostProcesses = 64;
// Files of one design that are watched: names in it may come from an order.
constexpr std::size_t kMostFiles = 1000;

constexpr std::string_view kScad = ".scad";
constexpr std::string_view kCsg = ".csg";

}  // namespace

Designs::Designs(DesignOptions options, http::Server& server,
                 TemporaryFiles& temporary_files,
                 std::function<void(const std::string&)> changed)
    : options_(std::move(options)),
      server_(server),
      temporary_files_(temporary_files),
      changed_(std::move(changed)) {
  server_.on_readable(watcher_.descriptor(), [this] { look_at_files(); });
}

Designs::~Designs() {
  server_.forget(watcher_.descriptor());
  for (const auto& [name, entry] : entries_) {
    server_.forget(entry.design.process->output());
  }
}

std::vector<std::string> Designs::names() const {
  std::vector<std::string> names;
  for (std::string& file : temporary_files_.file_access()
                               .list(options_.folder)
                               .value_or(std::vector<std::string>())) {
    if (file.starts_with('.')) continue;
    if (file.ends_with(kScad)) {
      file.resize(file.size() - kScad.size());
    } else if (!file.ends_with(kCsg)) {
      continue;
    }
    names.push_back(std::move(file));
  }
  std::ranges::sort(names);
  return names;
}

bool Designs::has(const std::string& name) const {
  const bool is_name = !name.empty() && !name.starts_with('.') &&
                       name.find('/') == std::string::npos &&
                       name.find('\0') == std::string::npos;
  return is_name && temporary_files_.file_access().is_file(path_of(name));
}

std::string Designs::path_of(const std::string& name) const {
  std::string path = options_.folder + name;
  if (!name.ends_with(kCsg)) path += kScad;
  return path;
}

void Designs::read(const std::string& name, Take take) {
  const auto known = entries_.find(name);
  Entry& entry = known == entries_.end() ? begin_to_read(name) : known->second;
  entry.last_use = ++uses_;
  if (entry.is_read) return take(&entry.design);
  entry.waiting.push_back(std::move(take));
}

Designs::Entry& Designs::begin_to_read(const std::string& name) {
  make_room();
  Entry entry;
  compiler::Request request = options_.request;
  request.design.path = path_of(name);
  OrderWork work(request, options_.names, options_.settings);
  entry.begin = serve::FileWatcher::now();
  entry.design.process = std::make_shared<DesignProcess>(
      DesignProcess::Options{.request = std::move(request),
                             .work = work,
                             .temporary_files = temporary_files_,
                             .evaluation_stack = options_.evaluation_stack,
                             .most_seconds = options_.most_seconds,
                             .most_bytes = options_.most_bytes});
  server_.on_readable(entry.design.process->output(),
                      [this, name] { take_frames(name); });
  return entries_.insert_or_assign(name, std::move(entry)).first->second;
}

// Gives up the process that has not been used for longest.
void Designs::make_room() {
  if (entries_.size() < kMostProcesses) return;
  const auto last = std::ranges::min_element(
      entries_, {}, [](const auto& entry) { return entry.second.last_use; });
  give_up(std::string(last->first));
}

void Designs::take_frames(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  Entry& entry = found->second;
  const std::optional<std::string> bytes =
      serve::read_some(entry.design.process->output());
  if (!bytes) return;
  // The process has ended.
  if (bytes->empty()) return give_up(name);
  std::optional<std::string> event;
  entry.frames.add(*bytes, [&](FrameKind kind, std::string frame) {
    if (kind == FrameKind::kFiles) return add_files(name, frame);
    event = std::move(frame);
  });
  if (event) finish_reading(entry, *event);
}

void Designs::finish_reading(Entry& entry, const std::string& event) {
  const auto json = nlohmann::ordered_json::parse(event);
  if (json.contains("parameters")) {
    entry.design.offer.emplace(json["parameters"]);
  } else {
    entry.design.messages = json["messages"];
  }
  entry.is_read = true;
  for (const Take& take : std::exchange(entry.waiting, {})) {
    take(&entry.design);
  }
}

void Designs::give_up(const std::string& name) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  server_.forget(found->second.design.process->output());
  const std::vector<Take> waiting = std::move(found->second.waiting);
  entries_.erase(found);
  changed_(name);
  for (const Take& take : waiting) take(nullptr);
}

void Designs::add_files(const std::string& name, const std::string& list) {
  const auto found = entries_.find(name);
  if (found == entries_.end()) return;
  std::set<std::string>& files = found->second.files;
  const std::size_t before = files.size();
  for (const std::string& file : serve::read_files(list)) {
    if (files.size() < kMostFiles) files.insert(file);
  }
  if (files.size() > before) watch_files(found->second.begin);
}

void Designs::watch_files(std::filesystem::file_time_type since) {
  std::set<std::string> files;
  for (const auto& [name, entry] : entries_) {
    files.insert(entry.files.begin(), entry.files.end());
  }
  watcher_.watch(files, since);
  look_at_files();
}

// One save is several events.
void Designs::look_at_files() {
  if (!watcher_.look() || waits_for_quiet_) return;
  waits_for_quiet_ = true;
  server_.after(
      std::chrono::milliseconds(serve::FileWatcher::kQuietMilliseconds),
      [this] {
        waits_for_quiet_ = false;
        drop_changed();
      });
}

void Designs::drop_changed() {
  const std::set<std::string> changed = watcher_.take_changes();
  std::vector<std::string> names;
  for (const auto& [name, entry] : entries_) {
    const bool is_changed = std::ranges::any_of(
        entry.files,
        [&](const std::string& file) { return changed.contains(file); });
    if (is_changed) names.push_back(name);
  }
  for (const std::string& name : names) give_up(name);
}

}  // namespace lamina::shop
