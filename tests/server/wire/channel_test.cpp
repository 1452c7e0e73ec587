#include "server/wire/channel.h"

#include <array>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <thread>

#include "server/system/memory_file.h"
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
  constexpr int kCount = 100;
  std::thread reading([&] {
    for (int i = 0; i < kCount; ++i) {
      Packet packet;
      EXPECT_EQ(other.receive(packet, kSoon), ChannelEvent::packet);
    }
  });
  for (int i = 0; i < kCount; ++i) EXPECT_TRUE(one.send(text));
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

} // namespace
} // namespace gnomon
