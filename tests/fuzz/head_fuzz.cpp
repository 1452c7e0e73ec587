// The head of a request, up to its empty line: nothing in it that two servers could read in two ways, and written
// again it says the same.
#include "server/http/request.h"
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
  const auto again = parseRequestHead(written(*head));
  fuzz::require(again && written(*again) == written(*head) && again->chunked == head->chunked &&
                    again->contentLength == head->contentLength && again->keepAlive == head->keepAlive &&
                    again->expectsContinue == head->expectsContinue,
                "a head that is written again says the same");
  const auto request = requestFromHead(*head);
  if (!request) fuzz::requireSound(request.problems());
  return 0;
}
