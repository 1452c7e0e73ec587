#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gnomon::cli {

struct ServerEvent {
  std::string name;
  std::string data;
};

/// Server-sent events from their bytes, however those are cut: fields `event` and `data`, lines ended by \n or \r\n;
/// comments and other fields are passed over.
class EventReader {
 public:
  /// The events that are complete with these bytes.
  std::vector<ServerEvent> read(std::string_view bytes);

 private:
  void readLine(std::string_view line, std::vector<ServerEvent>& events);

  std::string line_; ///< not ended yet
  ServerEvent event_;
};

} // namespace gnomon::cli
