#include "server/http/url.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

using Strings = std::vector<std::string>;

Strings pathOf(std::string_view target) {
  auto url = parseTarget(target);
  return url ? url->path : Strings{"refused"};
}

TEST(Url, CutsThePathIntoSegments) {
  EXPECT_EQ(pathOf("/"), Strings{});
  EXPECT_EQ(pathOf("/v1/scenes"), (Strings{"v1", "scenes"}));
  EXPECT_EQ(pathOf("/v1/scenes/"), (Strings{"v1", "scenes", ""}));
  EXPECT_EQ(pathOf("//a"), (Strings{"", "a"}));
}

TEST(Url, DecodesAfterCutting) {
  EXPECT_EQ(pathOf("/a%2Fb/c%20d"), (Strings{"a/b", "c d"}));
  EXPECT_EQ(pathOf("/a+b"), Strings{"a+b"});
}

TEST(Url, ReadsTheQueryInOrder) {
  const auto url = parseTarget("/f?b=1&a=x+y%26z&b=2&empty=&bare&&e=1=2");
  ASSERT_TRUE(url);
  const std::vector<std::pair<std::string, std::string>> expected{{"b", "1"},    {"a", "x y&z"}, {"b", "2"},
                                                                  {"empty", ""}, {"bare", ""},   {"e", "1=2"}};
  EXPECT_EQ(url->query, expected);
}

TEST(Url, RefusesWhatLies) {
  for (const char* target :
       {"", "v1", "/a/../b", "/%2e%2e/b", "/./b", "/a%", "/a%2", "/a%zz", "/a%00b", "/a?x=%0d%0aSet", "/a?%0a=1"}) {
    const auto url = parseTarget(target);
    ASSERT_FALSE(url) << target;
    EXPECT_EQ(url.problems().front().code, ProblemCode::malformed) << target;
  }
}

TEST(Url, DecodesWhatWasEncoded) {
  EXPECT_TRUE(rc::check([] {
    const auto text = *rc::gen::container<std::string>(rc::gen::inRange<char>(0x20, 0x7f));
    std::string encoded;
    for (const char c : text) {
      constexpr std::string_view kDigits = "0123456789ABCDEF";
      encoded += {'%', kDigits[static_cast<unsigned char>(c) >> 4], kDigits[c & 15]};
    }
    const auto decoded = decodeUrlText(encoded, true);
    RC_ASSERT(static_cast<bool>(decoded));
    RC_ASSERT(*decoded == text);
  }));
}

} // namespace
} // namespace gnomon
