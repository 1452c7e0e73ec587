#include "protocol/json/json_source.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <rapidcheck.h>

#include "protocol/base/text.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/limits.h"

namespace gnomon {
namespace {

struct Refused {
  std::string pointer;
  ProblemCode code = ProblemCode::internal;
};

Refused refusalOf(std::string_view text) {
  ProblemList problems;
  if (readJson(text, problems) && problems.empty()) return {"taken"};
  return {problems.problems().at(0).pointer, problems.problems().at(0).code};
}

TEST(JsonSource, KeepsOrderAndNumbersOwnText) {
  ProblemList problems;
  const auto root = readJson(R"({"b": 1.50, "a": [18446744073709551616, -3, 7, null, true, "x"]})", problems);
  ASSERT_TRUE(root && problems.empty());
  const auto& object = std::get<JsonNode::Object>(root->value);
  ASSERT_EQ(object.size(), 2u);
  EXPECT_EQ(object[0].key, "b");
  EXPECT_EQ(std::get<JsonReal>(object[0].value.value).text, "1.50");
  const auto& array = std::get<JsonNode::Array>(object[1].value.value);
  ASSERT_EQ(array.size(), 6u);
  EXPECT_EQ(shownNode(array[0]), "18446744073709551616");
  EXPECT_EQ(std::get<std::int64_t>(array[1].value), -3);
  EXPECT_EQ(std::get<std::uint64_t>(array[2].value), 7u);
  EXPECT_EQ(shownNode(array[5]), "\"x\"");
  EXPECT_EQ(shownNode(object[1].value), "an array of 6");
}

TEST(JsonSource, TellsWhereItStopsBeingJson) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", ""},
      {"nul", ""},
      {"{", ""},
      {"{} {}", ""},
      {R"({"a":NaN})", "/a"},
      {R"({"a":Infinity})", "/a"},
      {R"({"a":-Infinity})", "/a"},
      {R"({"a":{"b":[0,1,'x']}})", "/a/b/2"},
      {R"({"a":[1,2)", "/a/2"},
      {R"({"a":[{"b":1},{"c":+1}]})", "/a/1/c"},
      {R"({"a":01})", ""},
      {R"({"a":0x10})", ""},
      {R"({"a":1,})", ""},
      {R"({"a/b":{"c~d":.5}})", "/a~1b/c~0d"},
      {"{\"a\":\"\xC0\x80\"}", "/a"},
      {"{\"a\":\"\x01\"}", "/a"},
      {"{\"a\":\"\\ud800\"}", "/a"},
      {"{\"\xFF\":1}", ""},
      {"// comment\n{}", ""},
  };
  for (const auto& [text, pointer] : cases) {
    const Refused refused = refusalOf(text);
    EXPECT_EQ(refused.pointer, pointer) << text;
    EXPECT_EQ(refused.code, ProblemCode::malformed) << text;
  }
}

TEST(JsonSource, AZeroByteDoesNotEndTheText) {
  using namespace std::string_view_literals;
  EXPECT_EQ(refusalOf("{}\0garbage"sv).code, ProblemCode::malformed);
  EXPECT_EQ(refusalOf("{\"a\":[1,\0]}"sv).pointer, "/a/1");
}

TEST(JsonSource, RefusesNumbersBeyondDoubleWithTheirPlace) {
  for (const std::string number : {"1e999", "-1e999", "1e400"}) {
    ProblemList problems;
    EXPECT_FALSE(readJson(R"({"a":{"b":[0,)" + number + "]}}", problems));
    ASSERT_EQ(problems.problems().size(), 1u);
    EXPECT_EQ(problems.problems()[0].pointer, "/a/b/1");
    EXPECT_EQ(problems.problems()[0].code, ProblemCode::invalidValue);
    EXPECT_EQ(problems.problems()[0].actual, number);
  }
}

TEST(JsonSource, TellsEachKeyThatComesTwiceInOneObject) {
  ProblemList problems;
  const auto root = readJson(R"({"a":1,"b":{"c":1,"d":{"c":2},"c":3},"e":[{"f":1},{"f":1,"f":2}],"a":[]})", problems);
  ASSERT_TRUE(root);
  ASSERT_EQ(problems.problems().size(), 3u);
  EXPECT_EQ(problems.problems()[0].pointer, "/b/c");
  EXPECT_EQ(problems.problems()[1].pointer, "/e/1/f");
  EXPECT_EQ(problems.problems()[2].pointer, "/a");
}

TEST(JsonSource, KeysAreTheSameHoweverTheyAreEscaped) {
  ProblemList problems;
  readJson(R"({"near":1,"ne\u0061r":2})", problems);
  EXPECT_EQ(problems.problems().size(), 1u);
}

TEST(JsonSource, NestingIsBoundedBeforeParsing) {
  const std::string most(static_cast<std::size_t>(kLimits.maxJsonDepth), '[');
  const std::string closed(static_cast<std::size_t>(kLimits.maxJsonDepth), ']');
  EXPECT_EQ(refusalOf(most + closed).pointer, "taken");
  std::string deepest;
  for (int i = 0; i < kLimits.maxJsonDepth; ++i) deepest += "/0";
  EXPECT_EQ(refusalOf(most + "[]" + closed).pointer, deepest);
  EXPECT_EQ(refusalOf(std::string(20'000, '[')).pointer, deepest);

  std::string objects = R"({"shadow":)";
  for (int i = 0; i < 20'000; ++i) objects += R"({"k":)";
  const Refused refused = refusalOf(objects);
  EXPECT_EQ(refused.code, ProblemCode::malformed);
  EXPECT_EQ(refused.pointer.substr(0, 13), "/shadow/k/k/k");
}

TEST(JsonSource, BracketsInStringsAreNoNesting) {
  EXPECT_EQ(refusalOf('"' + std::string(1000, '[') + R"(\"[[)" + '"').pointer, "taken");
}

TEST(JsonSource, LengthIsBounded) {
  const std::string long_ = '"' + std::string(kLimits.maxSpecBytes, 'x') + '"';
  EXPECT_EQ(refusalOf(long_).code, ProblemCode::tooLarge);
}

TEST(JsonSource, AFloodOfProblemsIsCutOff) {
  std::string text = "{";
  for (int i = 0; i < 10'000; ++i) text += "\"a\":1,";
  ProblemList problems;
  readJson(text + "\"a\":1}", problems);
  const Problems all = std::move(problems).take();
  ASSERT_EQ(all.size(), ProblemList::kMax + 1);
  EXPECT_EQ(all.back().actual, "10000");
}

TEST(JsonSource, AnyBytesAreTakenOrRefusedWithUtf8) {
  EXPECT_TRUE(rc::check([](const std::string& noise) {
    std::string text = R"({"camera":{"eye":[1,2.5,-3e2],"up":null},"lights":[{"type":"spot"}]})";
    const std::size_t at = *rc::gen::inRange<std::size_t>(0, text.size());
    text.replace(at, *rc::gen::inRange<std::size_t>(0, 4), noise);
    ProblemList problems;
    const bool taken = readJson(text, problems).has_value();
    RC_ASSERT(taken || !problems.empty());
    for (const Problem& problem : problems.problems()) {
      RC_ASSERT(isUtf8(problem.pointer) && isUtf8(problem.detail) && isUtf8(problem.actual));
    }
    RC_ASSERT(taken == (nlohmann::json::accept(text) && text.find('\0') == std::string::npos));
  }));
}

} // namespace
} // namespace gnomon
