#include "server/http/request.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <random>

#include "protocol/base/text.h"
#include "server/http/request_log.h"
#include "server/system/numbers.h"

namespace gnomon {
namespace {

Problem malformedHead(std::string detail) {
  return {ProblemCode::malformed, "", std::move(detail), "", ""};
}

bool isToken(std::string_view text) {
  constexpr std::string_view kMarks = "!#$%&'*+-.^_`|~";
  return !text.empty() && std::all_of(text.begin(), text.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

bool isMethod(std::string_view text) {
  return isToken(text) && text.size() <= 16;
}

bool isFieldValue(std::string_view text) {
  return std::none_of(text.begin(), text.end(),
                      [](char c) { return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f; });
}

/// A target in absolute form (RFC 9112 section 3.2.2), in its two parts.
struct AbsoluteForm {
  std::string authority; ///< empty: the target was in origin form
  std::string target;
};

AbsoluteForm cutAbsoluteForm(std::string_view target) {
  for (const std::string_view scheme : {"http://", "https://"}) {
    if (lowerCase(target.substr(0, scheme.size())) == scheme) {
      target.remove_prefix(scheme.size());
      const std::size_t end = std::min(target.find_first_of("/?#"), target.size());
      const std::string_view rest = target.substr(end);
      return {std::string(target.substr(0, end)), (rest.starts_with('/') ? "" : "/") + std::string(rest)};
    }
  }
  return {"", std::string(target)};
}

/// `authority` is that of a target in absolute form.
Status readRequestLine(std::string_view line, RequestHead& head, std::string& authority) {
  const std::size_t first = line.find(' ');
  const std::size_t last = line.rfind(' ');
  if (first == std::string_view::npos || first == last) {
    return malformedHead("The request line is not a method, a target and a version.");
  }
  const std::string_view method = line.substr(0, first);
  const std::string_view target = line.substr(first + 1, last - first - 1);
  const std::string_view version = line.substr(last + 1);
  if (!isMethod(method)) {
    return malformedHead("The method is not a token of at most 16 characters.");
  }
  if (version != "HTTP/1.1" && version != "HTTP/1.0") {
    return malformedHead("The version is neither HTTP/1.1 nor HTTP/1.0.");
  }
  const AbsoluteForm absolute = cutAbsoluteForm(target);
  const bool isOfServer = method == "OPTIONS" && target == kWholeServer;
  if (absolute.target.empty() || (absolute.target.front() != '/' && !isOfServer) ||
      std::any_of(target.begin(), target.end(), [](char c) { return c <= 0x20 || c == 0x7f; })) {
    return malformedHead("The request target must begin with '/' and contain only visible ASCII characters.");
  }
  head.method = method;
  head.target = absolute.target;
  authority = absolute.authority;
  head.isHttp11 = version == "HTTP/1.1";
  head.keepAlive = head.isHttp11;
  return Done{};
}

Status readHeader(std::string_view line, RequestHead& head) {
  const std::size_t colon = line.find(':');
  if (colon == std::string_view::npos || !isToken(line.substr(0, colon))) {
    return malformedHead("A header line is not a name, a colon and a value.");
  }
  const std::string_view value = trimmed(line.substr(colon + 1));
  if (!isFieldValue(value)) return malformedHead("A header's value contains a control character.");
  head.headers.emplace_back(lowerCase(line.substr(0, colon)), std::string(value));
  return Done{};
}

std::size_t countOf(const Headers& headers, std::string_view name) {
  return static_cast<std::size_t>(
      std::count_if(headers.begin(), headers.end(), [&](const auto& header) { return header.first == name; }));
}

/// Where the body ends, by the two headers that may say so (RFC 9112 section 6).
Status readFraming(RequestHead& head) {
  const auto encoding = headerValue(head.headers, "transfer-encoding");
  const auto length = headerValue(head.headers, "content-length");
  if (encoding && length) return malformedHead("A request must not have both Content-Length and Transfer-Encoding.");
  if (encoding) {
    if (!head.isHttp11 || lowerCase(*encoding) != "chunked") {
      return malformedHead("The only Transfer-Encoding accepted is 'chunked', with HTTP/1.1.");
    }
    head.chunked = true;
  }
  if (length) {
    head.contentLength = numberIn<std::uint64_t>(*length);
    if (countOf(head.headers, "content-length") != 1 || !head.contentLength) {
      return malformedHead("Content-Length is not one decimal number.");
    }
  }
  return Done{};
}

bool isWellFormedId(std::string_view id) {
  constexpr std::string_view kMarks = "-._:";
  return !id.empty() && id.size() <= 128 && std::all_of(id.begin(), id.end(), [&](char c) {
    return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
           kMarks.find(c) != std::string_view::npos;
  });
}

/// Unique in this process and, by its random start, very likely between processes.
std::string newRequestId() {
  static const std::uint64_t start = (std::uint64_t{std::random_device{}()} << 32) | std::random_device{}();
  static std::atomic<std::uint64_t> count{0};
  const std::uint64_t value = start + ++count;
  std::array<std::uint8_t, 8> bytes;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(value >> (56 - 8 * i));
  }
  return hexText(bytes);
}

} // namespace

std::optional<std::string> headerValue(const Headers& headers, std::string_view name) {
  std::optional<std::string> value;
  for (const auto& [key, text] : headers) {
    if (key == name) value = value ? *value + ", " + text : text;
  }
  return value;
}

std::string mediaType(std::string_view contentType) {
  return lowerCase(trimmed(contentType.substr(0, contentType.find(';'))));
}

std::optional<std::size_t> headLength(std::string_view bytes) {
  constexpr std::string_view kEnd = "\r\n\r\n";
  for (std::size_t at = bytes.find('\n'); at != std::string_view::npos; at = bytes.find('\n', at + 1)) {
    const bool isBare = at == 0 || bytes[at - 1] != '\r';
    if (isBare || bytes.substr(0, at + 1).ends_with(kEnd)) return at + 1;
  }
  return std::nullopt;
}

HeadExcerpt excerptOf(std::string_view bytes) {
  while (bytes.starts_with('\r') || bytes.starts_with('\n')) bytes.remove_prefix(1);
  const std::string_view line = bytes.substr(0, bytes.find_first_of("\r\n"));
  const std::size_t space = line.find(' ');
  const std::string_view method = line.substr(0, space);
  if (!isMethod(method)) return {};
  HeadExcerpt excerpt{std::string(method), ""};
  if (space == std::string_view::npos) return excerpt;
  excerpt.target = line.substr(space + 1, line.rfind(" HTTP/") - space - 1);
  std::replace_if(
      excerpt.target.begin(), excerpt.target.end(), [](char c) { return c <= 0x20 || c >= 0x7f; }, '?');
  return excerpt;
}

Result<RequestHead> parseRequestHead(std::string_view bytes) {
  RequestHead head;
  std::string authority;
  bool first = true;
  if (bytes.starts_with("\r\n")) bytes.remove_prefix(2);
  while (true) {
    const std::size_t end = bytes.find("\r\n");
    if (end == std::string_view::npos) {
      return malformedHead(bytes.ends_with('\n') ? "A line of the head ends with LF alone; CR LF is needed."
                                                 : "The headers do not end with an empty line.");
    }
    const std::string_view line = bytes.substr(0, end);
    bytes.remove_prefix(end + 2);
    if (line.empty() && !first) break;
    if (!first && head.headers.size() == kMaxHeaders) {
      return Problem{ProblemCode::tooLarge, "", "The request has too many headers.", std::to_string(kMaxHeaders), ""};
    }
    if (auto read = first ? readRequestLine(line, head, authority) : readHeader(line, head); !read) {
      return std::move(read).problems();
    }
    first = false;
  }
  if (auto framing = readFraming(head); !framing) return std::move(framing).problems();
  if (countOf(head.headers, "host") != 1 && (head.isHttp11 || countOf(head.headers, "host") > 1)) {
    return malformedHead("The request must have exactly one Host header.");
  }
  if (!authority.empty()) {
    std::erase_if(head.headers, [](const auto& header) { return header.first == "host"; });
    head.headers.emplace_back("host", authority);
  }
  for (const std::string& option : splitTrimmed(lowerCase(headerValue(head.headers, "connection").value_or("")), ',')) {
    head.keepAlive = option == "close" ? false : option == "keep-alive" ? true : head.keepAlive;
  }
  head.expectsContinue = head.isHttp11 && lowerCase(headerValue(head.headers, "expect").value_or("")) == "100-continue";
  return head;
}

Result<HttpRequest> requestFromHead(const RequestHead& head) {
  auto url = head.target == kWholeServer ? Result<Url>(Url{}) : parseTarget(head.target);
  if (!url) return std::move(url).problems();
  HttpRequest request;
  request.id = requestId(headerValue(head.headers, "x-request-id"));
  request.method = head.method;
  request.target = head.target;
  request.path = std::move(url->path);
  request.query = std::move(url->query);
  request.headers = head.headers;
  request.hasBody = head.hasBody();
  request.trace = traceOf(head.headers);
  return request;
}

std::string requestId(const std::optional<std::string>& offered) {
  return offered && isWellFormedId(*offered) ? *offered : newRequestId();
}

} // namespace gnomon
