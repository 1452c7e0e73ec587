// The head of a request, up to its empty line, and who it says has sent it through a proxy, in which trace: nothing in
// it that two servers could read in two ways, and written again it says the same.
#include "server/http/client_address.h"
#include "server/http/request_log.h"
#include "tests/fuzz/sound_problems.h"

namespace {

using namespace gnomon;

void requirePlainLines(std::string_view head) {
  for (std::size_t i = 0; i < head.size(); ++i) {
    const auto c = static_cast<unsigned char>(head[i]);
    if (c == '\r') {
      fuzz::require(i + 1 < head.size() && head[i + 1] == '\n', "a CR stands before an LF");
    } else if (c == '\n') {
      fuzz::require(i > 0 && head[i - 1] == '\r', "an LF stands behind a CR");
    } else {
      fuzz::require((c >= 0x20 || c == '\t') && c != 0x7f, "a head has no control characters");
    }
  }
}

std::string written(const RequestHead& head) {
  std::string text = head.method + ' ' + head.target + (head.isHttp11 ? " HTTP/1.1\r\n" : " HTTP/1.0\r\n");
  for (const auto& [name, value] : head.headers) text += name + ": " + value + "\r\n";
  return text + "\r\n";
}

bool isHex(const std::string& text) {
  return text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

void requireSoundOrigin(const HttpRequest& request) {
  const TraceContext& trace = request.trace;
  fuzz::require(trace.traceId.size() == 32 && isHex(trace.traceId), "a trace has an id");
  fuzz::require(trace.spanId.size() == 16 && isHex(trace.spanId), "a span has an id");
  fuzz::require(isHex(trace.parentId), "its sender's is one, or none");
  static const auto kProxies = ipNetworks({"10.0.0.0/8", "fd00::/8"});
  static const PeerAddress kProxy = peerAddress(*ipAddress("10.0.0.1"));
  const PeerAddress client = clientAddress(kProxy, request.headers, *kProxies);
  const auto address = ipAddress(client.text);
  fuzz::require(address.has_value(), "a client has an address");
  fuzz::require(client.identity == peerAddress(*address).identity, "which is in its network");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto length = headLength(text);
  if (!length) return 0;
  const std::string_view bytes = text.substr(0, *length);
  const auto head = parseRequestHead(bytes);
  if (!head) {
    fuzz::requireSound(head.problems());
    return 0;
  }
  requirePlainLines(bytes);
  fuzz::require(!(head->chunked && head->contentLength), "a body has one end");
  fuzz::require(head->headers.size() <= kMaxHeaders + 1, "no more headers than may come");
  const bool mayComeAgain = head->headers.size() <= kMaxHeaders; // an absolute target has its Host besides those
  const auto again = mayComeAgain ? parseRequestHead(written(*head)) : head;
  fuzz::require(again && written(*again) == written(*head) && again->chunked == head->chunked &&
                    again->contentLength == head->contentLength && again->keepAlive == head->keepAlive &&
                    again->expectsContinue == head->expectsContinue,
                "a head that is written again says the same");
  const auto request = requestFromHead(*head);
  if (request) {
    requireSoundOrigin(*request);
  } else {
    fuzz::requireSound(request.problems());
  }
  return 0;
}
