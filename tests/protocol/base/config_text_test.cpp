#include "protocol/base/config_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gnomon {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::string placeOfFault(std::string_view text, const char* says) {
  const auto parsed = parseConfig(text, "a.conf");
  if (parsed.problems.empty()) return "no fault";
  EXPECT_THAT(parsed.problems.front().detail, HasSubstr(says));
  return parsed.problems.front().pointer;
}

TEST(ConfigText, ReadsTextsWordsAndLists) {
  const auto parsed = parseConfig(
      "# first\r\nport = 8080 # not the usual\r\n\r\nstore=\"/var/lib/a #1\"\nkeys = 'C:\\x'\nallowed-hosts = [ 'a', # "
      "one\n"
      "  \"b\",\n]\nrequire-gpu = true\ngpu-scene-bytes = 512MB",
      "a.conf");
  ASSERT_TRUE(parsed.problems.empty());
  ASSERT_EQ(parsed.entries.size(), 6u);
  EXPECT_EQ(parsed.entries[0].key, "port");
  EXPECT_EQ(parsed.entries[0].line, 2);
  EXPECT_THAT(parsed.entries[0].values, ElementsAre("8080"));
  EXPECT_THAT(parsed.entries[1].values, ElementsAre("/var/lib/a #1"));
  EXPECT_THAT(parsed.entries[2].values, ElementsAre("C:\\x"));
  EXPECT_THAT(parsed.entries[3].values, ElementsAre("a", "b"));
  EXPECT_TRUE(parsed.entries[3].isList);
  EXPECT_EQ(parsed.entries[4].line, 9);
  EXPECT_THAT(parsed.entries[5].values, ElementsAre("512MB"));
}

TEST(ConfigText, MayBeginWithAByteOrderMark) {
  const auto parsed = parseConfig("\xEF\xBB\xBFport = 8080\n", "a.conf");
  ASSERT_EQ(parsed.entries.size(), 1u);
  EXPECT_EQ(parsed.entries[0].key, "port");
}

TEST(ConfigText, AFaultHasItsLine) {
  EXPECT_EQ(placeOfFault("\n\nport", "KEY = VALUE"), "a.conf:3");
  EXPECT_EQ(placeOfFault("[serve]\n", "no sections"), "a.conf:1");
  EXPECT_EQ(placeOfFault("port = ", "no value"), "a.conf:1");
  EXPECT_EQ(placeOfFault("store = /a b", "need quotes"), "a.conf:1");
  EXPECT_EQ(placeOfFault("port = 1\nport = 2", "first in line 1"), "a.conf:2");
  EXPECT_EQ(placeOfFault("store = \"/a\nb\"", "closing quote"), "a.conf:1");
  EXPECT_EQ(placeOfFault("store = \"\\x\"", "backslash"), "a.conf:1");
  EXPECT_EQ(placeOfFault("hosts = ['a' 'b']", "commas"), "a.conf:1");
  EXPECT_EQ(placeOfFault("hosts = ['a',\n'b'\n", "began in line 1"), "a.conf:3");
  EXPECT_EQ(placeOfFault("a b = 1", "no key"), "a.conf:1");
  EXPECT_EQ(placeOfFault(std::string_view("a = \0", 5), "UTF-8"), "a.conf");
}

TEST(ConfigText, SectionsHaveNamesAndKeysOfTheirOwn) {
  const auto parsed = parseSections("a = 1\n[ preset.small ] # first\na = 2\nb = 3\n[empty]\n", "f");
  ASSERT_TRUE(parsed.problems.empty());
  ASSERT_EQ(parsed.sections.size(), 3u);
  EXPECT_EQ(parsed.sections[0].name, "");
  EXPECT_THAT(parsed.sections[0].entries.at(0).values, ElementsAre("1"));
  EXPECT_EQ(parsed.sections[1].name, "preset.small");
  EXPECT_EQ(parsed.sections[1].line, 2);
  EXPECT_EQ(parsed.sections[1].entries.size(), 2u);
  EXPECT_EQ(parsed.sections[2].name, "empty");
  EXPECT_TRUE(parsed.sections[2].entries.empty());
}

TEST(ConfigText, AFaultOfASectionHasItsLine) {
  const auto placeOf = [](std::string_view text, const char* says) {
    const auto parsed = parseSections(text, "f");
    if (parsed.problems.empty()) return std::string("no fault");
    EXPECT_THAT(parsed.problems.front().detail, HasSubstr(says));
    return parsed.problems.front().pointer;
  };
  EXPECT_EQ(placeOf("\n[a\n]", "no closing"), "f:2");
  EXPECT_EQ(placeOf("[a", "no closing"), "f:1");
  EXPECT_EQ(placeOf("[]", "no section's name"), "f:1");
  EXPECT_EQ(placeOf("[a..b]", "no section's name"), "f:1");
  EXPECT_EQ(placeOf("[a] b = 1", "follows the name"), "f:1");
  EXPECT_EQ(placeOf("[a]\n[b]\n[a]", "first in line 1"), "f:3");
  EXPECT_EQ(placeOf("[a]\nx = 1\nx = 2", "first in line 2"), "f:3");
}

TEST(ConfigText, AFaultyLineHidesNoOther) {
  const auto parsed = parseConfig("a = 1\nwhat\nb = 2\n[c]\nd = 'x\ne = 3\n", "f");
  std::vector<std::string> keys, places;
  for (const ConfigEntry& entry : parsed.entries) keys.push_back(entry.key);
  for (const Problem& problem : parsed.problems) places.push_back(problem.pointer);
  EXPECT_THAT(keys, ElementsAre("a", "b", "e"));
  EXPECT_THAT(places, ElementsAre("f:2", "f:5", "f:4"));
}

TEST(ConfigText, ManyFaultsAreToldTogetherButNotWithoutEnd) {
  EXPECT_EQ(parseConfig("a\nb\n", "f").problems.size(), 2u);
  std::string many;
  for (int i = 0; i < 1000; ++i) many += "fault\n";
  EXPECT_EQ(parseConfig(many, "f").problems.size(), 20u);
}

RC_GTEST_PROP(ConfigText, AnyTextIsReadBackAsItWas, ()) {
  std::string value = *rc::gen::container<std::string>(
      rc::gen::oneOf(rc::gen::inRange<char>(' ', '\x7f'), rc::gen::elementOf(std::string("\"'\\#\n\t=,[]"))));
  const auto one = parseConfig("key = " + configValue(value), "f");
  RC_ASSERT(one.problems.empty());
  RC_ASSERT(one.entries.at(0).values == std::vector<std::string>{value});
  const std::vector<std::string> values{value, "b", value};
  const auto list = parseConfig("key = " + configList(values) + " # end", "f");
  RC_ASSERT(list.problems.empty());
  RC_ASSERT(list.entries.at(0).values == values);
}

RC_GTEST_PROP(ConfigText, AnyBytesAreReadOrRefused, (const std::string& bytes)) {
  const auto parsed = parseConfig(bytes, "f");
  RC_ASSERT(parsed.entries.size() <= bytes.size());
}

} // namespace
} // namespace gnomon
