#include "clients/cli/remote/http_client.h"

#include <algorithm>
#include <httplib.h>
#include <memory>
#include <optional>
#include <utility>

namespace gnomon::cli {
namespace {

constexpr std::size_t kChunk = 256 * 1024; // bytes handed to the socket at once

struct Address {
  std::string origin; // "http://host:port"
  std::string prefix; // "" or "/path", no slash at its end
};

std::optional<Address> parseAddress(std::string url) {
  while (url.ends_with('/')) url.pop_back();
  const auto scheme = url.find("://");
  if (scheme == std::string::npos) return std::nullopt;
  const std::string name = url.substr(0, scheme);
  if ((name != "http" && name != "https") || url.find_first_of("?# \r\n") != std::string::npos) return std::nullopt;
  const auto host = scheme + 3;
  const auto path = url.find('/', host);
  if (host == url.size() || path == host) return std::nullopt;
  return Address{url.substr(0, path), path == std::string::npos ? "" : url.substr(path)};
}

httplib::ContentProvider bodyProvider(std::string_view body, const std::function<void(double)>& onSent) {
  return [body, onSent](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
    const std::size_t size = std::min(length, kChunk);
    const bool sent = sink.write(body.data() + offset, size);
    if (sent && onSent) onSent(static_cast<double>(offset + size) / static_cast<double>(body.size()));
    return sent;
  };
}

/// A GET or POST whose reply is given away piece by piece.
httplib::Result sendAndStream(httplib::Client& client, const std::string& path, httplib::Headers headers,
                              const HttpCall& call) {
  int status = 0;
  std::string refusal;
  httplib::Request request;
  request.method = call.method;
  request.path = path;
  request.headers = std::move(headers);
  if (call.method == "POST") {
    request.set_header("Content-Type", call.contentType);
    request.body = call.body;
  }
  request.response_handler = [&](const httplib::Response& reply) {
    status = reply.status;
    return true;
  };
  request.content_receiver = [&](const char* bytes, std::size_t count, std::uint64_t, std::uint64_t) {
    if (status == 200) {
      call.onReceived({bytes, count});
    } else {
      refusal.append(bytes, count);
    }
    return true;
  };
  auto result = client.send(request);
  if (result) result->body = std::move(refusal);
  return result;
}

httplib::Result send(httplib::Client& client, const std::string& path, const HttpCall& call) {
  httplib::Headers headers;
  for (const auto& [name, value] : call.headers) headers.emplace(name, value);
  if (call.onReceived) return sendAndStream(client, path, std::move(headers), call);
  if (call.method == "HEAD") return client.Head(path, headers);
  if (call.method == "GET") return client.Get(path, headers);
  if (call.method == "DELETE") return client.Delete(path, headers);
  return client.Post(path, headers, call.body.size(), bodyProvider(call.body, call.onSent), call.contentType);
}

std::string reasonOf(httplib::Error error) {
  switch (error) {
    case httplib::Error::Connection:
      return "no answer from this address";
    case httplib::Error::ConnectionTimeout:
      return "no answer in time";
    case httplib::Error::Read:
      return "the connection ended before the reply did, or the reply took too long";
    case httplib::Error::Write:
      return "the connection ended before the request was sent";
    case httplib::Error::SSLConnection:
      return "the TLS handshake failed";
    case httplib::Error::SSLLoadingCerts:
      return "the file of trusted certificates holds none";
    case httplib::Error::SSLServerVerification:
      return "the server's certificate is not trusted, or is another host's";
    default:
      return httplib::to_string(error);
  }
}

} // namespace

Result<HttpReply> callServer(const Remote& remote, const HttpCall& call) {
  const std::string& server = remote.url;
  const auto address = parseAddress(server);
  if (!address) return invalidValue(server, "This is not a server's address.", "http://HOST:PORT");
  try {
    httplib::Client client(address->origin);
    if (!client.is_valid()) {
      return invalidValue(server, "This is not a server's address.", "http://HOST:PORT");
    }
    const auto patience = call.patience.count() > 0 ? call.patience : remote.patience;
    client.set_connection_timeout(std::min(patience, std::chrono::seconds{10}));
    client.set_read_timeout(patience);
    client.set_write_timeout(patience);
    client.set_tcp_nodelay(true);
    if (!remote.caFile.empty()) client.set_ca_cert_path(remote.caFile.c_str());
    httplib::Headers headers(remote.headers.begin(), remote.headers.end());
    if (!remote.key.empty()) headers.emplace("Authorization", "Bearer " + remote.key);
    client.set_default_headers(headers);
    const auto reply = send(client, address->prefix + call.path, call);
    if (!reply)
      return Problem{ProblemCode::unavailable, server, "There was no reply: " + reasonOf(reply.error()) + "."};
    *remote.wasThere = true;
    const auto retryAfter = std::min<std::uint64_t>(reply->get_header_value<std::uint64_t>("Retry-After"), 3600);
    return HttpReply{reply->status, reply->get_header_value("Content-Type"), reply->body, static_cast<int>(retryAfter)};
  } catch (const std::exception& error) {
    return Problem{ProblemCode::internal, server, std::string("The call failed: ") + error.what() + "."};
  }
}

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
