#include "server/http/reply.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/json/json_codec.h"

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
    case 401:
      return "Unauthorized";
    case 403:
      return "Forbidden";
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
    case 421:
      return "Misdirected Request";
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
    case 507:
      return "Insufficient Storage";
    default:
      return "Status";
  }
}

} // namespace

std::string replyHead(const HttpReply& reply, std::string_view requestId, bool keepAlive) {
  std::string head = "HTTP/1.1 " + std::to_string(reply.status) + " ";
  head.append(reasonPhrase(reply.status)).append("\r\n");
  addHeader(head, "Date", dateText());
  addHeader(head, "X-Request-ID", requestId);
  if (!reply.contentType.empty()) addHeader(head, "Content-Type", reply.contentType);
  if (reply.status != 204 && reply.status != 304 && !reply.bodyOmitted && !reply.stream) {
    addHeader(head, "Content-Length", std::to_string(reply.body.size()));
  }
  for (const auto& [name, value] : reply.headers) {
    addHeader(head, name, value);
  }
  if (!brings(reply, "Content-Security-Policy")) addHeader(head, "Content-Security-Policy", "default-src 'none'");
  addHeader(head, "X-Content-Type-Options", "nosniff");
  addHeader(head, "Connection", keepAlive && !reply.stream ? "keep-alive" : "close");
  head.append("\r\n");
  return head;
}

HttpReply jsonReply(const Json& json, int status) {
  HttpReply reply;
  reply.status = status;
  reply.contentType = "application/json";
  reply.body = jsonText(json);
  reply.headers.emplace_back("Cache-Control", "no-cache");
  return reply;
}

int statusOf(ProblemCode code, RequestPart read) {
  switch (code) {
    case ProblemCode::malformed:
    case ProblemCode::invalidValue:
      return 400;
    case ProblemCode::unauthorized:
      return 401;
    case ProblemCode::forbidden:
      return 403;
    case ProblemCode::notFound:
      return 404;
    case ProblemCode::methodNotAllowed:
      return 405;
    case ProblemCode::notAcceptable:
      return 406;
    case ProblemCode::lengthRequired:
      return 411;
    case ProblemCode::tooLarge:
      return read == RequestPart::head ? 431 : 413;
    case ProblemCode::unsupportedMediaType:
      return 415;
    case ProblemCode::invalidScene:
    case ProblemCode::unsupportedFeature:
    case ProblemCode::hashMismatch:
      return 422;
    case ProblemCode::misdirected:
      return 421;
    case ProblemCode::busy:
      return 429;
    case ProblemCode::unavailable:
      return 503;
    case ProblemCode::deadlineExceeded:
      return read == RequestPart::whole ? 504 : 408;
    case ProblemCode::insufficientStorage:
      return 507;
    case ProblemCode::backend:
    case ProblemCode::internal:
      return 500;
  }
  return 500;
}

HttpReply problemReply(const Problems& problems, std::string_view instance, const ProblemReplyOptions& options) {
  HttpReply reply;
  reply.status = statusOf(problems.front().code, options.read);
  reply.contentType = "application/problem+json";
  reply.body = problemJson(problems, reply.status, instance).dump();
  reply.headers.emplace_back("Cache-Control", "no-store");
  if (reply.status == 429 || reply.status == 503) {
    reply.headers.emplace_back("Retry-After", std::to_string(options.retryAfterSeconds));
  }
  reply.problem = problems.front().detail;
  return reply;
}

Problem noReplyRoom() {
  return {ProblemCode::unavailable, "", "Replies that other clients are taking use all the memory for replies.", "",
          ""};
}

} // namespace gnomon
