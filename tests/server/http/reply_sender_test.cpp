#include "server/http/reply_sender.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <thread>
#include <vector>

#include "server/http/socket_io.h"

namespace gnomon {
namespace {

using namespace std::chrono_literals;

/// Both ends of a connection over the loopback interface.
struct TcpPair {
  TcpPair() {
    const FileDescriptor listening(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof address;
    EXPECT_EQ(::bind(listening.get(), reinterpret_cast<sockaddr*>(&address), length), 0);
    EXPECT_EQ(::listen(listening.get(), 1), 0);
    ::getsockname(listening.get(), reinterpret_cast<sockaddr*>(&address), &length);
    client = FileDescriptor(::socket(AF_INET, SOCK_STREAM, 0));
    EXPECT_EQ(::connect(client.get(), reinterpret_cast<sockaddr*>(&address), length), 0);
    server = FileDescriptor(::accept4(listening.get(), nullptr, nullptr, SOCK_NONBLOCK));
  }
  FileDescriptor client, server;
};

/// Reads `count` bytes, or up to the end; how many came.
std::size_t readUpTo(int fd, std::size_t count) {
  std::vector<char> bytes(64 * 1024);
  std::size_t got = 0;
  while (got < count) {
    const ssize_t some = ::recv(fd, bytes.data(), std::min(bytes.size(), count - got), 0);
    if (some <= 0) break;
    got += static_cast<std::size_t>(some);
  }
  return got;
}

ReplySender senderTo(const TcpPair& pair, const Pace& pace = {}, const StopSignal* cut = nullptr) {
  return {pair.server.get(), TransferPace(pace, {}, {}), cut};
}

TEST(ReplySender, AReaderWhomTheKernelRunsAheadOfIsNotSlow) {
  const TcpPair pair;
  const std::string reply(12 << 20, 'x');
  std::size_t got = 0;
  std::thread reader([&] {
    const auto end = Clock::now() + 4s;
    while (Clock::now() < end) { // 130 KB a second: the kernel, which took megabytes, has no room for seconds
      got += readUpTo(pair.client.get(), 6'500);
      std::this_thread::sleep_for(50ms);
    }
    got += readUpTo(pair.client.get(), reply.size());
  });
  ReplySender sender = senderTo(pair, {2s, 2s, 64 * 1024});
  EXPECT_EQ(sender.send(reply), Delivery::whole);
  ::shutdown(pair.server.get(), SHUT_WR);
  reader.join();
  EXPECT_EQ(got, reply.size());
}

TEST(ReplySender, WhatTheKernelTakesIsNoPace) {
  const TcpPair pair;
  ReplySender sender = senderTo(pair, {300ms, 300ms, 16 * 1024});
  EXPECT_EQ(sender.send(std::string(2 << 20, 'x')), Delivery::tooSlow) << "the kernel has all of it";
  EXPECT_EQ(sender.send("more"), Delivery::tooSlow) << "nothing follows what did not come whole";
}

TEST(ReplySender, LeavesLittleOnItsWay) {
  const TcpPair pair;
  const std::string reply(8 << 20, 'x');
  std::thread reader([&] { readUpTo(pair.client.get(), reply.size()); });
  ReplySender sender = senderTo(pair);
  EXPECT_EQ(sender.send(reply), Delivery::whole);
  EXPECT_LE(unacknowledged(pair.server.get()), kSmallReply);
  reader.join();
}

TEST(ReplySender, DoesNotWaitForWhatIsSmall) {
  const TcpPair pair;
  ReplySender sender = senderTo(pair, {1h, 1h, 1});
  for (int i = 0; i < 10; ++i) EXPECT_EQ(sender.send(std::string(10'000, 'x')), Delivery::whole);
}

TEST(ReplySender, KnowsAClientThatLeftFromOneThatIsSlow) {
  TcpPair pair;
  std::thread reader([&] {
    readUpTo(pair.client.get(), 1);
    pair.client.reset();
  });
  ReplySender sender = senderTo(pair);
  EXPECT_EQ(sender.send(std::string(32 << 20, 'x')), Delivery::clientLeft);
  reader.join();
}

TEST(ReplySender, WaitsNoLongerThanTheServerGoesOn) {
  const TcpPair pair;
  StopSignal cut;
  std::thread stopping([&] {
    std::this_thread::sleep_for(50ms);
    cut.raise();
  });
  ReplySender sender = senderTo(pair, {1h, 1h, 1}, &cut);
  EXPECT_EQ(sender.send(std::string(32 << 20, 'x')), Delivery::shutdown);
  stopping.join();
}

TEST(ReplySender, IsEndedWhereOthersWait) {
  const TcpPair pair;
  ByteBudget budget(32 << 20);
  const Holder holder{{"a", "a"}, "1"};
  ByteLease lease(budget, holder), other(budget, {{"b", "b"}, "2"});
  ASSERT_TRUE(lease.grow(budget.total()));
  std::jthread waiting([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) other.growBy(1, Clock::now() + 50ms);
  });
  ReplySender sender(pair.server.get(), TransferPace({1h, 1h, 1}, {&budget}, holder));
  EXPECT_EQ(sender.send(std::string(32 << 20, 'x')), Delivery::othersWaited);
}

} // namespace
} // namespace gnomon
