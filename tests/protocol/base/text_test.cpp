#include "protocol/base/text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <vector>

#include "protocol/base/scene_bundle.h"
#include "protocol/json/json_codec.h"

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

const std::vector<std::string> kNames{"width", "height", "camera"};

TEST(NearestName, IsTheOneWithTheFewestEdits) {
  EXPECT_EQ(nearestName("widht", kNames), "width");
  EXPECT_EQ(nearestName("Camera", kNames), "camera");
  EXPECT_EQ(nearestName("depth", kNames), "");
  EXPECT_EQ(nearestName("camra", kNames, 0), "");
}

TEST(NearestName, EndsASentence) {
  EXPECT_EQ(suggestion("widht", kNames), "; did you mean width?");
  EXPECT_EQ(suggestion("lens", kNames), ".");
}

TEST(NearestName, IsToldOfFieldsAndViews) {
  const auto detail = [](const Result<FrameSpec>& refused) { return refused.problems().front().detail; };
  EXPECT_EQ(detail(decodeFrameSpec(R"({"widht": 3})")), "There is no field of this name; did you mean width?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"shadow": {"filtr": {}}})")),
            "There is no field of this name; did you mean filter?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"views": ["dept"]})")),
            "This is not one of the possible values; did you mean depth?");
  EXPECT_EQ(detail(decodeFrameQuery({{"view", "shadows"}})),
            "This is not one of the possible values; did you mean shadow?");
  EXPECT_EQ(detail(decodeFrameQuery({{"lights[0].intensty", "3"}})),
            "There is no field of this name; did you mean intensity?");
  EXPECT_EQ(detail(decodeFrameSpec(R"({"xyz": 3})")), "There is no field of this name.");
}

std::string nameOf(std::string_view uri) {
  const auto file = fileUri(uri);
  return file ? file->name : "none";
}

TEST(FileUri, NamesAreOfPlainFolders) {
  for (const char* uri :
       {"a/b.png", "./a/b.png", "a//b.png", "a/c/../b.png", "a%2Fb.png", "a\\b.png", ".\\a%5cb.png"}) {
    EXPECT_EQ(nameOf(uri), "a/b.png") << uri;
    EXPECT_FALSE(fileUri(uri)->isOutside) << uri;
    EXPECT_EQ(fileUri(uri)->hasBackslash, std::string_view(uri).find_first_of("\\5") != std::string_view::npos) << uri;
  }
  EXPECT_EQ(nameOf("a%20b.png"), "a b.png");
}

TEST(FileUri, WhatIsElsewhereIsToldApart) {
  const std::pair<const char*, const char*> names[] = {{"../b.png", "_up/b.png"},
                                                       {"a/../../b.png", "_up/b.png"},
                                                       {"..\\..\\b.png", "_up/_up/b.png"},
                                                       {"/a/b.png", "_root/a/b.png"},
                                                       {"/../a/b.png", "_root/a/b.png"},
                                                       {"//host/b.png", "_root/host/b.png"},
                                                       {"file:///a/b.png", "_root/a/b.png"},
                                                       {"file://localhost/a/b%20c.png", "_root/a/b c.png"}};
  for (const auto& [uri, name] : names) {
    EXPECT_EQ(nameOf(uri), name) << uri;
    EXPECT_TRUE(fileUri(uri)->isOutside) << uri;
  }
  EXPECT_EQ(fileUri("file:///a/b.png")->path, "/a/b.png");
  EXPECT_EQ(fileUri("..\\b.png")->path, "../b.png");
}

TEST(FileUri, OtherAddressesAreNone) {
  for (const char* uri :
       {"data:,x", "http://a/b.png", "c:\\a\\b.png", "", ".", "..", "/", "a/..", "a%zz", "a%00b", "a%0Ab"}) {
    EXPECT_EQ(nameOf(uri), "none") << uri;
  }
}

} // namespace
} // namespace gnomon
