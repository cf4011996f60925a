// What a choice comes to: the events of docs/studio.md, from a process that has
// read the design.

#include "serve/studio/choice_work.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "serve/run/frames.h"
#include "tests/support/process.h"
#include "tests/support/temporary_folder.h"

namespace lamina::studio {
namespace {

using Json = nlohmann::json;
using support::TemporaryFolder;

constexpr const char* kBox = R"(/* [Size] */
// how long [mm]
length = 4;  // [1:0.5:20]
name = "a";  // font
tint = "#ff0000";  // color
cube([length, 2, 3]);
)";

// All that a run has sent.
struct Sent {
  std::vector<Json> events;
  std::vector<std::string> files;
  std::string answer;

  std::string kinds() const {
    std::string all;
    for (const Json& event : events) {
      all += event["kind"].get<std::string>() + " ";
    }
    return all;
  }
  // The last event of the kind; null where there is none.
  Json last(const std::string& kind) const {
    Json found;
    for (const Json& event : events) {
      if (event["kind"] == kind) found = event;
    }
    return found;
  }
};

Sent read_all(const OpenFile& pipe) {
  Sent sent;
  serve::FrameReader frames;
  std::string bytes(1 << 16, '\0');
  while (true) {
    const ssize_t size = ::read(pipe.descriptor(), bytes.data(), bytes.size());
    if (size <= 0) return sent;
    frames.add({bytes.data(), static_cast<std::size_t>(size)},
               [&](serve::FrameKind kind, const std::string& frame) {
                 if (kind == serve::FrameKind::kEvent ||
                     kind == serve::FrameKind::kLast) {
                   sent.events.push_back(Json::parse(frame));
                 } else if (kind == serve::FrameKind::kFiles) {
                   sent.files.push_back(frame);
                 } else {
                   sent.answer = frame;
                 }
               });
  }
}

class Bench {
 public:
  // sets  of the file beside the design; empty: there is none
  explicit Bench(const std::string& text, bool reads_anew = false,
                 unsigned most_seconds = 60, const std::string& sets = "") {
    if (!sets.empty()) folder_.write("box.json", sets);
    folder_.write("box.scad", text);
    compiler::Request request;
    request.design.path = path();
    request.job.finds_makers = true;
    ChoiceWork work(request, serve::known_names({}, {"box.scad"}), reads_anew);
    process_ = std::make_unique<serve::DesignProcess>(
        serve::DesignProcess::Options{.request = request,
                                      .work = work,
                                      .temporary_files = files_,
                                      .evaluation_stack = 1 << 20,
                                      .most_seconds = most_seconds});
  }

  static std::string body(int number, const Json& values = Json::object(),
                          const Json& more = Json::object()) {
    Json body = {
        {"number", number}, {"values", values}, {"settings", {{"layer", 0.1}}}};
    body.update(more);
    return body.dump();
  }

  OpenFile start(Task task, const std::string& body, int file = -1) {
    serve::DesignProcess::Run run =
        process_->start({static_cast<char>(task), body}, file);
    last_run_ = run.number;
    return std::move(run.output);
  }
  OpenFile start(const std::string& body) { return start(Task::kShow, body); }
  Sent show(int number, const Json& values = Json::object(),
            const Json& more = Json::object()) {
    return read_all(start(body(number, values, more)));
  }
  Sent source(const Json& values, const std::string& key = "") {
    return read_all(start(Task::kSource, body(1, values, {{"key", key}})));
  }
  void end_last_run() { process_->end(last_run_); }
  std::string path() const { return folder_.path() + "/box.scad"; }
  std::string text() const {
    std::ifstream file(path());
    return {std::istreambuf_iterator<char>(file), {}};
  }
  const TemporaryFolder& folder() const { return folder_; }
  TemporaryFiles& files() { return files_; }

 private:
  TemporaryFolder folder_;
  TemporaryFiles files_;
  std::uint64_t last_run_ = 0;
  std::unique_ptr<serve::DesignProcess> process_;
};

TEST(ChoiceWork, SendsAllOfAChoiceInOrder) {
  Bench bench(kBox);
  const Sent sent = bench.show(17, {{"length", "10"}}, {{"z", 1.23}});
  EXPECT_EQ(sent.kinds(), "form messages layer part report end ");
  for (const Json& event : sent.events) EXPECT_EQ(event["number"], 17);
  EXPECT_NEAR(sent.last("report")["volume"].get<double>(), 10 * 2 * 3, 1e-9);
  // The layer from 1.2 to 1.3 mm, of 30.
  const Json layer = sent.last("layer");
  EXPECT_EQ(layer["index"], 12);
  EXPECT_EQ(layer["count"], 30);
  EXPECT_EQ(layer["row"], sent.last("part")["facts"]["layers"][12]);
  EXPECT_NEAR(layer["row"][6].get<double>(), 20, 1e-9);
  EXPECT_EQ(sent.last("end")["isWell"], true);
}

TEST(ChoiceWork, SendsTheFormToThoseThatLackIt) {
  Bench bench(kBox);
  const Json form = bench.show(1).last("form");
  const Json& parameters = form["parameters"];
  ASSERT_EQ(parameters.size(), 3U);
  EXPECT_EQ(parameters[0]["name"], "length");
  EXPECT_EQ(parameters[0]["caption"], "how long [mm]");
  EXPECT_EQ(parameters[0]["group"], "Size");
  EXPECT_EQ(parameters[0]["step"], 0.5);
  EXPECT_EQ(parameters[1]["widget"], "font");
  EXPECT_EQ(parameters[2]["widget"], "color");
  EXPECT_EQ(bench.show(2, {}, {{"form", form["key"]}}).kinds(),
            "messages layer part report end ");
}

TEST(ChoiceWork, SendsTheSetsBesideTheDesign) {
  Bench bench(kBox, false, 60, R"({"parameterSets":
    {"long": {"length": "20"}}, "fileFormatVersion": "1"})");
  const Json sets = bench.show(1).last("form")["sets"];
  EXPECT_EQ(sets, Json::parse(R"([{"name": "long", "values":
                                   {"length": "20"}}])"));
}

