#include "protocol/access/access_key.h"

#include <gtest/gtest.h>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

const std::string kHash(64, 'a');

/// The sentences about a key file that is wrong.
std::vector<std::string> faults(std::string_view text) {
  const auto keys = parseKeyFile(text);
  std::vector<std::string> sentences;
  if (keys) return sentences;
  for (const Problem& problem : keys.problems()) sentences.push_back(problem.detail);
  return sentences;
}

TEST(KeyFile, HoldsOneKeyALine) {
  const auto keys = parseKeyFile("# who may draw\n\nname=web sha256=" + std::string(64, 'A') +
                                 " scopes=read,render requestsPerSecond=2.5 burst=10 concurrent=3\r\n"
                                 "name=ci\tsha256=" +
                                 kHash + " sha256=" + std::string(64, 'b') +
                                 " scopes=admin signingSecret=0123456789abcdef # replaced next week");
  ASSERT_TRUE(keys);
  ASSERT_EQ(keys->size(), 2u);
  const AccessKey& web = keys->front();
  EXPECT_EQ(web.name, "web");
  EXPECT_EQ(web.secretHashes, std::vector<std::string>{kHash});
  EXPECT_EQ(scopeText(web.scope), "read,render");
  EXPECT_EQ(web.requestsPerSecond, 2.5);
  EXPECT_EQ(web.burst, 10);
  EXPECT_EQ(web.concurrent, 3u);
  const AccessKey& ci = keys->back();
  EXPECT_EQ(ci.secretHashes.size(), 2u);
  EXPECT_EQ(ci.signingSecrets, std::vector<std::string>{"0123456789abcdef"});
  EXPECT_EQ(ci.requestsPerSecond, 0);
}

TEST(KeyFile, ABurstIsASecondsWorthUnlessItIsGiven) {
  const std::string key = "name=a scopes=read sha256=" + kHash;
  EXPECT_EQ(parseKeyFile(key + " requestsPerSecond=0.1")->front().burst, 1);
  EXPECT_EQ(parseKeyFile(key + " requestsPerSecond=20")->front().burst, 20);
}

TEST(KeyFile, SaysWhichLineIsWrongAndQuotesNoSecret) {
  const std::string good = "name=a scopes=read sha256=" + kHash + "\n";
  for (const std::string& wrong :
       {std::string("name=b scopes=read sha256=mysecret"), std::string("name=b scopes=read mysecret"),
        "name=b scopes=read,mysecret sha256=" + kHash, "name=my/secret scopes=read sha256=" + kHash,
        "name=b scopes=read mysecret=1 sha256=" + kHash, "name=b scopes=read signingSecret=mysecret sha256=" + kHash,
        std::string("name=b scopes=read"), "name=b sha256=" + kHash, "scopes=read sha256=" + kHash,
        "name=b name=c scopes=read sha256=" + kHash, "name=b scopes=read burst=3 sha256=" + kHash,
        "name=b scopes=read concurrent=1.5 sha256=" + kHash, "name=b scopes=read requestsPerSecond=nan sha256=" + kHash,
        good}) {
    const auto said = faults(good + "\n" + wrong);
    ASSERT_EQ(said.size(), 1u) << wrong;
    EXPECT_TRUE(said.front().starts_with("The key file, line 3: ")) << said.front();
    EXPECT_EQ(said.front().find("secret"), std::string::npos) << said.front();
  }
}

TEST(KeyFile, WithoutAKeyIsWrongToo) {
  EXPECT_EQ(faults("# nobody\n").size(), 1u);
  EXPECT_EQ(faults("").size(), 1u);
}

TEST(Scopes, AKeyAllowsWhatItNamesAndAdminEverything) {
  EXPECT_TRUE(allows(Scope::read | Scope::render, Scope::render));
  EXPECT_FALSE(allows(Scope::render, Scope::render | Scope::upload));
  EXPECT_TRUE(allows(Scope::admin, Scope::render | Scope::upload));
  EXPECT_TRUE(allows(Scope::none, Scope::none));
}

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
