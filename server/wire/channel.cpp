#include "server/wire/channel.h"

#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>

#include "protocol/base/bytes.h"

namespace gnomon {
namespace {

/// A packet's first byte: where its text is. The socket's buffer holds some 200 KB, so that longer texts are files.
constexpr char kInline = 'i';
constexpr char kInFile = 'f'; ///< the last one
constexpr std::size_t kMostInline = 32 * 1024;

using Control = std::array<char, CMSG_SPACE(sizeof(int) * (Channel::kMostFiles + 1))>;

/// The descriptors that came with a message.
std::vector<FileDescriptor> filesOf(msghdr& message) {
  std::vector<FileDescriptor> files;
  for (cmsghdr* part = CMSG_FIRSTHDR(&message); part != nullptr; part = CMSG_NXTHDR(&message, part)) {
    if (part->cmsg_level != SOL_SOCKET || part->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (part->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int fd = -1;
      std::memcpy(&fd, CMSG_DATA(part) + i * sizeof(int), sizeof fd);
      files.emplace_back(fd);
    }
  }
  return files;
}

} // namespace

std::optional<std::pair<FileDescriptor, FileDescriptor>> Channel::pair() {
  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends.data()) != 0) return std::nullopt;
  return std::pair(FileDescriptor(ends[0]), FileDescriptor(ends[1]));
}

bool Channel::send(std::string_view text, std::span<const int> files) {
  if (files.size() > kMostFiles || !fits(text)) return false;
  std::vector<int> sent(files.begin(), files.end());
  std::optional<FileDescriptor> asFile;
  std::string packet(1, kInline);
  if (text.size() > kMostInline) {
    asFile = memoryFile(asBytes(text));
    if (!asFile) return false;
    sent.push_back(asFile->get());
    packet[0] = kInFile;
  } else {
    packet += text;
  }
  iovec content{packet.data(), packet.size()};
  alignas(cmsghdr) Control control{};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  if (!sent.empty()) {
    message.msg_control = control.data();
    message.msg_controllen = CMSG_SPACE(sizeof(int) * sent.size());
    cmsghdr* rights = CMSG_FIRSTHDR(&message);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof(int) * sent.size());
    std::memcpy(CMSG_DATA(rights), sent.data(), sizeof(int) * sent.size());
  }
  const std::lock_guard lock(sending_);
  while (true) {
    if (::sendmsg(socket_.get(), &message, MSG_NOSIGNAL | MSG_DONTWAIT) >= 0) return true;
    if (errno == EINTR) continue;
    pollfd room{socket_.get(), POLLOUT, 0};
    if (errno != EAGAIN || ::poll(&room, 1, static_cast<int>(sendPatience_.count())) <= 0) return false;
  }
}

bool Channel::hasEnded() const {
  pollfd end{socket_.get(), 0, 0}; // POLLHUP and POLLERR are always reported
  return ::poll(&end, 1, 0) > 0;
}

ChannelEvent Channel::receive(Packet& packet, std::chrono::milliseconds patience) {
  pollfd waiting{socket_.get(), POLLIN, 0};
  const int ready = ::poll(&waiting, 1, static_cast<int>(patience.count()));
  if (ready == 0 || (ready < 0 && errno == EINTR)) return ChannelEvent::timeout;
  std::array<char, kMostInline + 1> buffer;
  iovec content{buffer.data(), buffer.size()};
  alignas(cmsghdr) Control control{};
  msghdr message{};
  message.msg_iov = &content;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = ::recvmsg(socket_.get(), &message, MSG_CMSG_CLOEXEC | MSG_DONTWAIT);
  if (size < 0 && (errno == EAGAIN || errno == EINTR)) return ChannelEvent::timeout;
  packet = {"", filesOf(message)};
  if (size <= 0) return ChannelEvent::ended;
  if ((message.msg_flags & (MSG_TRUNC | MSG_CTRUNC)) != 0) return ChannelEvent::broken;
  const std::string_view rest(buffer.data() + 1, static_cast<std::size_t>(size) - 1);
  if (buffer[0] == kInline) {
    packet.text = rest;
    return ChannelEvent::packet;
  }
  if (buffer[0] != kInFile || packet.files.empty()) return ChannelEvent::broken;
  const auto text = readFile(packet.files.back(), kMostText);
  if (!text) return ChannelEvent::broken;
  packet.files.pop_back();
  packet.text = asText(*text);
  return ChannelEvent::packet;
}

} // namespace gnomon
