#include "clients/cli/remote/webm_watch.h"

#include <algorithm>
#include <bit>

namespace gnomon::cli {
namespace {

constexpr std::uint64_t kSegment = 0x18538067, kCluster = 0x1f43b675, kTags = 0x1254c367, kTag = 0x7373;
constexpr std::uint64_t kSimpleTag = 0x67c8, kTagName = 0x45a3, kTagString = 0x4487;
constexpr std::uint64_t kMostTagBytes = 64u << 20; ///< a report of the most frames is a tenth of it

/// An element's head (RFC 8794).
struct Head {
  std::uint64_t id = 0;
  std::uint64_t size = 0; ///< of what follows it
  std::size_t bytes = 0;  ///< of itself; 0 = more are needed
};

std::size_t lengthAt(std::string_view bytes) {
  return bytes.empty() ? 9 : static_cast<std::size_t>(std::countl_zero(static_cast<std::uint8_t>(bytes[0]))) + 1;
}

std::uint64_t numberOf(std::string_view bytes) {
  std::uint64_t value = 0;
  for (const char byte : bytes) value = value << 8 | static_cast<std::uint8_t>(byte);
  return value;
}

Head headOf(std::string_view bytes) {
  const std::size_t idBytes = lengthAt(bytes);
  if (idBytes >= bytes.size()) return {};
  const std::size_t sizeBytes = lengthAt(bytes.substr(idBytes));
  if (idBytes + sizeBytes > bytes.size()) return {};
  const std::uint64_t marked = numberOf(bytes.substr(idBytes, sizeBytes));
  return {numberOf(bytes.substr(0, idBytes)), marked & ~(1ull << (7 * sizeBytes)), idBytes + sizeBytes};
}

/// What the first element of this id holds; empty where there is none.
std::string_view within(std::string_view bytes, std::uint64_t id) {
  while (!bytes.empty()) {
    const Head head = headOf(bytes);
    if (head.bytes == 0) return {};
    bytes.remove_prefix(head.bytes);
    if (head.id == id) return bytes.substr(0, head.size);
    bytes.remove_prefix(std::min<std::uint64_t>(head.size, bytes.size()));
  }
  return {};
}

} // namespace

void WebmWatch::read(std::string_view bytes) {
  while (!bytes.empty() && !isBroken_) {
    const auto passed = static_cast<std::size_t>(std::min<std::uint64_t>(skipped_, bytes.size()));
    bytes.remove_prefix(passed);
    skipped_ -= passed;
    if (skipped_ > 0) return;
    frames_ += isCluster_ ? 1 : 0;
    isCluster_ = false;
    waiting_ += bytes;
    const std::size_t taken = readElement(waiting_);
    if (taken == 0) return;
    bytes.remove_prefix(bytes.size() - (waiting_.size() - taken)); // what waited before was a part of what was taken
    waiting_.clear();
  }
}

/// How many bytes are done with: 0 = more are needed.
std::size_t WebmWatch::readElement(std::string_view bytes) {
  constexpr std::size_t kMostHead = 8 + 8;
  const Head head = headOf(bytes);
  if (head.bytes == 0) {
    isBroken_ = bytes.size() > kMostHead;
    return 0;
  }
  if (head.id == kSegment) return head.bytes; // and on with what it holds
  if (head.id != kTags) {
    isCluster_ = head.id == kCluster;
    skipped_ = head.size;
    return head.bytes;
  }
  isBroken_ = head.size > kMostTagBytes;
  if (isBroken_ || bytes.size() < head.bytes + head.size) return 0;
  const std::string_view tag = within(within(bytes.substr(head.bytes, head.size), kTag), kSimpleTag);
  tag_ = VideoTag{std::string(within(tag, kTagName)), std::string(within(tag, kTagString))};
  return head.bytes + static_cast<std::size_t>(head.size);
}

} // namespace gnomon::cli
