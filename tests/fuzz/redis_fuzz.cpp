// Replies of a Redis server, whole and in pieces: read alike, and never more than was asked for.
#include <algorithm>

#include "server/redis/reply.h"
#include "tests/fuzz/require.h"

namespace {

using namespace gnomon;

constexpr redis::ReplyLimits kMost{.bytes = 4'096, .elements = 64};

struct Counted {
  std::size_t elements = 0;
  std::size_t bytes = 0;
};

void count(const redis::Reply& reply, Counted& counted) {
  counted.bytes += reply.text.size();
  counted.elements += reply.elements.size();
  for (const redis::Reply& element : reply.elements) count(element, counted);
}

/// Everything that can be read, where pieces have so many bytes.
Counted readAll(std::string_view bytes, std::size_t piece) {
  redis::ReplyReader reader;
  reader.allow(kMost);
  Counted counted;
  while (!bytes.empty() && reader.feed(bytes.substr(0, piece))) {
    bytes.remove_prefix(std::min(piece, bytes.size()));
    while (const auto reply = reader.next()) count(*reply, counted);
  }
  return counted;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1 || size > kMost.bytes) return 0;
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const Counted whole = readAll(text, text.size());
  const Counted pieces = readAll(text, 1 + data[0]);
  fuzz::require(whole.elements == pieces.elements && whole.bytes == pieces.bytes, "pieces change no reply");
  fuzz::require(whole.elements <= kMost.elements && whole.bytes <= kMost.bytes, "no more is held than was asked for");
  return 0;
}
