#include "csg/eval/code/argument_plan.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace lamina::csg {
namespace {

std::vector<Parameter> parameters(const std::vector<std::string_view>& names) {
  std::vector<Parameter> made;
  for (const std::string_view name : names) {
    Parameter& parameter = made.emplace_back();
    parameter.name = name;
    parameter.target = {Target::Kind::kSlot,
                        static_cast<std::uint32_t>(made.size() - 1), nullptr};
  }
  return made;
}

// Of each parameter the argument that it gets; −1: none.
std::vector<int> arguments_of(const ArgumentPlan& plan, std::size_t count) {
  std::vector<int> arguments(count, -1);
  for (const BoundArgument& bound : plan.bound) {
    if (bound.target.kind == Target::Kind::kSlot) {
      arguments.at(bound.target.index) = static_cast<int>(bound.written);
    }
  }
  return arguments;
}

ArgumentPlan plan(const std::vector<std::string_view>& names,
                  std::size_t positional,
                  const std::vector<WrittenArgument>& written,
                  Surplus surplus = Surplus::kWarn,
                  Language language = Language::k2021) {
  DynamicNames dynamic;
  return plan_arguments(parameters(names), positional, written, dynamic,
                        language, surplus);
}

std::vector<std::string> words_of(const ArgumentPlan& plan) {
  std::vector<std::string> words;
  for (const ArgumentWarning& warning : plan.warnings) {
    words.push_back(warning.words);
  }
  return words;
}

TEST(PlanArguments, GoByPositionAndByName) {
  const ArgumentPlan made = plan({"a", "b", "c"}, 3, {{"c"}, {""}, {""}});
  EXPECT_EQ(arguments_of(made, 3), (std::vector<int>{1, 2, 0}));
  EXPECT_TRUE(made.warnings.empty());
}

TEST(PlanArguments, PositionsReachNoFurtherThanTheyMay) {
  const ArgumentPlan made = plan({"a", "b"}, 1, {{""}, {""}, {""}});
  EXPECT_EQ(arguments_of(made, 2), (std::vector<int>{0, -1}));
  EXPECT_EQ(words_of(made),
            (std::vector<std::string>{"Too many unnamed arguments supplied"}));
}

TEST(PlanArguments, TheLastOfANameCounts) {
  const ArgumentPlan made = plan({"a"}, 1, {{"a"}, {"a"}});
  EXPECT_EQ(arguments_of(made, 1), std::vector<int>{1});
  EXPECT_EQ(words_of(made),
            (std::vector<std::string>{"argument a supplied more than once"}));
}

TEST(PlanArguments, WarnOfNamesThatAreNoParametersIfAsked) {
  EXPECT_EQ(
      words_of(plan({"a"}, 1, {{"x"}})),
      (std::vector<std::string>{"variable x not specified as parameter"}));
  EXPECT_TRUE(plan({"a"}, 1, {{"x"}}, Surplus::kSilent).warnings.empty());
  EXPECT_TRUE(plan({"a"}, 1, {{"$x"}}).warnings.empty());
}

TEST(PlanArguments, HintsAtWhatWasMeant) {
  const auto hint = [](const ArgumentPlan& made) {
    return made.warnings.at(0).hint;
  };
  EXPECT_EQ(hint(plan({"height", "center"}, 1, {{"hieght"}})),
            "did you mean 'height'?");
  EXPECT_EQ(hint(plan({"a", "b"}, 1, {{"x"}})), "the parameters are a, b");
  EXPECT_EQ(hint(plan({"r"}, 1, {{""}, {""}})), "the parameters are r");
  EXPECT_EQ(hint(plan({"size", "center"}, 2, {{""}, {""}, {""}})),
            "the parameters are size, center; several numbers for one stand in "
            "[ ]");
}

TEST(PlanArguments, EvaluatesFallbacksThatAreNeededOrNoticed) {
  std::vector<Parameter> three = parameters({"a", "b", "c"});
  three[1].has_silent_fallback = false;
  DynamicNames dynamic;
  const std::vector<WrittenArgument> written = {{"a"}, {"b"}};
  const ArgumentPlan made =
      plan_arguments(three, 3, written, dynamic, Language::k2021);
  EXPECT_EQ(made.defaults, (std::vector<std::uint32_t>{1, 2}));
}

TEST(PlanArguments, GoToTheNextFreeParameterSince2026) {
  const ArgumentPlan made = plan({"a", "b", "c"}, 3, {{"a"}, {""}, {"b"}},
                                 Surplus::kWarn, Language::k2026);
  // In the order of the text: the last one of a parameter counts.
  EXPECT_EQ(arguments_of(made, 3), (std::vector<int>{0, 2, -1}));
  EXPECT_EQ(words_of(made),
            (std::vector<std::string>{"argument \"b\" overrides positional "
                                      "argument"}));
  EXPECT_EQ(made.defaults, (std::vector<std::uint32_t>{2}));
  EXPECT_TRUE(made.evaluates_fallbacks_last);
}

TEST(PlanArguments, FindsParametersInLongLists) {
  std::vector<std::string> names;
  for (int i = 0; i < 40; ++i) names.push_back(std::to_string(i));
  const ArgumentPlan made =
      plan({names.begin(), names.end()}, 40, {{"39"}, {""}});
  const std::vector<int> arguments = arguments_of(made, 40);
  EXPECT_EQ(arguments[39], 0);
  EXPECT_EQ(arguments[0], 1);
}

TEST(DynamicNames, GiveEachNameOneNumber) {
  DynamicNames names;
  EXPECT_EQ(names.find("$fn"), kFn);
  EXPECT_EQ(names.find("$support"), kSupport);
  EXPECT_EQ(names.find("$visible"), kVisible);
  EXPECT_EQ(names.find("$rigid"), kRigid);
  EXPECT_EQ(names.find("$mine"), std::nullopt);
  const std::uint32_t mine = names.number_of("$mine");
  EXPECT_EQ(mine, kRigid + 1);
  EXPECT_EQ(names.number_of("$mine"), mine);
  EXPECT_EQ(names.size(), mine + 1U);
}

TEST(DynamicNames, ChildrenIsAVariableOfItsModule) {
  EXPECT_TRUE(is_dynamic_name("$x"));
  EXPECT_FALSE(is_dynamic_name("$children"));
  EXPECT_FALSE(is_dynamic_name("x"));
  EXPECT_FALSE(is_dynamic_name(""));
}

}  // namespace
}  // namespace lamina::csg