TEST(ChoiceWork, SendsTheSameWhetherItReadsTheDesignAnewOrNot) {
  Bench kept(kBox);
  Bench anew(kBox, true);
  for (const char* length : {"10", "3", "10"}) {
    Sent a = kept.show(1, {{"length", length}});
    Sent b = anew.show(1, {{"length", length}});
    for (Sent* sent : {&a, &b}) sent->events.back().erase("milliseconds");
    EXPECT_EQ(a.events, b.events);
  }
}

TEST(ChoiceWork, SaysWhereATextIsWrong) {
  Bench bench("cube(1);\nsphere(;\n");
  const Sent sent = bench.show(1);
  const Json messages = sent.last("messages")["messages"];
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_EQ(messages[0]["severity"], "error");
  EXPECT_EQ(messages[0]["file"], "box.scad");
  EXPECT_EQ(messages[0]["line"], 2);
  EXPECT_EQ(sent.last("end")["isWell"], false);
  ASSERT_FALSE(sent.files.empty());
  EXPECT_NE(sent.files.back().find("box.scad"), std::string::npos);
}

TEST(ChoiceWork, SaysWhyThereIsNothing) {
  Bench bench("a = 1;\nif (a > 1) cube(1);\n");
  const Sent sent = bench.show(1);
  EXPECT_EQ(sent.last("messages")["messages"][0]["message"],
            "Current top level object is empty.");
  EXPECT_EQ(sent.last("end")["isWell"], false);
  // The next choice finds something.
  EXPECT_EQ(bench.show(2, {{"a", "2"}}).last("end")["isWell"], true);
}

// Of hours where n is large.
constexpr const char* kEndless =
    "n = 1;\na = [for (i = [0:n], j = [0:n], k = [0:n]) if (i < 0) 0];\n"
    "cube(len(a) + 1);\n";

TEST(ChoiceWork, EndsARunWhileAnotherGoesOn) {
  Bench bench(kEndless);
  const OpenFile endless = bench.start(Bench::body(1, {{"n", "9000"}}));
  bench.end_last_run();
  const auto begin = std::chrono::steady_clock::now();
  const Sent next = bench.show(2);
  EXPECT_EQ(next.last("end")["isWell"], true);
  EXPECT_TRUE(read_all(endless).last("end").is_null());
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST(ChoiceWork, SaysThatARunTakesTooLong) {
  Bench bench(kEndless, false, 1);
  const Sent sent = bench.show(1, {{"n", "9000"}});
  EXPECT_EQ(sent.last("messages")["messages"][0]["message"],
            "out of time: --max-time gives it more");
  EXPECT_EQ(sent.last("end")["isWell"], false);
  EXPECT_EQ(bench.show(2).last("end")["isWell"], true);
}

TEST(ChoiceWork, WritesTheBytesOfTheProgram) {
  Bench bench(kBox);
  for (const std::string format : {"slc", "cli", "svg", "layers.json", "csg"}) {
    const OpenFile file(bench.files().open_nameless());
    const Sent sent = read_all(bench.start(
        Task::kWrite, Bench::body(1, {{"length", "7"}}, {{"format", format}}),
        file.descriptor()));
    EXPECT_EQ(sent.answer, R"(200 {"name":"box.)" + format + R"("})");
    const std::string output = bench.folder().path() + "/x." + format;
    support::run_process({LAMINA_PROGRAM, "box.scad", "-D", "length=7",
                          "--layer", "0.1", "-o", output},
                         bench.folder().path());
    std::ifstream written(output);
    const std::string expected{std::istreambuf_iterator<char>(written), {}};
    EXPECT_FALSE(expected.empty()) << format;
    EXPECT_EQ(file.read_at(0, 1 << 20), expected) << format;
  }
}

TEST(ChoiceWork, WritesValuesIntoTheSource) {
  Bench bench(kBox);
  const Json values = {{"length", "7.25"}, {"name", "say \"b\""}};
  const Sent shown = bench.source(values);
  ASSERT_TRUE(shown.answer.starts_with("200 ")) << shown.answer;
  const Json answer = Json::parse(shown.answer.substr(4));
  EXPECT_EQ(answer["diff"],
            "--- box.scad\n+++ box.scad\n"
            "@@ -3,1 +3,1 @@\n"
            "-length = 4;  // [1:0.5:20]\n"
            "+length = 7.25;  // [1:0.5:20]\n"
            "@@ -4,1 +4,1 @@\n"
            "-name = \"a\";  // font\n"
            "+name = \"say \\\"b\\\"\";  // font\n");
  EXPECT_EQ(bench.text(), kBox);
  const Sent written = bench.source(values, answer["key"]);
  EXPECT_EQ(written.answer, R"(200 {"written":"box.scad"})");
  std::string expected = kBox;
  expected.replace(expected.find("= 4"), 3, "= 7.25");
  expected.replace(expected.find("\"a\""), 3, R"("say \"b\"")");
  EXPECT_EQ(bench.text(), expected);
  // It is another text than the one that was shown.
  EXPECT_TRUE(bench.source(values, answer["key"]).answer.starts_with("409 "));
}

}  // namespace
}  // namespace lamina::studio
