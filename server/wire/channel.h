#pragma once

#include <chrono>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "server/system/file_descriptor.h"

namespace gnomon {

/// A message as it travels: text, and files that go with it.
struct Packet {
  std::string text;
  std::vector<FileDescriptor> files;
};

enum class ChannelEvent {
  packet,
  ended,   ///< the other process closed its end, or is gone
  timeout, ///< nothing arrived
  broken   ///< what arrived is no packet
};

/// One end of a socket pair between two processes of this machine (SOCK_SEQPACKET, unix(7)): messages arrive whole and
/// in order, with the files that were sent along. Any number of threads may send; one receives.
class Channel {
 public:
  static constexpr std::size_t kMostFiles = 4; ///< of a message

  /// Bytes of a message's text. Some quote a part of a request, which is at most kLimits.maxSpecBytes, in JSON within
  /// JSON: that is twice as long where all of it must be escaped.
  static constexpr std::size_t kMostText = 4 * 1024 * 1024;

  /// `sendPatience`: how long a message may wait until the other end has read enough of the earlier ones.
  explicit Channel(FileDescriptor socket, std::chrono::milliseconds sendPatience = {})
      : socket_(std::move(socket)), sendPatience_(sendPatience) {}

  /// Two ends that are connected; nothing where the system refused.
  static std::optional<std::pair<FileDescriptor, FileDescriptor>> pair();

  /// Whether a text is short enough to be sent. The two ends agree, so that a longer one would be no message.
  static bool fits(std::string_view text) { return text.size() <= kMostText; }

  /// False where the other end is gone, or has left so much unread that nothing more fits, and for a text that does not
  /// fit. The files stay the caller's.
  bool send(std::string_view text, std::span<const int> files = {});

  /// Whether the other process closed its end, or is gone.
  bool hasEnded() const;

  /// Waits for the next message. `packet` is filled where the answer is ChannelEvent::packet.
  ChannelEvent receive(Packet& packet, std::chrono::milliseconds patience);

 private:
  FileDescriptor socket_;
  std::chrono::milliseconds sendPatience_;
  std::mutex sending_;
};

} // namespace gnomon
