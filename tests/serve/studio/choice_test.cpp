// The bodies of a page's requests.

#include "serve/studio/choice.h"

#include <string>

#include <gtest/gtest.h>

#include "compiler/validate.h"

namespace lamina::studio {
namespace {

constexpr const char* kBody = R"({
  "client": "c1", "number": 17, "design": "ring.scad",
  "values": {"size": "54", "holes": "[1, 2]"},
  "settings": {"layer": 0.05, "minFeature": 0.3, "supports": true,
               "printer": "", "material": "", "metal": ""},
  "form": "9c", "z": 3.2})";

std::string fault_of(const std::string& body) {
  try {
    read_choice(body);
  } catch (const ChoiceError& error) {
    return error.diagnostic().message;
  }
  return "none";
}

TEST(Choice, IsReadAsWritten) {
  const Choice choice = read_choice(kBody);
  EXPECT_EQ(choice.client, "c1");
  EXPECT_EQ(choice.number, 17U);
  EXPECT_EQ(choice.design, "ring.scad");
  ASSERT_EQ(choice.values.size(), 2U);
  EXPECT_EQ(choice.values[0].name, "holes");
  EXPECT_EQ(choice.values[0].text, "[1, 2]");
  EXPECT_EQ(choice.job.layer_thickness, 0.05);
  EXPECT_EQ(choice.job.min_feature, 0.3);
  EXPECT_TRUE(choice.job.has_supports);
  EXPECT_EQ(choice.form, "9c");
  EXPECT_EQ(choice.z, 3.2);
}

TEST(Choice, SaysWhatIsWrong) {
  EXPECT_EQ(fault_of("{"), "the body is not JSON");
  EXPECT_EQ(fault_of("[]"), "the body needs an object");
  EXPECT_EQ(fault_of(R"({"number": -1})"),
            "the body needs a whole number as 'number'");
  EXPECT_EQ(fault_of(R"({"number": "1"})"),
            "the body needs a whole number as 'number'");
  EXPECT_EQ(fault_of(R"({"design": 5})"), "the body needs a text as 'design'");
  EXPECT_EQ(fault_of(R"({"z": "high"})"), "the body needs a number as 'z'");
  EXPECT_EQ(fault_of(R"({"values": []})"), "'values' needs an object");
  EXPECT_EQ(fault_of(R"({"values": {"a": 1}})"),
            "'values' needs a text as 'a'");
  EXPECT_EQ(fault_of(R"({"settings": {"supports": 1}})"),
            "'settings' needs true or false as 'supports'");
  EXPECT_EQ(fault_of(R"({"settings": 5})"), "'settings' needs an object");
  EXPECT_EQ(fault_of(std::string(60000, '[')), "the body is not JSON");
}

TEST(Choice, NamesOnlyWhatIsListed) {
  const serve::Names names = serve::known_names({}, {"ring.scad"});
  const auto with = [](const std::string& member, const std::string& value) {
    return read_choice(R"({"settings": {"layer": 0.05, ")" + member +
                       R"(": ")" + value + R"("}})");
  };
  EXPECT_NO_THROW(request_of(with("metal", "brass"), {}, names));
  for (const char* member : {"printer", "material", "metal"}) {
    EXPECT_THROW(request_of(with(member, "/etc/passwd"), {}, names),
                 serve::NameError);
  }
  Choice choice = with("printer", "");
  choice.format = "png";  // a folder
  EXPECT_THROW(request_of(choice, {}, names), serve::NameError);
  choice.format = "sl1";
  EXPECT_EQ(request_of(choice, {}, names).output.format,
            slicer::OutputFormat::kSl1);
}

TEST(Choice, KnowsPartsOfNames) {
  compiler::Request request;
  request.output.printer = "mars 3";
  request.output.metal = "sterling";
  const JobChoice job = job_of(serve::with_known_names(request, kAllFiles));
  EXPECT_EQ(job.printer, "elegoo-mars-3");
  EXPECT_EQ(job.metal, "sterling-silver");
  request.output.metal = "unobtainium";
  EXPECT_THROW(serve::with_known_names(request, kAllFiles), FileError);
}

TEST(Choice, KeepsToTheLimitsOfOptions) {
  const serve::Names names = serve::known_names({}, {"ring.scad"});
  const auto layer = [&](const char* thickness) {
    return request_of(read_choice(std::string(R"({"settings": {"layer": )") +
                                  thickness + "}}"),
                      {}, names);
  };
  EXPECT_EQ(layer("0.05").job.layer_thickness, 0.05);
  for (const char* thickness : {"0", "-1"}) {
    EXPECT_THROW(layer(thickness), compiler::RequestError);
  }
}

}  // namespace
}  // namespace lamina::studio
