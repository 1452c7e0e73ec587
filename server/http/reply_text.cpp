#include "server/http/reply_text.h"

#include <algorithm>
#include <array>
#include <ctime>

namespace gnomon {
namespace {

void addHeader(std::string& head, std::string_view name, std::string_view value) {
  head.append(name).append(": ");
  std::copy_if(value.begin(), value.end(), std::back_inserter(head),
               [](char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; });
  head.append("\r\n");
}

std::string dateText() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  std::array<char, 64> text;
  const std::size_t length = std::strftime(text.data(), text.size(), "%a, %d %b %Y %H:%M:%S GMT", &utc);
  return {text.data(), length};
}

bool brings(const HttpReply& reply, std::string_view name) {
  return std::any_of(reply.headers.begin(), reply.headers.end(),
                     [&](const auto& header) { return header.first == name; });
}

} // namespace

std::string_view reasonPhrase(int status) {
  switch (status) {
    case 200:
      return "OK";
    case 201:
      return "Created";
    case 204:
      return "No Content";
    case 304:
      return "Not Modified";
    case 400:
      return "Bad Request";
    case 404:
      return "Not Found";
    case 405:
      return "Method Not Allowed";
    case 406:
      return "Not Acceptable";
    case 408:
      return "Request Timeout";
    case 411:
      return "Length Required";
    case 413:
      return "Content Too Large";
    case 415:
      return "Unsupported Media Type";
    case 422:
      return "Unprocessable Content";
    case 429:
      return "Too Many Requests";
    case 431:
      return "Request Header Fields Too Large";
    case 500:
      return "Internal Server Error";
    case 503:
      return "Service Unavailable";
    case 504:
      return "Gateway Timeout";
    default:
      return "Status";
  }
}

std::string replyHead(const HttpReply& reply, std::string_view requestId, bool keepAlive) {
  std::string head = "HTTP/1.1 " + std::to_string(reply.status) + " ";
  head.append(reasonPhrase(reply.status)).append("\r\n");
  addHeader(head, "Date", dateText());
  addHeader(head, "X-Request-ID", requestId);
  if (!reply.contentType.empty()) {
    addHeader(head, "Content-Type", reply.contentType);
  }
  if (reply.status != 204 && reply.status != 304 && !reply.bodyOmitted && !reply.stream) {
    addHeader(head, "Content-Length", std::to_string(reply.body.size()));
  }
  for (const auto& [name, value] : reply.headers) {
    addHeader(head, name, value);
  }
  if (!brings(reply, "Content-Security-Policy")) {
    addHeader(head, "Content-Security-Policy", "default-src 'none'");
  }
  addHeader(head, "X-Content-Type-Options", "nosniff");
  addHeader(head, "Connection", keepAlive && !reply.stream ? "keep-alive" : "close");
  head.append("\r\n");
  return head;
}

} // namespace gnomon
