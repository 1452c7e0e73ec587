#include "server/access/access_check.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <optional>
#include <unistd.h>

#include "protocol/access/access_key.h"
#include "protocol/base/bytes.h"
#include "server/access/key_ring.h"
#include "tests/server/http/asked.h"

namespace gnomon {
namespace {

using std::chrono::milliseconds;

std::string hashOf(std::string_view secret) {
  Sha256 hash;
  hash.add(secret);
  return hash.hex();
}

AccessKey keyOf(std::string name, std::string_view secret, Scope scope) {
  AccessKey key;
  key.name = std::move(name);
  key.secretHashes = {hashOf(secret)};
  key.scope = scope;
  return key;
}

/// A service whose every route needs `scope`; its reply says who asked.
HttpService inner(Scope scope) {
  return [scope](const HttpRequest&) -> std::variant<RequestHandler, HttpReply> {
    RequestHandler handler;
    handler.scope = scope;
    handler.answer = [](HttpRequest request, const std::function<bool()>&) {
      HttpReply reply;
      reply.body = request.client.name;
      reply.headers.emplace_back("Cache-Control", "public, max-age=60");
      return reply;
    };
    return handler;
  };
}

HttpReply ask(const HttpService& service, const std::optional<std::string>& authorization) {
  HttpRequest request;
  request.method = "GET";
  request.client = {"10.0.0.1", "10.0.0.1"};
  if (authorization) request.headers.emplace_back("authorization", *authorization);
  return answerOf(service, request);
}

std::shared_ptr<KeyRing> twoKeys() {
  return std::make_shared<KeyRing>(
      std::vector{keyOf("web", "of web", Scope::read | Scope::render), keyOf("ci", "of ci", Scope::upload)});
}

TEST(AccessCheck, WhatNeedsNoScopeIsForAnyone) {
  const HttpReply reply = ask(withAccessCheck(inner(Scope::none), twoKeys()), std::nullopt);
  EXPECT_EQ(reply.status, 200);
  EXPECT_EQ(reply.body, "10.0.0.1");
}

TEST(AccessCheck, WithoutTheSecretOfAKeyItIs401AndSaysHowToAsk) {
  const auto service = withAccessCheck(inner(Scope::read), twoKeys());
  for (const std::optional<std::string>& shown :
       {std::optional<std::string>(), std::optional<std::string>("Bearer"), std::optional<std::string>("Bearer "),
        std::optional<std::string>("Bearer of nobody"), std::optional<std::string>("Basic of web"),
        std::optional<std::string>("of web"), std::optional<std::string>("Bearer " + hashOf("of web")),
        std::optional<std::string>("Bearer of web, Bearer of ci")}) {
    const HttpReply reply = ask(service, shown);
    EXPECT_EQ(reply.status, 401) << shown.value_or("nothing");
    EXPECT_TRUE(header(reply, "WWW-Authenticate").starts_with("Bearer realm="));
  }
}

TEST(AccessCheck, AKeyThatAllowsItIsTheClient) {
  const auto service = withAccessCheck(inner(Scope::render), twoKeys());
  for (const char* shown : {"Bearer of web", "bearer  of web "}) {
    const HttpReply reply = ask(service, shown);
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.body, "key web");
    EXPECT_EQ(reply.key, "web");
    EXPECT_EQ(header(reply, "Cache-Control"), "private, max-age=60") << "a shared cache asks for no key";
  }
}

TEST(AccessCheck, AKeyThatDoesNotAllowItIs403) {
  const HttpReply reply = ask(withAccessCheck(inner(Scope::render | Scope::upload), twoKeys()), "Bearer of web");
  EXPECT_EQ(reply.status, 403);
  EXPECT_EQ(reply.key, "web");
}

TEST(AccessCheck, BeyondItsRateAKeyIsToldWhenToComeAgain) {
  AccessKey key = keyOf("slow", "of slow", Scope::read);
  key.requestsPerSecond = 0.01;
  key.burst = 2;
  const auto service = withAccessCheck(inner(Scope::read), std::make_shared<KeyRing>(std::vector{key}));
  EXPECT_EQ(ask(service, "Bearer of slow").status, 200);
  EXPECT_EQ(ask(service, "Bearer of slow").status, 200);
  const HttpReply refused = ask(service, "Bearer of slow");
  EXPECT_EQ(refused.status, 429);
  EXPECT_EQ(header(refused, "Retry-After"), "100");
  EXPECT_EQ(refused.key, "slow");
}

TEST(AccessCheck, AStreamIsInProgressUntilItIsSent) {
  AccessKey key = keyOf("one", "of one", Scope::read);
  key.concurrent = 1;
  const HttpService streams = [](const HttpRequest&) -> std::variant<RequestHandler, HttpReply> {
    RequestHandler handler;
    handler.scope = Scope::read;
    handler.answer = [](HttpRequest, const std::function<bool()>&) {
      HttpReply reply;
      reply.stream = [](const BodySink&) { return nullptr; };
      return reply;
    };
    return handler;
  };
  const auto service = withAccessCheck(streams, std::make_shared<KeyRing>(std::vector{key}));
  {
    const HttpReply sending = ask(service, "Bearer of one");
    EXPECT_EQ(sending.status, 200);
    EXPECT_EQ(ask(service, "Bearer of one").status, 429);
  }
  EXPECT_EQ(ask(service, "Bearer of one").status, 200);
}

/// A server whose one key signs; its reply says which query keys the handler saw.
HttpService signedService() {
  AccessKey key = keyOf("shop", "of shop", Scope::render);
  key.signingSecrets = {"the new signing secret", "the old signing secret"};
  AccessKey reader = keyOf("reader", "of reader", Scope::read);
  reader.signingSecrets = {"the secret of reader"};
  const HttpService frames = [](const HttpRequest& head) -> std::variant<RequestHandler, HttpReply> {
    RequestHandler handler;
    handler.scope = Scope::render;
    handler.takesSignature = head.path.back() == "frame";
    handler.answer = [](HttpRequest request, const std::function<bool()>&) {
      HttpReply reply;
      std::string names;
      for (const auto& [name, value] : request.query) names += name + " ";
      reply.body = names;
      reply.headers.emplace_back("Cache-Control", "public, max-age=86400, immutable");
      return reply;
    };
    return handler;
  };
  return withAccessCheck(frames, std::make_shared<KeyRing>(std::vector{key, reader}));
}

HttpReply follow(const std::string& target) {
  const auto head = parseRequestHead("GET " + target + " HTTP/1.1\r\nHost: x\r\n\r\n");
  return answerOf(signedService(), *requestFromHead(*head));
}

constexpr std::int64_t kFarAway = 32'000'000'000;
constexpr const char* kFrame = "/v1/scenes/x/frame?width=64";

TEST(SignedAddress, IsAnsweredAsItWouldBeWithoutItsSignature) {
  for (const char* secret : {"the new signing secret", "the old signing secret"}) {
    const HttpReply reply = follow(signedTarget(kFrame, kFarAway, "shop", secret));
    EXPECT_EQ(reply.status, 200);
    EXPECT_EQ(reply.body, "width ");
    EXPECT_EQ(reply.key, "shop");
  }
}

std::string cacheControl(const HttpReply& reply) {
  for (const auto& [name, value] : reply.headers) {
    if (name == "Cache-Control") return value;
  }
  return "";
}

TEST(SignedAddress, IsKeptByCachesNoLongerThanItIsValid) {
  const auto sign = [](std::int64_t expires) {
    return signedTarget(kFrame, expires, "shop", "the new signing secret");
  };
  EXPECT_EQ(cacheControl(follow(sign(kFarAway))), "private, max-age=86400, immutable");
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  const std::int64_t soon = std::chrono::floor<std::chrono::seconds>(now).count() + 60;
  const std::string kept = cacheControl(follow(sign(soon)));
  const int seconds = std::stoi(kept.substr(kept.find('=') + 1));
  EXPECT_LE(seconds, 60);
  EXPECT_GE(seconds, 30);
  EXPECT_EQ(kept, "private, max-age=" + std::to_string(seconds) + ", immutable");
}

TEST(SignedAddress, IsRefusedWhereNobodySignedItOrItsTimeIsOver) {
  const std::string good = signedTarget(kFrame, kFarAway, "shop", "the new signing secret");
  EXPECT_EQ(follow(signedTarget(kFrame, kFarAway, "shop", "of shop")).status, 403) << "not a signing secret";
  EXPECT_EQ(follow(signedTarget(kFrame, kFarAway, "nobody", "the new signing secret")).status, 403);
  EXPECT_EQ(follow(signedTarget(kFrame, kFarAway, "reader", "the secret of reader")).status, 403) << "not its scope";
  EXPECT_EQ(follow(signedTarget(kFrame, 1'000'000'000, "shop", "the new signing secret")).status, 403) << "over";
  EXPECT_EQ(follow(good + "&height=64").status, 403);
  EXPECT_EQ(follow(std::string(kFrame) + "&signature=").status, 403);
  EXPECT_EQ(follow(std::string(kFrame) + "&%73ignature=1").status, 403);
  EXPECT_EQ(follow(kFrame).status, 401);
}

TEST(SignedAddress, IsNothingToOtherRoutes) {
  EXPECT_EQ(follow(signedTarget("/v1/scenes/x/bakes", kFarAway, "shop", "the new signing secret")).status, 401);
}

TEST(KeyRing, ABrokenFileKeepsTheKeysOfTheOneBefore) {
  std::string folder = (std::filesystem::temp_directory_path() / "gnomon-keys-XXXXXX").string();
  ASSERT_NE(::mkdtemp(folder.data()), nullptr);
  const std::string file = folder + "/keys";
  const auto write = [&](const std::string& text) { std::ofstream(file) << text; };
  EXPECT_FALSE(KeyRing::open(file)) << "there is no file";
  EXPECT_FALSE(KeyRing::open(folder)) << "a folder";
  write("name=a scopes=read sha256=" + hashOf("first") + "\n");
  const auto ring = KeyRing::open(file);
  ASSERT_TRUE(ring);
  write("nonsense\n");
  (*ring)->reload();
  EXPECT_TRUE((*ring)->withSecret("first"));
  write("name=a scopes=read sha256=" + hashOf("second") + "\n");
  (*ring)->reload();
  EXPECT_FALSE((*ring)->withSecret("first"));
  EXPECT_TRUE((*ring)->withSecret("second"));
  std::filesystem::remove_all(folder);
}

AccessKey limited(double requestsPerSecond, double burst, std::size_t concurrent = 0) {
  AccessKey key;
  key.name = "a";
  key.requestsPerSecond = requestsPerSecond;
  key.burst = burst;
  key.concurrent = concurrent;
  return key;
}

TEST(KeyUsage, ABurstAtOnceAndThenTheRate) {
  KeyUsage usage;
  const AccessKey key = limited(0.5, 3);
  const auto start = Clock::now();
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(usage.admit(key, start).place);
  const Admission refused = usage.admit(key, start);
  EXPECT_FALSE(refused.place);
  EXPECT_EQ(refused.retryAfterSeconds, 2);
  EXPECT_EQ(usage.wait(key, start + milliseconds(500)), 2) << "1.5 seconds, rounded up";
  EXPECT_FALSE(usage.admit(key, start + milliseconds(1'900)).place);
  EXPECT_TRUE(usage.admit(key, start + milliseconds(2'000)).place) << "what Retry-After said";
  EXPECT_FALSE(usage.admit(key, start + milliseconds(2'000)).place);
}

TEST(KeyUsage, WaitingSavesNoMoreThanABurst) {
  KeyUsage usage;
  const AccessKey key = limited(10, 2);
  const auto later = Clock::now() + std::chrono::hours(1);
  EXPECT_TRUE(usage.admit(key).place);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(usage.admit(key, later).place);
  EXPECT_FALSE(usage.admit(key, later).place);
}

TEST(KeyUsage, LookingTakesNothing) {
  KeyUsage usage;
  const AccessKey key = limited(1, 1, 1);
  const auto now = Clock::now();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(usage.wait(key, now), 0);
  EXPECT_TRUE(usage.admit(key, now).place);
  EXPECT_EQ(usage.wait(key, now), 1);
}

TEST(KeyUsage, APlaceIsFreeAgainOnceItIsGivenBack) {
  KeyUsage usage;
  const AccessKey key = limited(0, 0, 2);
  Admission first = usage.admit(key);
  const Admission second = usage.admit(key);
  EXPECT_TRUE(first.place && second.place);
  const Admission third = usage.admit(key);
  EXPECT_FALSE(third.place);
  EXPECT_EQ(third.retryAfterSeconds, 1);
  first.place.reset();
  EXPECT_TRUE(usage.admit(key).place);
}

TEST(KeyUsage, EachKeyHasItsOwn) {
  KeyUsage usage;
  AccessKey other = limited(0, 0, 1);
  other.name = "b";
  const Admission first = usage.admit(limited(0, 0, 1));
  EXPECT_TRUE(first.place);
  EXPECT_TRUE(usage.admit(other).place);
}

TEST(KeyUsage, WithoutBoundsEverythingMayGoOn) {
  KeyUsage usage;
  std::vector<Admission> held;
  for (int i = 0; i < 1'000; ++i) held.push_back(usage.admit(limited(0, 0)));
  for (const Admission& each : held) EXPECT_TRUE(each.place);
}

} // namespace
} // namespace gnomon
