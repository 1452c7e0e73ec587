#include "server/http/reply.h"

#include <algorithm>
#include <ctime>
#include <nlohmann/json.hpp>

#include "protocol/json/problem_rows.h"

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

struct StatusPhrase {
  int status;
  std::string_view phrase;
};
constexpr std::array kPhrases{
    StatusPhrase{200, "OK"},
    StatusPhrase{201, "Created"},
    StatusPhrase{204, "No Content"},
    StatusPhrase{304, "Not Modified"},
    StatusPhrase{400, "Bad Request"},
    StatusPhrase{401, "Unauthorized"},
    StatusPhrase{403, "Forbidden"},
    StatusPhrase{404, "Not Found"},
    StatusPhrase{405, "Method Not Allowed"},
    StatusPhrase{406, "Not Acceptable"},
    StatusPhrase{408, "Request Timeout"},
    StatusPhrase{411, "Length Required"},
    StatusPhrase{412, "Precondition Failed"},
    StatusPhrase{413, "Content Too Large"},
    StatusPhrase{415, "Unsupported Media Type"},
    StatusPhrase{421, "Misdirected Request"},
    StatusPhrase{422, "Unprocessable Content"},
    StatusPhrase{429, "Too Many Requests"},
    StatusPhrase{431, "Request Header Fields Too Large"},
    StatusPhrase{500, "Internal Server Error"},
    StatusPhrase{503, "Service Unavailable"},
    StatusPhrase{504, "Gateway Timeout"},
    StatusPhrase{507, "Insufficient Storage"},
};

std::string_view reasonPhrase(int status) {
  const auto found = std::ranges::find(kPhrases, status, &StatusPhrase::status);
  return found == kPhrases.end() ? "Status" : found->phrase;
}

/// The status of each kind of problem, by the part of the request that was read.
struct ProblemStatus {
  ProblemCode code;
  int whole;
  int head = whole;
  int body = whole;
};
constexpr std::array kProblemStatuses{
    ProblemStatus{ProblemCode::malformed, 400},
    ProblemStatus{ProblemCode::invalidValue, 400},
    ProblemStatus{ProblemCode::notFound, 404},
    ProblemStatus{ProblemCode::methodNotAllowed, 405},
    ProblemStatus{ProblemCode::unauthorized, 401},
    ProblemStatus{ProblemCode::forbidden, 403},
    ProblemStatus{ProblemCode::misdirected, 421},
    ProblemStatus{ProblemCode::notAcceptable, 406},
    ProblemStatus{ProblemCode::preconditionFailed, 412},
    ProblemStatus{ProblemCode::lengthRequired, 411},
    ProblemStatus{ProblemCode::tooLarge, 413, 431},
    ProblemStatus{ProblemCode::unsupportedMediaType, 415},
    ProblemStatus{ProblemCode::invalidScene, 422},
    ProblemStatus{ProblemCode::unsupportedFeature, 422},
    ProblemStatus{ProblemCode::hashMismatch, 422},
    ProblemStatus{ProblemCode::busy, 429},
    ProblemStatus{ProblemCode::deadlineExceeded, 504, 408, 408},
    ProblemStatus{ProblemCode::unavailable, 503},
    ProblemStatus{ProblemCode::insufficientStorage, 507},
    ProblemStatus{ProblemCode::backend, 500},
    ProblemStatus{ProblemCode::internal, 500},
};
static_assert(rowsAreComplete(kProblemStatuses, &ProblemStatus::code));

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
  const ProblemStatus& row = kProblemStatuses[static_cast<std::size_t>(code)];
  return read == RequestPart::whole ? row.whole : read == RequestPart::head ? row.head : row.body;
}

HttpReply problemReply(const Problems& reasons, std::string_view instance, const ProblemReplyOptions& options) {
  const Problems problems = atLeastOne(reasons);
  HttpReply reply;
  reply.status = statusOf(problems.front().code, options.read);
  reply.contentType = "application/problem+json";
  reply.body = jsonText(problemJson(problems, reply.status, instance));
  reply.headers.emplace_back("Cache-Control", "no-store");
  if (reply.status == 429 || reply.status == 503 || options.retryAfterSeconds > 1) {
    reply.headers.emplace_back("Retry-After", std::to_string(options.retryAfterSeconds));
  }
  reply.problem = problems.front().detail;
  reply.refusal = options.refusal;
  return reply;
}

Problem noReplyRoom() {
  return {ProblemCode::unavailable, "", "Replies that other clients are taking use all the memory for replies.", "",
          ""};
}

} // namespace gnomon
