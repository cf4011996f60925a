#include "cli/pieces/ledger.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/file/output_digest.h"
#include "base/fingerprint.h"
#include "base/text.h"
#include "base/utf8.h"
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
constexpr std::size_t kLongestError = 1024;

// Digests, 16 bytes in hexadecimal digits.
constexpr std::size_t kDigestLength = 32;

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

// JSON holds UTF-8, paths hold any bytes: one that is no UTF-8 is the list of
// its bytes.
Json json_of_path(const std::string& path) {
  if (is_valid_utf8(path)) return path;
  return std::vector<std::uint8_t>(path.begin(), path.end());
}

std::string path_of_json(const Json& json) {
  if (json.is_string()) return json.get<std::string>();
  const auto bytes = json.get<std::vector<std::uint8_t>>();
  return {bytes.begin(), bytes.end()};
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

// Throws FileError for a file that has not been begun as a ledger: nothing is
// to be added to it.
void require_ledger(const std::string& path, const OpenFile& file) {
  constexpr std::string_view kRead = R"({"read":)";
  constexpr std::string_view kPiece = R"({"row":)";
  const std::string begin = file.read_at(0, kRead.size()).value_or("");
  const auto begins = [&](std::string_view line) {
    return line.starts_with(begin) || begin.starts_with(line);
  };
  if (begins(kRead) || begins(kPiece)) return;
  throw FileError(fmt::format("Can't write '{}': it is no ledger", path));
}

bool are_equal(const timespec& a, const timespec& b) {
  return a.tv_sec == b.tv_sec && a.tv_nsec == b.tv_nsec;
}

// Whether it is the same file with the same bytes. Anyone can set the time of
// the last modification back; the time of change is the machine's own.
bool are_equal(const struct stat& a, const struct stat& b) {
  return a.st_dev == b.st_dev && a.st_ino == b.st_ino &&
         a.st_size == b.st_size && are_equal(a.st_mtim, b.st_mtim) &&
         are_equal(a.st_ctim, b.st_ctim);
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
  const OpenFile file = access_.open(path);
  const auto whole = file ? digest_of_file(file) : std::nullopt;
  if (!whole) return "none";
  const std::lock_guard lock(mutex_);
  known_[path] = {*status, whole->digest};
  return whole->digest;
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
        const std::string path = path_of_json(file.at(0));
        if (files_.digest_of(path) != file.at(1).get<std::string>()) return;
      }
      standing_.insert(json.at("read").get<std::string>());
      return;
    }
    const auto key = json.at("key").get<std::string>();
    const bool is_done = json.at("status").get<std::string>() == "done";
    Entry entry;
    entry.piece = fingerprint(std::string_view(key).substr(0, kDigestLength));
    entry.bytes = json.at("bytes").get<std::uint64_t>();
    entry.output = fingerprint(json.at("digest").get<std::string>());
    auto error = json.at("error").get<std::string>();
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
      if (failures_.size() < Outcomes::kMostRows) {
        failures_[entry.piece] = {std::move(error), std::move(messages)};
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

LedgerIndex::Entry LedgerIndex::find(const std::string& asked_key) const {
  const std::uint64_t wanted = fingerprint(asked_key);
  const auto found = std::lower_bound(
      entries_.begin(), entries_.end(), wanted,
      [](const Entry& a, std::uint64_t value) { return a.piece < value; });
  return found == entries_.end() || found->piece != wanted ? Entry() : *found;
}

LedgerIndex::Failure LedgerIndex::failure_of(const Entry& entry) const {
  const auto found = failures_.find(entry.piece);
  return found == failures_.end() ? Failure() : found->second;
}

bool is_as_noted(const std::string& output, const LedgerIndex::Entry& entry,
                 const FileAccess& access) {
  const auto stands = digest_of_output(output, access, entry.bytes);
  return stands && stands->bytes == entry.bytes &&
         fingerprint(stands->digest) == entry.output;
}

std::string asked_key(const Piece& piece, const std::string& options) {
  const compiler::Request& request = piece.request;
  std::string text = fmt::format("{}\n{}\n{}\n", version(), options,
                                 request.design.definitions);
  if (request.design.parameters) {
    for (const ParameterValue& entry : *request.design.parameters) {
      text +=
          fmt::format("{}={}\n", in_quotes(entry.name), in_quotes(entry.text));
    }
  }
  text += request.output.path.empty()
              ? fmt::format("row {}", piece.number)
              : fmt::format("output {}", request.output.path);
  return digest(text);
}

// --- Writing ----------------------------------------------------------------

Ledger::Ledger(const LedgerOptions& options, const FileAccess& access)
    : options_(options),
      access_(access),
      files_(access),
      file_(AppendFile::open(options.path, access)),
      last_sync_(std::chrono::steady_clock::now()),
      memory_(peak_memory_bytes()) {
  require_ledger(options.path, file_.file());
  if (!options.resumes) return;
  index_.emplace(access);
  index_->read(options.path, file_.file());
  index_->close();
}

bool Ledger::stands(const Piece& piece) const {
  if (!index_) return false;
  const LedgerIndex::Entry entry =
      index_->find(asked_key(piece, options_.asked));
  return entry.state == State::kDone &&
         is_as_noted(piece.request.output.path, entry, access_);
}

void Ledger::note(const Piece& piece, const Outcome& outcome,
                  const std::string& messages,
                  const compiler::Compilation& compilation) {
  const bool is_done = outcome.is_done();
  const std::string& output = piece.request.output.path;
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
               {"error", outcome.error.substr(0, kLongestError)},
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
    if (has_changed_since(compilation.begin, path, access_))
      return kChangedMeanwhile;
    files.push_back({json_of_path(path), files_.digest_of(path)});
  }
  std::string key = digest(line_of(files));
  const std::lock_guard lock(mutex_);
  if (noted_.insert(key).second) {
    append(line_of({{"read", key}, {"files", files}}));
  }
  return key;
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
