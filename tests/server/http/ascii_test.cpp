#include "server/http/ascii.h"

#include <gtest/gtest.h>

namespace gnomon {
namespace {

using Strings = std::vector<std::string>;

TEST(Ascii, Splits) {
  EXPECT_EQ(split("", ','), Strings{});
  EXPECT_EQ(split("a", ','), Strings{"a"});
  EXPECT_EQ(split(" a ,, b,", ','), (Strings{"a", "", "b", ""}));
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

TEST(Ascii, WritesHexAndBase64) {
  EXPECT_EQ(hexText(std::string_view("\x00\xff", 2)), "00ff");
  // RFC 4648 section 10
  EXPECT_EQ(base64Text(""), "");
  EXPECT_EQ(base64Text("f"), "Zg==");
  EXPECT_EQ(base64Text("fo"), "Zm8=");
  EXPECT_EQ(base64Text("foo"), "Zm9v");
  EXPECT_EQ(base64Text("foob"), "Zm9vYg==");
  EXPECT_EQ(base64Text("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64Text("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64Text("\xff\xfe\xfd"), "//79");
}

} // namespace
} // namespace gnomon
