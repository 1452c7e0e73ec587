#include "server/http/request_body.h"

#include <algorithm>
#include <charconv>

namespace gnomon {
namespace {

Problem bodyTooLarge(std::size_t ofRoute, std::size_t allBodies, std::string actual) {
  const char* const detail = ofRoute <= allBodies
                                 ? "The body is larger than this route accepts."
                                 : "The body is larger than all bodies together may be (--upload-memory-bytes).";
  return {ProblemCode::tooLarge, "", detail, std::to_string(std::min(ofRoute, allBodies)) + " bytes",
          std::move(actual)};
}

Problem brokenChunks(std::string detail) {
  return {ProblemCode::malformed, "", std::move(detail), "", ""};
}

/// What one server takes for the end of a line another one may not (a lone CR or LF).
bool isControl(char c) {
  return (static_cast<unsigned char>(c) < 0x20 && c != '\t') || c == 0x7f;
}

/// Of a chunk's first line: hexadecimal digits, and after blanks the extensions, which say nothing to us.
std::optional<std::size_t> chunkSize(std::string_view line) {
  const std::string_view digits = line.substr(0, line.find_first_of("; \t"));
  const std::size_t rest = std::min(line.find_first_not_of(" \t", digits.size()), line.size());
  std::size_t size = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), size, 16);
  const bool whole = !digits.empty() && error == std::errc() && end == digits.data() + digits.size();
  if (!whole || (rest < line.size() && line[rest] != ';')) return std::nullopt;
  return size;
}

/// Takes bytes off the socket as the framing of the body needs them.
class BodyReader {
 public:
  BodyReader(SocketReader& reader, const BodyRule& rule, const Pace& pace, ByteLease& lease, const StopSignal* cut)
      : reader_(reader), rule_(rule), pace_(pace, {&lease.budget()}, lease.holder()), lease_(lease), cut_(cut) {}

  /// Appends `count` bytes to the body; false = refused.
  bool append(std::size_t count) {
    while (count > 0) {
      if (reader_.buffered().empty() && !more(std::min<std::size_t>(count, 64 * 1024))) return false;
      const std::string_view bytes = reader_.buffered().substr(0, count);
      if (!lease_.grow(bytes.size())) {
        refused = {ProblemCode::busy, "", "Other uploads in progress use all the memory for uploads.", "", ""};
        return false;
      }
      body.insert(body.end(), bytes.begin(), bytes.end());
      count -= bytes.size();
      reader_.consume(bytes.size());
    }
    return true;
  }

  /// A line without its CR LF; false = refused.
  bool line(std::string& text) {
    constexpr std::size_t kMost = 1024;
    while (true) {
      const std::string_view start = reader_.buffered().substr(0, kMost + 2);
      const std::size_t end = start.find("\r\n");
      if (end != std::string_view::npos) {
        text = start.substr(0, end);
        reader_.consume(end + 2);
        if (std::any_of(text.begin(), text.end(), isControl)) {
          refused = brokenChunks("A chunk's line has a control character.");
          return false;
        }
        return true;
      }
      if (start.size() == kMost + 2) {
        refused = brokenChunks("A chunk's line is too long.");
        return false;
      }
      if (!more(kMost)) return false;
    }
  }

  bool chunks() {
    std::string text;
    while (true) {
      if (!line(text)) return false;
      const std::optional<std::size_t> announced = chunkSize(text);
      if (!announced) {
        refused = brokenChunks("A chunk's size is not a hexadecimal number.");
        return false;
      }
      const std::size_t size = *announced;
      if (size == 0) return trailers();
      const std::size_t allBodies = lease_.budget().total();
      if (size > std::min(rule_.maxBytes, allBodies) - body.size()) {
        refused = bodyTooLarge(rule_.maxBytes, allBodies, "");
        return false;
      }
      if (!append(size) || !line(text)) return false;
      if (!text.empty()) {
        refused = brokenChunks("Chunk data exceeds the declared size.");
        return false;
      }
    }
  }

  Bytes body;
  Problem refused;

 private:
  bool trailers() {
    std::string text;
    for (std::size_t count = 0; count <= kMaxHeaders; ++count) {
      if (!line(text)) return false;
      if (text.empty()) return true;
    }
    refused = brokenChunks("The chunked body has too many trailers.");
    return false;
  }

  bool more(std::size_t most) {
    auto waited = SocketWait::timedOut;
    auto state = TransferState::goesOn;
    while (waited == SocketWait::timedOut && (state = pace_.state(Clock::now())) == TransferState::goesOn) {
      const std::size_t before = reader_.buffered().size();
      waited = reader_.receive(most, pace_.wait(Clock::now()), cut_);
      pace_.moved(reader_.buffered().size() - before, Clock::now());
    }
    if (state == TransferState::tooSlow) {
      refused = {ProblemCode::deadlineExceeded, "", "The body arrived too slowly.", "", ""};
    } else if (state == TransferState::othersWaited) {
      refused = {ProblemCode::deadlineExceeded, "",
                 "The body arrived too slowly while other clients waited for the memory that it took.", "", ""};
    } else if (waited == SocketWait::closed) {
      refused = {ProblemCode::malformed, "", "The connection ended before the body did.", "", ""};
    } else if (waited == SocketWait::cutOff) {
      refused = {ProblemCode::unavailable, "", "The server is shutting down, and the body was not here yet.", "", ""};
    }
    return waited == SocketWait::ready;
  }

  SocketReader& reader_;
  const BodyRule& rule_;
  TransferPace pace_;
  ByteLease& lease_;
  const StopSignal* cut_;
};

} // namespace

std::optional<Problem> refuseBody(const RequestHead& head, const BodyRule& rule, std::size_t allBodies) {
  if (rule.framing == BodyRule::Framing::none) {
    if (head.hasBody()) return Problem{ProblemCode::tooLarge, "", "This route accepts no body.", "0 bytes", ""};
    return std::nullopt;
  }
  const bool isOptional = rule.framing == BodyRule::Framing::length;
  if (isOptional ? head.chunked : !head.chunked && !head.contentLength) {
    return Problem{ProblemCode::lengthRequired, "", "This route needs a body with a Content-Length.", "", ""};
  }
  if (head.contentLength.value_or(0) <= std::min(rule.maxBytes, allBodies)) return std::nullopt;
  return bodyTooLarge(rule.maxBytes, allBodies, std::to_string(*head.contentLength) + " bytes");
}

Result<Bytes> readBody(SocketReader& reader, const RequestHead& head, const BodyRule& rule, const Pace& pace,
                       ByteLease& lease, const StopSignal* cut) {
  BodyReader body(reader, rule, pace, lease, cut);
  const bool whole =
      head.chunked ? body.chunks() : body.append(static_cast<std::size_t>(head.contentLength.value_or(0)));
  if (!whole) return std::move(body.refused);
  return std::move(body.body);
}

} // namespace gnomon
