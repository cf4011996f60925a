#include "cli/commands/ledger.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file/output_digest.h"
#include "base/fingerprint.h"
#include "base/version.h"
#include "cli/report/run_report.h"

namespace lamina::cli {
namespace {

using Json = nlohmann::ordered_json;
using State = LedgerIndex::State;

// What a crash of the machine may take. Syncing each line would cost as much as
// a small piece.
constexpr std::chrono::seconds kLongestUnsafe{1};

// Stands for the digest of what was read, and equals none: the piece will be
// made again.
constexpr const char* kChangedMeanwhile = "changed meanwhile";

// Messages of a piece can be endless; a line of the ledger is not.
constexpr std::size_t kLongestMessages = 4096;

// Digests, 16 bytes in hexadecimal digits.
constexpr std::size_t kDigestLength = 32;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// What makes a piece known again: its output or, where it has none, its row.
std::uint64_t piece_fingerprint(std::string_view asked, std::string_view output,
                                std::uint64_t row) {
  return fingerprint(output.empty() ? fmt::format("{}\n\n{}", asked, row)
                                    : fmt::format("{}\n{}", asked, output));
}

std::vector<std::string> lines_of(std::string_view text) {
  std::vector<std::string> lines;
  text = text.substr(0, kLongestMessages);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    lines.emplace_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

bool are_equal(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino &&
         a.st_size == b.st_size && a.st_mtim.tv_sec == b.st_mtim.tv_sec &&
         a.st_mtim.tv_nsec == b.st_mtim.tv_nsec;
}

}  // namespace

std::string FileDigests::digest_of(const std::string& path) {
  const auto status = access_.look_at(path);
  if (!status || !S_ISREG(status->st_mode)) return "none";
  {
    const std::lock_guard lock(mutex_);
    const auto known = known_.find(path);
    if (known != known_.end() && are_equal(known->second.status, *status)) {
      return known->second.digest;
    }
  }
  const auto bytes = access_.read_regular(path);
  if (!bytes) return "none";
  std::string result = digest(*bytes);
  const std::lock_guard lock(mutex_);
  known_[path] = {*status, result};
  return result;
}

// --- Reading ----------------------------------------------------------------

void LedgerIndex::read(const std::string& path, const OpenFile& file) {
  constexpr std::size_t kBlock = std::size_t{1} << 20;
  std::string text;
  for (std::uint64_t offset = 0;;) {
    const auto block = file.read_at(offset, kBlock);
    if (!block) throw FileError(fmt::format("Can't read file '{}'.", path));
    offset += block->size();
    text += *block;
    std::size_t begin = 0;
    for (std::size_t end = text.find('\n'); end != std::string::npos;
         end = text.find('\n', begin)) {
      read_line(std::string_view(text).substr(begin, end - begin));
      begin = end + 1;
    }
    text.erase(0, begin);
    if (block->empty()) break;
  }
  // The last line may lack its end and yet be whole.
  if (!text.empty()) read_line(text);
}

void LedgerIndex::read_line(std::string_view line) {
  if (line.empty()) return;
  // A piece's status is known by its type; all else makes the line unreadable.
  try {
    const Json json = Json::parse(line);
    if (json.contains("files")) {
      for (const Json& file : json.at("files")) {
        const auto path = file.at(0).get<std::string>();
        if (files_.digest_of(path) != file.at(1).get<std::string>()) return;
      }
      standing_.insert(json.at("read").get<std::string>());
      return;
    }
    const auto key = json.at("key").get<std::string>();
    const bool is_done = json.at("status").get<std::string>() == "done";
    Entry entry;
    entry.piece =
        piece_fingerprint(std::string_view(key).substr(0, kDigestLength),
                          json.at("output").get<std::string>(),
                          json.at("row").get<std::uint64_t>());
    entry.bytes = json.at("bytes").get<std::uint64_t>();
    entry.output = fingerprint(json.at("digest").get<std::string>());
    auto messages = json.at("messages").get<std::vector<std::string>>();
    seconds_ += json.at("seconds").get<double>();
    peak_memory_bytes_ =
        std::max(peak_memory_bytes_, json.at("memory").get<std::uint64_t>());
    const std::string read(key, std::min(key.size(), kDigestLength + 1));
    if (!standing_.contains(read)) return;
    if (is_done) {
      entry.times = 1;
      entry.state = State::kDone;
    } else {
      entry.state = State::kFailed;
      if (messages_.size() < Outcomes::kMostRows) {
        messages_[entry.piece] = std::move(messages);
      }
    }
    entries_.push_back(entry);
  } catch (const nlohmann::json::exception&) {
    ++torn_lines_;
  }
}

void LedgerIndex::close() {
  std::stable_sort(
      entries_.begin(), entries_.end(),
      [](const Entry& a, const Entry& b) { return a.piece < b.piece; });
  // Of the lines of a piece one stays, with the number of times that it was
  // done.
  std::size_t kept = 0;
  for (const Entry& entry : entries_) {
    if (kept > 0 && entries_[kept - 1].piece == entry.piece) {
      Entry& before = entries_[kept - 1];
      const std::uint32_t times = before.times + entry.times;
      if (entry.state == State::kDone || before.state != State::kDone) {
        before = entry;
      }
      before.times = times;
    } else {
      entries_[kept++] = entry;
    }
  }
  entries_.resize(kept);
}

LedgerIndex::Entry LedgerIndex::find(const Piece& piece,
                                     const std::string& asked) const {
  const std::uint64_t wanted =
      piece_fingerprint(asked, piece.request.output, piece.number);
  const auto found = std::lower_bound(
      entries_.begin(), entries_.end(), wanted,
      [](const Entry& a, std::uint64_t value) { return a.piece < value; });
  return found == entries_.end() || found->piece != wanted ? Entry() : *found;
}

std::vector<std::string> LedgerIndex::messages_of(const Entry& entry) const {
  const auto found = messages_.find(entry.piece);
  return found == messages_.end() ? std::vector<std::string>() : found->second;
}

bool is_as_noted(const std::string& output, const LedgerIndex::Entry& entry,
                 const FileAccess& access) {
  const auto stands = digest_of_output(output, access);
  return stands && stands->bytes == entry.bytes &&
         fingerprint(stands->digest) == entry.output;
}

std::string asked_key(const Piece& piece, const std::string& options) {
  return digest(fmt::format(
      "{}\n{}\n{}\n{}\n{}", version(), options, piece.request.definitions,
      piece.request.parameter_file, piece.request.parameter_set));
}

// --- Writing ----------------------------------------------------------------

Ledger::Ledger(const LedgerOptions& options, const FileAccess& access)
    : options_(options),
      access_(access),
      files_(access),
      file_(AppendFile::open(options.path, access)),
      last_sync_(std::chrono::steady_clock::now()),
      memory_(peak_memory_bytes()) {
  if (!options.resumes) return;
  index_.emplace(access);
  index_->read(options.path, file_.file());
  index_->close();
}

bool Ledger::stands(const Piece& piece) const {
  if (!index_) return false;
  const LedgerIndex::Entry entry =
      index_->find(piece, asked_key(piece, options_.asked));
  return entry.state == State::kDone &&
         is_as_noted(piece.request.output, entry, access_);
}

void Ledger::note(const Piece& piece, const Outcome& outcome,
                  const std::string& messages,
                  const compiler::Compilation& compilation) {
  const bool is_done = outcome.is_done();
  const std::string& output = piece.request.output;
  const OutputDigest made =
      (is_done ? digest_of_output(output, access_) : std::nullopt)
          .value_or(OutputDigest());
  const std::string read = read_key(compilation);
  const std::chrono::duration<double> seconds =
      std::chrono::steady_clock::now() - compilation.begin;
  Json json = {{"row", piece.number},
               {"line", piece.line},
               {"name", piece.name},
               {"output", output},
               {"key", asked_key(piece, options_.asked) + "." + read},
               {"status", is_done ? "done" : "failed"},
               {"seconds", seconds.count()},
               {"memory", 0},
               {"bytes", made.bytes},
               {"digest", made.digest},
               {"messages", lines_of(messages)}};
  const std::lock_guard lock(mutex_);
  json["memory"] = memory_;
  append(line_of(json));
}

// The second half of the key, whose line is written first.
std::string Ledger::read_key(const compiler::Compilation& compilation) {
  std::vector<std::string> paths = compiler::files_read(compilation);
  std::sort(paths.begin(), paths.end());
  paths.erase(std::unique(paths.begin(), paths.end()), paths.end());
  Json files = Json::array();
  for (const std::string& path : paths) {
    if (has_changed_since(compilation.begin, path)) return kChangedMeanwhile;
    files.push_back({path, files_.digest_of(path)});
  }
  std::string key = digest(line_of(files));
  const std::lock_guard lock(mutex_);
  if (noted_.insert(key).second) {
    append(line_of({{"read", key}, {"files", files}}));
  }
  return key;
}

// Whether the file may be another one than the piece has read. Its time of
// change (ctime) is the machine's own: that of a file that is moved here is
// new, too.
bool Ledger::has_changed_since(std::chrono::steady_clock::time_point begin,
                               const std::string& path) const {
  const auto status = access_.look_at(path);
  if (!status) return false;
  const auto ago = std::chrono::steady_clock::now() - begin;
  const auto at = std::chrono::system_clock::now() - ago;
  const std::chrono::nanoseconds changed =
      std::chrono::seconds(status->st_ctim.tv_sec) +
      std::chrono::nanoseconds(status->st_ctim.tv_nsec);
  return changed > at.time_since_epoch();
}

void Ledger::append(const std::string& line) {
  file_.append(line);
  const auto now = std::chrono::steady_clock::now();
  if (now - last_sync_ < kLongestUnsafe) return;
  file_.sync();
  memory_ = peak_memory_bytes();
  last_sync_ = now;
}

void Ledger::finish() {
  const std::lock_guard lock(mutex_);
  file_.sync();
}

}  // namespace lamina::cli
