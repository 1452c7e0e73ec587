#pragma once

#include <mutex>

namespace gnomon {

/// Whether the client of one request still waits for the reply. Bytes that it sent ahead hide nothing. Any thread.
///
/// A client that has closed its connection and one that only says that it sends no more look the same (both send FIN),
/// until it is sent something: the first answers with a reset. So it is sent an interim reply, which every HTTP/1.1
/// client has to pass over (RFC 9110 section 15.2). HTTP/1.0 knows none: there only a reset counts.
class ClientWatch {
 public:
  /// `fd` still belongs to the caller, and is touched until end() at most.
  ClientWatch(int fd, bool knowsInterimReplies) : fd_(fd), mayAsk_(knowsInterimReplies) {}

  /// True once the client has left. The first call after its FIN waits some milliseconds for the reset.
  bool left();

  /// The reply begins, and is made while it is sent: from now on FIN counts as leaving.
  void beginStream();

  /// The reply is made. What left() said last stays.
  void end();

 private:
  bool isReset(int milliseconds) const;

  const int fd_;
  std::mutex mutex_;
  bool mayAsk_;
  bool streaming_ = false;
  bool ended_ = false;
  bool left_ = false;
};

} // namespace gnomon
