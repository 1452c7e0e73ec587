#include "server/wire/channel.h"

#include <array>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <thread>

#include "protocol/cost/frame_cost.h"
#include "server/system/file_descriptor.h"
#include "server/wire/messages.h"

namespace gnomon {
namespace {

constexpr std::chrono::milliseconds kSoon{2'000};

class ChannelTest : public ::testing::Test {
 protected:
  std::pair<FileDescriptor, FileDescriptor> ends_ = *Channel::pair();
};

TEST_F(ChannelTest, MessagesArriveWholeAndInOrder) {
  Channel one(std::move(ends_.first)), other(std::move(ends_.second));
  const std::string longText(500'000, 'x');
  ASSERT_TRUE(one.send("first"));
  ASSERT_TRUE(one.send(longText));
  ASSERT_TRUE(one.send(""));
  Packet packet;
  ASSERT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
  EXPECT_EQ(packet.text, "first");
  ASSERT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
  EXPECT_EQ(packet.text, longText);
  EXPECT_TRUE(packet.files.empty()) << "the file of a long text is not one that was sent along";
  ASSERT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
  EXPECT_EQ(packet.text, "");
  EXPECT_EQ(other.receive(packet, std::chrono::milliseconds(10)), ChannelEvent::timeout);
}

TEST_F(ChannelTest, FilesGoAlong) {
  Channel one(std::move(ends_.first)), other(std::move(ends_.second));
  const auto a = memoryFile(Bytes{1}), b = memoryFile(Bytes{2});
  ASSERT_TRUE(one.send(std::string(100'000, 'x'), std::array{a->get(), b->get()}));
  Packet packet;
  ASSERT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
  ASSERT_EQ(packet.files.size(), 2u);
  EXPECT_EQ(readFile(packet.files[0], 1), Bytes{1});
  EXPECT_EQ(readFile(packet.files[1], 1), Bytes{2});
}

TEST_F(ChannelTest, AnEndThatGoesIsNoticed) {
  Channel one(std::move(ends_.first));
  EXPECT_FALSE(one.hasEnded());
  ends_.second.reset();
  EXPECT_TRUE(one.hasEnded());
  Packet packet;
  EXPECT_EQ(one.receive(packet, kSoon), ChannelEvent::ended);
  EXPECT_FALSE(one.send("x"));
}

TEST_F(ChannelTest, WhoeverDoesNotReadHoldsUpNobody) {
  Channel one(std::move(ends_.first));
  const std::string text(30'000, 'x');
  int sent = 0;
  while (one.send(text)) ASSERT_LT(++sent, 10'000);
  EXPECT_GT(sent, 0);
  EXPECT_FALSE(one.hasEnded());
}

TEST_F(ChannelTest, APatientEndWaitsForRoom) {
  Channel one(std::move(ends_.first), kSoon), other(std::move(ends_.second));
  const std::string text(30'000, 'x');
  constexpr int kMessages = 100;
  std::thread reading([&] {
    for (int i = 0; i < kMessages; ++i) {
      Packet packet;
      EXPECT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
    }
  });
  for (int i = 0; i < kMessages; ++i) EXPECT_TRUE(one.send(text));
  reading.join();
}

TEST_F(ChannelTest, WhatIsNoPacketIsBroken) {
  Channel one(std::move(ends_.first));
  Packet packet;
  for (const std::string& bytes : {std::string("x"), std::string("f"), std::string(40'000, 'i')}) {
    ASSERT_GT(::send(ends_.second.get(), bytes.data(), bytes.size(), 0), 0);
    EXPECT_EQ(one.receive(packet, kSoon), ChannelEvent::broken) << bytes.substr(0, 3);
  }
}

TEST_F(ChannelTest, WhatIsTooLargeIsNotSent) {
  Channel one(std::move(ends_.first)), other(std::move(ends_.second));
  const std::string longest(Channel::kMostText, 'x');
  EXPECT_FALSE(Channel::fits(longest + 'x'));
  EXPECT_FALSE(one.send(longest + 'x'));
  EXPECT_FALSE(one.send("x", std::vector<int>(Channel::kMostFiles + 1, 0)));
  EXPECT_TRUE(Channel::fits(longest));
  EXPECT_TRUE(one.send(longest)) << "the channel goes on";
  Packet packet;
  ASSERT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
  EXPECT_EQ(packet.text.size(), longest.size());
}

TEST_F(ChannelTest, TheLongestRequestFitsAsJsonWithinJson) {
  EXPECT_TRUE(Channel::fits(textOf(ToFront{.event = OrderEvent{1, "row", std::string(kLimits.maxSpecBytes, '"')}})));
}

TEST(Messages, ReadBackAsTheyWereWritten) {
  Order order{.number = 7, .kind = OrderKind::bakeFile, .scene = "abc", .isStored = true, .milliseconds = 12.5};
  order.mediaType = "image/png";
  order.light = 3;
  const auto read = readToWorker(textOf(ToWorker{.order = order}));
  ASSERT_TRUE(read && read->order);
  EXPECT_EQ(read->order->number, 7u);
  EXPECT_EQ(read->order->kind, OrderKind::bakeFile);
  EXPECT_TRUE(read->order->isStored);
  EXPECT_EQ(read->order->milliseconds, 12.5);
  EXPECT_EQ(read->order->light, 3);
  EXPECT_FALSE(read->start || read->cancel || read->forget || read->lightMap);
}

TEST(Messages, ProblemsAndStagesArriveWhole) {
  Outcome outcome{.number = 1, .problems = {{ProblemCode::tooLarge, "/views", "Too large.", "1", "2"}}};
  outcome.stages = {{"load", 1.5}, {"shade", 2}};
  const auto read = readToFront(textOf(ToFront{.outcome = outcome}));
  ASSERT_TRUE(read && read->outcome);
  ASSERT_EQ(read->outcome->problems.size(), 1u);
  EXPECT_EQ(read->outcome->problems[0].code, ProblemCode::tooLarge);
  EXPECT_EQ(read->outcome->problems[0].pointer, "/views");
  EXPECT_EQ(read->outcome->problems[0].actual, "2");
  ASSERT_EQ(read->outcome->stages.size(), 2u);
  EXPECT_EQ(read->outcome->stages[1].stage, "shade");
}

TEST(Messages, TextThatIsNoUtf8IsReplaced) {
  const auto read = readToFront(textOf(ToFront{.event = OrderEvent{1, "row", "\"\xff\""}}));
  ASSERT_TRUE(read && read->event);
  EXPECT_EQ(read->event->data, "\"?\"");
}

TEST(Messages, WhatIsNoneIsRefused) {
  for (const char* text :
       {"", "{}", "[]", "{\"cancel\":{\"number\":1},\"forget\":{\"scene\":\"a\"}}", "{\"cancel\":{\"number\":-1}}",
        "{\"cancel\":{\"nummer\":1}}", "{\"cancel\":1}", "{\"order\":{\"kind\":\"nothing\"}}", "{\"ready\":{}}"}) {
    EXPECT_FALSE(readToWorker(text)) << text;
  }
  EXPECT_FALSE(readToFront("{\"cancel\":{\"number\":1}}"));
}

TEST(Messages, WhatNoWorkerSaysIsNone) {
  const auto isRead = [](const ToFront& message) { return readToFront(textOf(message)).has_value(); };
  const auto stages = [&](std::vector<StageTime> all) {
    return isRead({.outcome = Outcome{.stages = std::move(all)}});
  };
  EXPECT_TRUE(stages({{"shade", 1}, {"encode", 0}}));
  EXPECT_FALSE(stages({{"shade\r\nSet-Cookie: a=b", 1}}));
  EXPECT_FALSE(stages({{"", 1}}));
  EXPECT_FALSE(stages({{"shade", -1}}));
  EXPECT_FALSE(stages({{"shade", 1e308}}));
  std::vector<StageTime> many;
  for (char c = 'a'; c <= 'z'; ++c)
    for (char d : {'a', 'b', 'c'}) many.push_back({std::string{c, d}, 1});
  EXPECT_FALSE(stages(std::move(many)));
  EXPECT_FALSE(isRead({.outcome = Outcome{.retryAfterSeconds = -1}}));
  EXPECT_FALSE(isRead({.refusal = Refusal{}})) << "a refusal has a reason";
  EXPECT_TRUE(isRead({.event = OrderEvent{1, "row", R"({"a":"b\nc"})"}}));
  EXPECT_FALSE(isRead({.event = OrderEvent{1, "row", "{}\n\nevent: problem\ndata: {}"}}));
  EXPECT_FALSE(isRead({.event = OrderEvent{1, "row", "text"}}));
  const std::string key = std::string(64, 'a') + "-" + std::string(64, 'b');
  EXPECT_TRUE(isRead({.made = LightMapMade{key}}));
  for (const std::string& other : {std::string("a-b"), "../" + key, key + "0", key + "\n"}) {
    EXPECT_FALSE(isRead({.made = LightMapMade{other}})) << other;
    EXPECT_FALSE(isRead({.request = LightMapRequest{1, other}})) << other;
  }
}

TEST(Messages, ABeatHasOneBoundedFactorForEachPartOfAFrame) {
  const auto isRead = [](const Beat& beat) { return readToFront(textOf(ToFront{.beat = beat})).has_value(); };
  const std::vector<double> usual(kFrameParts, 1e-6);
  EXPECT_TRUE(isRead({.costFactors = usual}));
  for (const double factor : {-1.0, 1e300}) {
    std::vector<double> factors = usual;
    factors.back() = factor;
    EXPECT_FALSE(isRead({.costFactors = factors})) << factor;
  }
  EXPECT_FALSE(isRead({.costFactors = std::vector<double>(kFrameParts - 1, 1e-6)}));
  EXPECT_FALSE(isRead({.scenes = ~0ull, .costFactors = usual}));
  EXPECT_FALSE(isRead({.reusedMeshes = ~0ull, .costFactors = usual}));
}

} // namespace
} // namespace gnomon
