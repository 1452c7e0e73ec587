#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/report/frame_report.h"

namespace gnomon {

/// Sends a piece of a body at once; false = the client is gone, and nothing more need be made.
using BodySink = std::function<bool(std::string_view)>;

/// One reply. Content-Length, Connection, X-Request-ID, Date and the safety headers are added when it is sent.
struct HttpReply {
  int status = 200;
  std::string contentType; ///< empty = no body
  std::string body;
  /// Instead of `body`: makes it while it is sent, on the connection's thread. The connection ends after it, which is
  /// how its end is told.
  std::function<void(const BodySink&)> stream;
  std::vector<std::pair<std::string, std::string>> headers;
  bool bodyOmitted = false;      ///< HEAD whose body was not made: no Content-Length is sent
  std::vector<StageTime> stages; ///< for the log
  std::string note;              ///< for the log, never for the client
};

} // namespace gnomon
