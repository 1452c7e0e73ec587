// The body of a request: its first byte says how it is framed and how it comes, what follows is what the client sends.
// However the bytes come, the same body is read, and the same bytes are left for the next request.
#include <algorithm>
#include <sys/socket.h>
#include <unistd.h>

#include "server/http/request_body.h"
#include "server/system/file_descriptor.h"
#include "tests/fuzz/sound_problems.h"

namespace {

using namespace gnomon;

constexpr std::size_t kMostBytes = 4096; ///< of a body

struct Read {
  Result<Bytes> body;
  std::string left; ///< for the next request
};

/// The first `early` bytes have come with the head; the rest lies in the socket, whose other end is closed.
Read readSent(std::string_view sent, std::size_t early, const RequestHead& head) {
  int ends[2];
  fuzz::require(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends) == 0, "a pair of sockets");
  const FileDescriptor server(ends[0]);
  {
    const FileDescriptor client(ends[1]);
    const std::string_view late = sent.substr(early);
    fuzz::require(::send(client.get(), late.data(), late.size(), MSG_DONTWAIT) == static_cast<ssize_t>(late.size()),
                  "a socket holds an input");
  }
  SocketReader reader(server.get(), std::string(sent.substr(0, early)));
  ByteBudget budget(kMostBytes);
  ByteLease lease(budget);
  Read read{readBody(reader, head, {BodyRule::Framing::any, kMostBytes}, Pace{}, lease), reader.take()};
  char piece[4096];
  for (ssize_t n = 0; (n = ::read(server.get(), piece, sizeof piece)) > 0;) {
    read.left.append(piece, static_cast<std::size_t>(n));
  }
  return read;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t kMostSent = 32 * 1024;
  if (size == 0 || size > kMostSent) return 0;
  const std::string_view sent(reinterpret_cast<const char*>(data) + 1, size - 1);
  RequestHead head;
  head.chunked = data[0] % 2 == 0;
  if (!head.chunked) head.contentLength = data[0] * 16;
  const Read whole = readSent(sent, sent.size(), head);
  const Read parts = readSent(sent, sent.size() * (data[0] / 2 % 8) / 8, head);
  fuzz::require(bool(whole.body) == bool(parts.body), "how bytes come makes no body right or wrong");
  if (!whole.body) {
    fuzz::requireSound(whole.body.problems());
    return 0;
  }
  fuzz::require(*whole.body == *parts.body, "how bytes come changes no body");
  fuzz::require(whole.left == parts.left, "how bytes come changes nothing of the next request");
  fuzz::require(sent.ends_with(whole.left), "what is left is the end of what was sent");
  fuzz::require(whole.body->size() <= kMostBytes, "no body is longer than may be");
  return 0;
}
