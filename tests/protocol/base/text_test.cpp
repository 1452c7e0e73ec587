#include "protocol/base/text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

namespace gnomon {
namespace {

using Strings = std::vector<std::string>;

TEST(Text, AcceptsWellFormedUtf8) {
  EXPECT_TRUE(isUtf8(""));
  EXPECT_TRUE(isUtf8("plain"));
  EXPECT_TRUE(isUtf8("\u0080\u07ff\u0800\uffff\U00010000\U0010ffff"));
  EXPECT_TRUE(isUtf8("\xED\x9F\xBF")); // the last before the surrogates
}

TEST(Text, RefusesIllFormedUtf8) {
  for (const char* text : {"\x80", "\xC0\x80", "\xC1\xBF", "\xE0\x80\x80", "\xE0\x9F\xBF", "\xED\xA0\x80",
                           "\xED\xBF\xBF", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF", "\xC3",
                           "\xE4\xB8", "\xF0\x9F\x98", "a\xC3(", "\xE4\x28\xAD"}) {
    EXPECT_FALSE(isUtf8(text)) << text;
  }
}

TEST(Text, ReplacesOnlyWhatIsIllFormed) {
  EXPECT_EQ(asUtf8("a\xFF\u00e9\xC3"), "a?\u00e9?");
  EXPECT_TRUE(rc::check("any bytes become UTF-8, and UTF-8 stays", [](const std::string& bytes) {
    const std::string text = asUtf8(bytes);
    RC_ASSERT(isUtf8(text));
    RC_ASSERT(asUtf8(text) == text);
    RC_ASSERT(isUtf8(bytes) == (text == bytes));
  }));
}

TEST(Text, ShortensAtACharacter) {
  EXPECT_EQ(shortened("abcdef", 6), "abcdef");
  EXPECT_EQ(shortened("abcdefg", 6), "abc\u2026");
  EXPECT_EQ(shortened("ab\u00e9\u00e9\u00e9", 6), "ab\u2026");
  EXPECT_TRUE(rc::check("never longer, still UTF-8", [](const std::string& bytes) {
    const std::size_t most = *rc::gen::inRange<std::size_t>(3, 40);
    const std::string text = shortened(asUtf8(bytes), most);
    RC_ASSERT(text.size() <= most);
    RC_ASSERT(isUtf8(text));
  }));
}

TEST(Text, BeginsAtACharacter) {
  EXPECT_EQ(beginningOf("ab\u00e9", 4), "ab\u00e9");
  EXPECT_EQ(beginningOf("ab\u00e9", 3), "ab");
  EXPECT_EQ(beginningOf("\u00e9", 1), "");
}

TEST(Text, NamesAtMostTwenty) {
  std::vector<std::string_view> names{"a"};
  EXPECT_EQ(oneOf(names), "one of a");
  names.push_back("b");
  EXPECT_EQ(oneOf(names), "one of a, b");
  names.assign(20, "n");
  EXPECT_TRUE(oneOf(names).ends_with("n, n")) << oneOf(names);
  names.resize(23, "left out");
  EXPECT_TRUE(oneOf(names).ends_with("n, n and 3 more")) << oneOf(names);
}

TEST(Ascii, Splits) {
  EXPECT_EQ(splitTrimmed("", ','), Strings{});
  EXPECT_EQ(splitTrimmed("a", ','), Strings{"a"});
  EXPECT_EQ(splitTrimmed(" a ,, b,", ','), (Strings{"a", "", "b", ""}));
  EXPECT_EQ(split("", ','), Strings{""});
  EXPECT_EQ(split(" a ,, b,", ','), (Strings{" a ", "", " b", ""}));
}

TEST(Ascii, Trims) {
  EXPECT_EQ(trimmed(" \ta b\t "), "a b");
  EXPECT_EQ(trimmed(" \t"), "");
}

TEST(Ascii, LowersAsciiOnly) {
  EXPECT_EQ(lowerCase("AZaz\xc3\x84"), "azaz\xc3\x84");
}

TEST(Ascii, QuotesShortAndPrintable) {
  EXPECT_EQ(asciiExcerpt("a\r\nb\xff"), "a??b?");
  EXPECT_EQ(asciiExcerpt(std::string(65, 'a')), std::string(64, 'a') + "...");
}

} // namespace
} // namespace gnomon
