#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "protocol/base/result.h"

namespace gnomon::cli {

struct HttpCall {
  std::string method = "GET"; ///< GET, HEAD, POST or DELETE
  std::string path = "/";     ///< below the server's address
  std::vector<std::pair<std::string, std::string>> headers;
  std::string contentType;            ///< of the body
  std::string_view body;              ///< POST only; must live as long as the call
  std::chrono::seconds patience{0};   ///< for each wait on the network; 0 = the caller's
  std::function<void(double)> onSent; ///< gets the sent share of the body, 0..1
  /// Of a GET or POST: given each piece of the body of a 200 as it comes; the reply is then without it.
  std::function<void(std::string_view)> onReceived;
  /// Makes what was received void before a reply that was cut off is asked for again; null = it is not.
  std::function<void()> onRestart;
};

struct HttpReply {
  int status = 0;
  std::string contentType;
  std::string body;
  int retryAfterSeconds = 0; ///< 0 = the server named none
};

/// Address and credentials of a server.
struct Remote {
  std::string url;   ///< "http://host:port" or "https://…", with or without a path in front
  std::string key{}; ///< sent as a bearer token; empty = none
  std::vector<std::pair<std::string, std::string>> headers{}; ///< sent with every call
  std::string caFile{};               ///< certificates to trust, as PEM; empty = the system's. https only
  std::chrono::seconds patience{600}; ///< for a busy or restarting server, and for each wait on the network
  /// Whether a call has had a reply: a server that was there is waited for when it is not.
  std::shared_ptr<bool> wasThere = std::make_shared<bool>(false);
};

/// One call. A reply of any status is a value; a problem means that there was none: a bad address, no server there, no
/// answer in time. No redirection is followed, so that the key goes nowhere else.
Result<HttpReply> callServer(const Remote& remote, const HttpCall& call);

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
