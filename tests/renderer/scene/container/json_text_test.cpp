#include "renderer/scene/container/json_text.h"

#include <rapidcheck/gtest.h>

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

/// What a parser makes of the whole text: a value, or the byte that it does not expect.
struct Parsed {
  nlohmann::json value;
  std::size_t byte = 0;
};

Parsed plainlyParsed(const std::string& text) {
  try {
    return {nlohmann::json::parse(text)};
  } catch (const nlohmann::json::parse_error& error) {
    return {{}, error.byte};
  }
}

rc::Gen<std::string> oneOfTexts(std::vector<std::string> texts) {
  return rc::gen::elementOf(std::move(texts));
}

/// A string token: some are long data: URIs, and some of these have what a copy may not take. `isSound`: no token is
/// broken.
rc::Gen<std::string> stringToken(bool isSound) {
  const auto longUri = rc::gen::map(rc::gen::inRange(240, 700), [](int length) {
    return "data:application/octet-stream;base64," + std::string(static_cast<std::size_t>(length - 37), 'A');
  });
  std::vector<std::string> odd{"", "", "", R"(\u0041)", R"(\")", R"(\\)", "\x7f", "\xc3\xa9", "{", ",", "]"};
  if (!isSound) odd.insert(odd.end(), {"\x01", "\xff", "\\", "\""});
  const auto spoiled =
      rc::gen::map(rc::gen::tuple(longUri, oneOfTexts(odd), rc::gen::inRange(0, 240)), [](const auto& parts) {
        std::string uri = std::get<0>(parts);
        return uri.insert(static_cast<std::size_t>(std::get<2>(parts)), std::get<1>(parts));
      });
  const auto content = rc::gen::weightedOneOf<std::string>(
      {{3, spoiled}, {1, oneOfTexts({"", "uri", "data:", "a", R"(\"data:)", R"(data:\u0000)", R"(\\)"})}});
  return rc::gen::map(content, [](const std::string& text) { return '"' + text + '"'; });
}

/// An object; where it is not sound mostly one.
rc::Gen<std::string> objectText(bool isSound) {
  const auto numbers = isSound ? oneOfTexts({"1", "-2.5e3", "null", "true", "[]", "{}"})
                               : oneOfTexts({"1", "false", "[]", "{}", "1e999", "x", ""});
  const auto value = rc::gen::weightedOneOf<std::string>({{4, stringToken(isSound)}, {1, numbers}});
  const auto colon = isSound ? oneOfTexts({":", " : "}) : oneOfTexts({":", ":", ":", ":", " "});
  const auto member = rc::gen::map(rc::gen::tuple(stringToken(isSound), colon, value), [](const auto& parts) {
    return std::get<0>(parts) + std::get<1>(parts) + std::get<2>(parts);
  });
  const auto end = isSound ? oneOfTexts({"}", "} \n"}) : oneOfTexts({"}", "}", "", "]", "}\""});
  const auto several = [](const rc::Gen<std::string>& each) {
    return rc::gen::container<std::vector<std::string>>(each);
  };
  return rc::gen::map(rc::gen::tuple(several(member), several(value), end), [](const auto& parts) {
    std::string text = R"({"list":[)";
    for (const std::string& each : std::get<1>(parts)) text += (text.back() == '[' ? "" : ",") + each;
    text += "]";
    for (const std::string& each : std::get<0>(parts)) text += ",\n " + each;
    return text + std::get<2>(parts);
  });
}

RC_GTEST_PROP(JsonText, LongDataUrisAreWhatTheyWouldBeToAParser, ()) {
  const bool isSound = *rc::gen::arbitrary<bool>();
  const std::string text = *objectText(isSound);
  const auto read = parseJsonText(text, kLimits);
  if (text.find("1e999") != std::string::npos && !read) { // either may come first
    RC_ASSERT(read.problems().front().code == ProblemCode::malformed);
    return;
  }
  const Parsed expected = plainlyParsed(text);
  RC_ASSERT(!isSound || expected.byte == 0);
  if (expected.byte == 0) {
    RC_ASSERT(read);
    RC_ASSERT(*read == expected.value);
  } else {
    RC_ASSERT(!read);
    RC_ASSERT(read.problems().front().detail ==
              "The glTF is not valid JSON: byte " + std::to_string(expected.byte) + " is unexpected.");
  }
}

TEST(JsonText, AKeyThatComesTwiceHasItsLastValueAndNoOther) {
  const std::string first = "data:," + std::string(300, 'a');
  const std::string last = "data:," + std::string(300, 'b');
  const auto quoted = [](const std::string& text) { return '"' + text + '"'; };
  const auto read = parseJsonText("{" + quoted(first) + ":" + quoted(first) + ",\"uri\":" + quoted(first) +
                                      ",\"uri\":" + quoted(last) + ",\"end\":\"\"}",
                                  kLimits);
  ASSERT_TRUE(read);
  EXPECT_EQ(*read, (nlohmann::json{{first, first}, {"uri", last}, {"end", ""}}));
}

} // namespace
} // namespace gnomon
