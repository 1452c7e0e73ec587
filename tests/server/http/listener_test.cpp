#include "server/http/listener.h"

#include <arpa/inet.h>
#include <cerrno>
#include <gtest/gtest.h>
#include <netinet/tcp.h>
#include <optional>
#include <sys/socket.h>

namespace gnomon {
namespace {

/// Empty where it is refused.
FileDescriptor connected(int port) {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM, 0));
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    socket.reset();
  }
  return socket;
}

int optionOf(const FileDescriptor& socket, int level, int option) {
  int value = 0;
  socklen_t length = sizeof value;
  EXPECT_EQ(::getsockopt(socket.get(), level, option, &value, &length), 0);
  return value;
}

TEST(Listener, AConnectionKnowsItsClientAndNoticesWhenItVanishes) {
  auto listener = Listener::open("127.0.0.1", 0);
  ASSERT_TRUE(listener);
  StopSignal stop;
  std::optional<OpenConnection> accepted;
  const int port = listener->port();
  const FileDescriptor client = connected(port);
  EXPECT_TRUE(listener->run(
      stop,
      [&](OpenConnection connection) {
        accepted = std::move(connection);
        stop.raise();
      },
      [] {}));
  EXPECT_FALSE(connected(port)) << "and after its end nobody is";
  ASSERT_TRUE(accepted);
  EXPECT_EQ(accepted->peer.text, "127.0.0.1");
  EXPECT_EQ(optionOf(accepted->socket, SOL_SOCKET, SO_KEEPALIVE), 1);
  EXPECT_EQ(optionOf(accepted->socket, IPPROTO_TCP, TCP_USER_TIMEOUT), 20'000);
}

TEST(Listener, RefusesAnAddressThatIsTakenOrForeign) {
  const auto listener = Listener::open("127.0.0.1", 0);
  ASSERT_TRUE(listener);
  EXPECT_FALSE(Listener::open("127.0.0.1", listener->port()));
  EXPECT_FALSE(Listener::open("192.0.2.1", 0));
  EXPECT_FALSE(Listener::open("no address", 0));
}

TEST(Listener, OneConnectionsFailureIsNotItsOwn) {
  for (const int error : {ECONNABORTED, EINTR, EAGAIN, EPERM, EPROTO, ENETDOWN, EHOSTUNREACH}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::next) << error;
  }
  for (const int error : {EMFILE, ENFILE, ENOBUFS, ENOMEM}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::pause) << error;
  }
  for (const int error : {EBADF, EINVAL, ENOTSOCK}) {
    EXPECT_EQ(afterAccept(error), AfterAccept::giveUp) << error;
  }
}

} // namespace
} // namespace gnomon
