// Problems of RFC 9457.

#include "serve/shop/problem.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace lamina::shop {
namespace {

using Json = nlohmann::ordered_json;
using Headers = std::vector<std::pair<std::string, std::string>>;

TEST(Problem, IsThatOfTheDocument) {
  const http::Response response =
      problem(422, "values/carat must be at most 3", {{{"severity", "error"}}});
  EXPECT_EQ(response.status, 422U);
  EXPECT_EQ(response.type, "application/problem+json");
  EXPECT_EQ(response.body,
            R"({"type":"about:blank","title":"Unprocessable Content",)"
            R"("status":422,"detail":"values/carat must be at most 3",)"
            R"("messages":[{"severity":"error"}]})"
            "\n");
  EXPECT_TRUE(response.headers.empty());
}

TEST(Problem, HasNoEmptyListOfMessages) {
  EXPECT_FALSE(Json::parse(problem(404, "x").body).contains("messages"));
  EXPECT_FALSE(
      Json::parse(problem(404, "x", Json::array()).body).contains("messages"));
}

TEST(Problem, SaysWhenToAskAgain) {
  const Headers headers = {{"Retry-After", "5"}};
  EXPECT_EQ(problem(429, "x").headers, headers);
  EXPECT_EQ(problem(503, "x").headers, headers);
  EXPECT_EQ(problem(500, "x").headers, Headers());
}

TEST(Problem, IsJsonWhateverTheDetailHolds) {
  const Json json = Json::parse(problem(400, "\xFF\"\n").body);
  EXPECT_EQ(json["detail"], "\uFFFD\"\n");
  EXPECT_EQ(json["title"], "Bad Request");
}

}  // namespace
}  // namespace lamina::shop
