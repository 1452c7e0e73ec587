#pragma once

#include <string>
#include <utility>
#include <vector>

#include "protocol/frame_report.h"

namespace gnomon {

/// One reply. Content-Length, Connection, X-Request-ID, Date and the safety headers are added when it is sent.
struct HttpReply {
  int status = 200;
  std::string contentType; ///< empty = no body
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  bool bodyOmitted = false;      ///< HEAD whose body was not made: no Content-Length is sent
  std::vector<StageTime> stages; ///< for the log
  std::string note;              ///< for the log, never for the client
};

} // namespace gnomon
