#include "tests/conformance/suite.h"

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

namespace lamina::conformance {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> files_below(const fs::path& folder,
                                  const std::string& ending) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.is_regular_file() &&
        entry.path().filename().string().ends_with(ending)) {
      files.push_back(entry.path());
    }
  }
  std::sort(files.begin(), files.end());
  if (files.empty()) {
    throw std::runtime_error(
        fmt::format("{} holds no *{}", folder.string(), ending));
  }
  return files;
}

// The options with which the suite runs its tests, as far as they have any.
std::vector<std::string> arguments_of(const fs::path& data,
                                      const std::string& category,
                                      const std::string& name) {
  static const std::map<std::string, std::string> kSets = {
      {"customizertest-first", "firstSet"},
      {"customizertest-wrong", "wrongSetValues"},
      {"customizertest-incomplete", "thirdSet"},
      {"customizertest-imgset", "imagine"},
      {"customizertest-setNameWithDot", "Name.dot"}};
  if (const auto set = kSets.find(category); set != kSets.end()) {
    const fs::path file = data / "testdata/scad/customizer/setofparameter.json";
    return {"-p", file.string(), "-P", set->second};
  }
  if (name == "builtin-invalid-range-test") {
    return {"--check-parameter-ranges=on"};
  }
  if (category == "openscad-override") return {"-D", "a=3;"};
  if (category == "openscad-hardwarnings") return {"--hardwarnings"};
  return {};
}

class Collector {
 public:
  explicit Collector(fs::path data) : data_(std::move(data)) {
    for (const char* folder : {"testdata", "examples"}) {
      for (const fs::path& path : files_below(data_ / folder, ".scad")) {
        designs_.emplace(path.stem().string(), path);
      }
    }
  }

  // The tests behind the expected files of a folder.
  void add_expected(const std::string& category, const std::string& format) {
    const std::string ending = "-expected." + format;
    for (const fs::path& expectation :
         files_below(data_ / "regression" / category, ending)) {
      const std::string file = expectation.filename().string();
      const std::string name = file.substr(0, file.size() - ending.size());
      const auto design = designs_.find(name);
      if (design == designs_.end()) {
        suite_.without_design.push_back(
            fmt::format("{}/{}.{}", category, name, format));
        continue;
      }
      add({category, design->second, format,
           arguments_of(data_, category, name), expectation});
    }
  }

  // All designs below a folder, in all formats, but for what is there already.
  void add_all(const std::string& category, const fs::path& folder) {
    for (const fs::path& design : files_below(folder, ".scad")) {
      for (const char* format : {"echo", "csg", "ast"}) {
        if (seen_.contains({design, format})) continue;
        add({category, design, format, {}, {}});
      }
    }
  }

  Suite take() { return std::move(suite_); }

 private:
  void add(Case one) {
    if (one.arguments.empty()) seen_.insert({one.design, one.format});
    suite_.cases.push_back(std::move(one));
  }

  fs::path data_;
  std::map<std::string, fs::path> designs_;
  std::set<std::pair<fs::path, std::string>> seen_;
  Suite suite_;
};

}  // namespace

std::string Case::name() const {
  return fmt::format("{}/{}.{}", category, design.stem().string(), format);
}

Suite collect_suite(const fs::path& data) {
  Collector collector(data);
  collector.add_expected("echotest", "echo");
  collector.add_expected("dumptest", "csg");
  collector.add_expected("dumptest-examples", "csg");
  collector.add_expected("astdumptest", "ast");
  for (const char* category :
       {"customizertest", "customizertest-first", "customizertest-imgset",
        "customizertest-incomplete", "customizertest-setNameWithDot",
        "customizertest-wrong"}) {
    collector.add_expected(category, "ast");
  }
  collector.add_expected("openscad-nonascii", "csg");
  collector.add_expected("openscad-override", "echo");
  collector.add_expected("openscad-hardwarnings", "echo");
  collector.add_all("examples", data / "examples");
  collector.add_all("MCAD", data / "libraries" / "MCAD");
  collector.add_all("testdata", data / "testdata");
  return collector.take();
}

}  // namespace lamina::conformance
