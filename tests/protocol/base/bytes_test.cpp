#include "protocol/base/bytes.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "protocol/base/split_mix.h"
#include "protocol/base/zip.h"

namespace gnomon {
namespace {

Bytes bytesOf(std::string_view text) {
  return {text.begin(), text.end()};
}

TEST(Ascii, WritesHexAndBase64) {
  EXPECT_EQ(hexText(Bytes{0x00, 0xff}), "00ff");
  // RFC 4648 section 10
  EXPECT_EQ(base64Text(bytesOf("")), "");
  EXPECT_EQ(base64Text(bytesOf("f")), "Zg==");
  EXPECT_EQ(base64Text(bytesOf("fo")), "Zm8=");
  EXPECT_EQ(base64Text(bytesOf("foo")), "Zm9v");
  EXPECT_EQ(base64Text(bytesOf("foob")), "Zm9vYg==");
  EXPECT_EQ(base64Text(bytesOf("fooba")), "Zm9vYmE=");
  EXPECT_EQ(base64Text(bytesOf("foobar")), "Zm9vYmFy");
  EXPECT_EQ(base64Text(Bytes{0xff, 0xfe, 0xfd}), "//79");
}

TEST(Base64, KnownVectors) { // RFC 4648, section 10
  EXPECT_EQ(base64Bytes(""), bytesOf(""));
  EXPECT_EQ(base64Bytes("Zg=="), bytesOf("f"));
  EXPECT_EQ(base64Bytes("Zm8="), bytesOf("fo"));
  EXPECT_EQ(base64Bytes("Zm9vYmFy"), bytesOf("foobar"));
  EXPECT_EQ(base64Bytes("//79"), (Bytes{0xff, 0xfe, 0xfd}));
}

TEST(Base64, RefusesWhatIsNot) {
  for (const char* text : {"Z", "Zg", "Zg=", "Z===", "Zg==Zg==", "Zm9v\n", "Zm9*", "Z=9v", "===="}) {
    EXPECT_FALSE(base64Bytes(text)) << text;
  }
}

TEST(UriText, Base64ComesBack) {
  EXPECT_TRUE(rc::check([](const Bytes& bytes) {
    const std::string text = base64Text(bytes);
    RC_ASSERT(base64Bytes(text) == bytes);
    RC_ASSERT(base64Bytes(text, Base64Padding::optional) == bytes);
    RC_ASSERT(base64Bytes(text.substr(0, text.find('=')), Base64Padding::optional) == bytes);
  }));
}

TEST(UriText, RefusesForeignBase64) {
  for (const char* text : {"A", "AAAAA", "AA-A", "AA A", "=", "A===", "AA=A", "AAAA\n"}) {
    EXPECT_FALSE(base64Bytes(text, Base64Padding::optional)) << text;
  }
  EXPECT_EQ(base64Bytes("", Base64Padding::optional), Bytes{});
}

TEST(UriText, DecodesPercent) {
  EXPECT_EQ(percentDecoded("Box%20With%20Spaces.bin"), "Box With Spaces.bin");
  EXPECT_EQ(percentDecoded("%E2%9d%a4"), "\xE2\x9D\xA4");
  EXPECT_EQ(percentDecoded("a+b"), "a+b");
  for (const char* text : {"%", "%4", "a%4", "%GG", "%4g", "100%.png"}) EXPECT_FALSE(percentDecoded(text)) << text;
}

TEST(UriText, FindsSchemes) {
  EXPECT_EQ(schemeOf("HTTP://a"), "http");
  EXPECT_EQ(schemeOf("data:,x"), "data");
  EXPECT_EQ(schemeOf("c:\\windows"), "c");
  EXPECT_EQ(schemeOf("a/b:c"), "");
  EXPECT_EQ(schemeOf("1:2"), "");
  EXPECT_EQ(schemeOf(":a"), "");
  EXPECT_EQ(schemeOf("plain.bin"), "");
  EXPECT_EQ(schemeOf(""), "");
}

TEST(Bytes, LeastSignificantFirst) {
  EXPECT_EQ(littleEndian({}), 0u);
  EXPECT_EQ(littleEndian(Bytes{0x12, 0x34, 0x56, 0x87}), 0x87563412u);
  EXPECT_EQ(littleEndian(Bytes(8, 0xff)), ~std::uint64_t{0});
}

TEST(Sha256, KnownVectors) { // FIPS 180-2, appendix B
  EXPECT_EQ(Sha256().hex(), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  Sha256 hash;
  hash.add("abc");
  EXPECT_EQ(hash.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Sha256, PiecesAreTheWhole) {
  Sha256 hash;
  hash.add("a");
  hash.add("");
  hash.add(asBytes("bc"));
  EXPECT_EQ(hash.hex(), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

TEST(Hmac, IsThatOfRfc4231) {
  EXPECT_EQ(hmacSha256Hex("Jefe", "what do ya want for nothing?"),
            "5bdcc146bf60754e6a042426089575c75a003f089d2739839dec58b964ec3843");
}

TEST(EqualInConstantTime, IsEquality) {
  EXPECT_TRUE(equalInConstantTime("", ""));
  EXPECT_TRUE(equalInConstantTime("secret", "secret"));
  EXPECT_FALSE(equalInConstantTime("secret", "secreT"));
  EXPECT_FALSE(equalInConstantTime("secret", "secret2"));
}

std::uint64_t zipNumber(std::string_view text, std::size_t at, std::size_t bytes) {
  return littleEndian(asBytes(text.substr(at, bytes)));
}

TEST(Zip, TheCheckIsTheOneThatZipNames) {
  EXPECT_EQ(crc32Of(asBytes("123456789")), 0xcbf43926u); // the check value of CRC-32/ISO-HDLC
  EXPECT_EQ(crc32Of({}), 0u);
  EXPECT_EQ(crc32Of(asBytes("The quick brown fox jumps over the lazy dog")), 0x414fa339u);
}

TEST(Zip, BothHeadsTellTheSameOfAFile) {
  const ZipFile file{.name = "a.npy", .crc32 = 0x12345678, .bytes = 900, .packedBytes = 17, .isDeflated = true};
  const std::string head = zipHead(file);
  const std::string entry = zipDirectoryEntry(file, 4711);
  ASSERT_EQ(head.size(), 30u + 5);
  ASSERT_EQ(entry.size(), 46u + 5);
  EXPECT_EQ(head.substr(6, 22), entry.substr(8, 22)) << "flags to the length of the name";
  EXPECT_EQ(zipNumber(head, 8, 2), 8u) << "deflated";
  EXPECT_EQ(zipNumber(head, 14, 4), 0x12345678u);
  EXPECT_EQ(zipNumber(head, 18, 4), 17u);
  EXPECT_EQ(zipNumber(head, 22, 4), 900u);
  EXPECT_EQ(zipNumber(entry, 42, 4), 4711u);
}

TEST(SplitMix, GivesThePublishedNumbers) {
  constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  EXPECT_EQ(splitMix64(0), 0xe220a8397b1dcdafu);
  EXPECT_EQ(splitMix64(kStep), 0x6e789e6aa1b965f4u);
  EXPECT_EQ(splitMix64(2 * kStep), 0x06c45d188009454fu);
}

TEST(SplitMix, MixesAllButZero) {
  EXPECT_EQ(mixed(0), 0u);
  EXPECT_EQ(mixed(0x9e3779b97f4a7c15u), splitMix64(0));
}

} // namespace
} // namespace gnomon
