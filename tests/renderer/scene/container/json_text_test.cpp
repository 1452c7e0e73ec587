#include "renderer/scene/container/json_text.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

std::string nested(int depth) {
  std::string text = R"({"asset":{"version":"2.0"},"extras":)";
  text.append(static_cast<std::size_t>(depth), '[').append(static_cast<std::size_t>(depth), ']');
  return text + "}";
}

Problem problemIn(std::string_view text, const Limits& limits = kLimits) {
  const auto document = parseJsonText(text, limits);
  EXPECT_FALSE(document);
  return document ? Problem{} : document.problems().front();
}

TEST(JsonText, CountsDepthBeforeParsing) {
  EXPECT_TRUE(loadGltf(bundleOf(nested(kLimits.maxJsonDepth - 1))));
  EXPECT_EQ(problemIn(nested(kLimits.maxJsonDepth)).code, ProblemCode::tooLarge);
  EXPECT_THAT(problemsOf(bundleOf(nested(20'000))), ::testing::ElementsAre(ProblemAt(ProblemCode::tooLarge, "")));
  EXPECT_THAT(problemsOf(bundleOf(nested(2'000'000))), ::testing::ElementsAre(ProblemAt(ProblemCode::tooLarge, "")));
}

TEST(JsonText, BracketsInStringsAreText) {
  std::string text = R"({"a":")" + std::string(1000, '[') + R"(\"[[\\"})";
  EXPECT_TRUE(parseJsonText(text, kLimits));
}

TEST(JsonText, CountsValues) {
  Limits limits;
  limits.maxJsonValues = 10;
  EXPECT_TRUE(parseJsonText("{\"a\":[1,2,3,4,5,6]}", limits));
  const Problem problem = problemIn("{\"a\":[1,2,3,4,5,6,7,8,9,10]}", limits);
  EXPECT_EQ(problem.code, ProblemCode::tooLarge);
  EXPECT_EQ(problem.limit, "10");
}

TEST(JsonText, TellsWhereTheTextIsBroken) {
  const Problem problem = problemIn(R"({"a":})");
  EXPECT_EQ(problem.code, ProblemCode::malformed);
  EXPECT_THAT(problem.detail, ::testing::HasSubstr("byte 6"));
}

TEST(JsonText, RefusesWhatIsNoJson) {
  for (const std::string text :
       {"{", "{\"a\":1e999}", "{\"a\":NaN}", "{\"\xFF\":1}", "{}x", "{\"a\" 1}", "]", "", "{\"a\":\"\\", "{]"}) {
    EXPECT_EQ(problemIn(text).code, ProblemCode::malformed) << text;
  }
}

} // namespace
} // namespace gnomon
