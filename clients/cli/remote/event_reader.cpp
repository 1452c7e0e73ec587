#include "clients/cli/remote/event_reader.h"

#include <utility>

namespace gnomon::cli {

std::vector<ServerEvent> EventReader::read(std::string_view bytes) {
  std::vector<ServerEvent> events;
  for (std::size_t end = 0; (end = bytes.find('\n')) != std::string_view::npos; bytes.remove_prefix(end + 1)) {
    line_ += bytes.substr(0, end);
    if (line_.ends_with('\r')) line_.pop_back();
    readLine(std::exchange(line_, {}), events);
  }
  line_ += bytes;
  return events;
}

void EventReader::readLine(std::string_view line, std::vector<ServerEvent>& events) {
  if (line.empty()) {
    if (!event_.data.empty()) events.push_back(event_);
    event_ = {};
    return;
  }
  const auto colon = line.find(':');
  const std::string_view field = line.substr(0, colon);
  std::string_view value = colon == std::string_view::npos ? std::string_view() : line.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (field == "event") event_.name = value;
  if (field == "data") (event_.data += event_.data.empty() ? "" : "\n") += value;
}

} // namespace gnomon::cli
