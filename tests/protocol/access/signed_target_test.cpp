#include "protocol/access/signed_target.h"

#include <gtest/gtest.h>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

constexpr std::string_view kSecret = "a secret for signing";

TEST(SignedTarget, IsReadAsItWasMade) {
  for (const char* target : {"/v1/scenes/x/frame", "/v1/scenes/x/frame?sun=1%2C2&view=depth"}) {
    const std::string made = signedTarget(target, 1'900'000'000, "shop", kSecret);
    const auto read = readSignedTarget(made);
    ASSERT_TRUE(read) << made;
    EXPECT_EQ(read->expires, 1'900'000'000);
    EXPECT_EQ(read->key, "shop");
    EXPECT_TRUE(made.starts_with(target));
    EXPECT_TRUE(isSignedBy(*read, kSecret));
    EXPECT_FALSE(isSignedBy(*read, "another secret"));
  }
}

TEST(SignedTarget, TheSignatureIsAnHmacOfAllThatComesBeforeIt) {
  const std::string text = "/a?b=c&expires=12&key=shop";
  EXPECT_EQ(signedTarget("/a?b=c", 12, "shop", kSecret), text + "&signature=" + hmacSha256Hex(kSecret, text));
}

TEST(SignedTarget, NoByteOfItCanBeChanged) {
  const std::string made = signedTarget("/v1/scenes/x/frame?width=64", 1'900'000'000, "shop", kSecret);
  for (std::size_t i = 0; i < made.size(); ++i) {
    std::string changed = made;
    changed[i] = changed[i] == '1' ? '2' : '1';
    const auto read = readSignedTarget(changed);
    EXPECT_FALSE(read && isSignedBy(*read, kSecret)) << changed;
  }
  for (const std::string& changed : {made + "&height=9", made + "0", made.substr(0, made.size() - 1)}) {
    const auto read = readSignedTarget(changed);
    EXPECT_FALSE(read && isSignedBy(*read, kSecret)) << changed;
  }
}

TEST(SignedTarget, WhatIsNotMadeLikeThatIsNotRead) {
  for (const char* target :
       {"", "/a", "/a?signature=", "/a?expires=1&key=k", "/a?key=k&expires=1&signature=0", "/a?expires=1&signature=0",
        "/a?expires=x&key=k&signature=0", "/a?expires=&key=k&signature=0",
        "/a?expires=99999999999999999999&key=k&signature=0", "/a?expires=1&key=k&signatures=0"}) {
    EXPECT_FALSE(readSignedTarget(target)) << target;
  }
}

} // namespace
} // namespace gnomon
