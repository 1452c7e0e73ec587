#include "renderer/scene/container/uri_text.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <string>

namespace gnomon {
namespace {

std::string base64(const Bytes& bytes) {
  static constexpr char kAlphabet[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k) bits = bits << 8 | (k < count ? bytes[i + k] : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kAlphabet[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

TEST(UriText, Base64ComesBack) {
  EXPECT_TRUE(rc::check([](const Bytes& bytes) {
    const std::string text = base64(bytes);
    RC_ASSERT(decodeBase64(text) == bytes);
    RC_ASSERT(decodeBase64(text.substr(0, text.find('='))) == bytes);
  }));
}

TEST(UriText, RefusesForeignBase64) {
  for (const char* text : {"A", "AAAAA", "AA-A", "AA A", "=", "A===", "AA=A", "AAAA\n"}) {
    EXPECT_FALSE(decodeBase64(text)) << text;
  }
  EXPECT_EQ(decodeBase64(""), Bytes{});
}

TEST(UriText, DecodesPercent) {
  EXPECT_EQ(decodePercent("Box%20With%20Spaces.bin"), "Box With Spaces.bin");
  EXPECT_EQ(decodePercent("%E2%9d%a4"), "\xE2\x9D\xA4");
  for (const char* text : {"%", "%4", "a%4", "%GG", "%4g", "100%.png"}) EXPECT_FALSE(decodePercent(text)) << text;
}

TEST(UriText, FindsSchemes) {
  EXPECT_EQ(schemeOf("HTTP://a"), "http");
  EXPECT_EQ(schemeOf("data:,x"), "data");
  EXPECT_EQ(schemeOf("c:\\windows"), "c");
  EXPECT_EQ(schemeOf("a/b:c"), "");
  EXPECT_EQ(schemeOf("1:2"), "");
  EXPECT_EQ(schemeOf("plain.bin"), "");
  EXPECT_EQ(schemeOf(""), "");
}

} // namespace
} // namespace gnomon
