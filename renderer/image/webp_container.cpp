// WebP's chunks: RFC 9649, section 2; the headers of its bitstreams: RFC 6386, section 9.1, and RFC 9649, section 3.4.
#include <algorithm>
#include <optional>
#include <string_view>
#include <utility>

#include "renderer/image/image_container.h"

namespace gnomon {
namespace {

constexpr std::size_t kFileHeader = 12; ///< "RIFF", the size of what follows it, "WEBP"
constexpr std::size_t kChunkHeader = 8;
constexpr std::size_t kExtendedHeader = 10;
constexpr std::uint8_t kAnimationFlag = 0x02;
constexpr std::uint8_t kAlphaFlag = 0x10;

struct Chunk {
  std::string_view type;
  EncodedBytes payload;
  std::size_t length = 0; ///< that the file states: more than the payload's where the file ends first
  std::size_t next = 0;   ///< where the following one begins
};

/// The parts of a still picture that its pixels depend on.
struct StillWebp {
  ImageSize size;
  bool lossless = false;
  EncodedBytes bitstream;
  std::size_t bitstreamLength = 0; ///< as Chunk::length
  EncodedBytes alpha;              ///< of a lossy picture; empty = opaque
};

Problem cutShort() {
  return malformedImage("The WebP is cut short.");
}

Problem animated() {
  return unsupportedImage("The WebP is animated; only still ones are read.");
}

/// `riff` ends where the container says that it does.
std::optional<Chunk> chunkAt(EncodedBytes riff, std::size_t position) {
  if (position > riff.size() || riff.size() - position < kChunkHeader) return std::nullopt;
  const std::size_t length = littleEndian(riff, position + 4, 4);
  const std::size_t begin = position + kChunkHeader;
  return Chunk{{reinterpret_cast<const char*>(riff.data()) + position, 4},
               riff.subspan(begin, std::min(length, riff.size() - begin)),
               length,
               begin + length + length % 2};
}

Result<ImageSize> lossySize(EncodedBytes bitstream) {
  if (bitstream.size() < 10) return malformedImage("The WebP ends within its frame header.");
  const std::uint32_t tag = littleEndian(bitstream, 0, 3);
  const bool keyFrame = (tag & 1) == 0;
  const std::uint32_t profile = tag >> 1 & 7;
  const bool shown = (tag >> 4 & 1) != 0;
  const std::size_t firstPartition = tag >> 5;
  if (!keyFrame || profile > 3 || !shown || firstPartition >= bitstream.size() ||
      littleEndian(bitstream, 3, 3) != 0x2a019d) {
    return malformedImage("The WebP has no valid frame header.");
  }
  const auto width = static_cast<int>(littleEndian(bitstream, 6, 2) & 0x3fff);
  const auto height = static_cast<int>(littleEndian(bitstream, 8, 2) & 0x3fff);
  if (width == 0 || height == 0) return malformedImage("The WebP has no valid width and height.");
  return ImageSize{width, height};
}

Result<ImageSize> losslessSize(EncodedBytes bitstream) {
  if (bitstream.size() < 5) return malformedImage("The WebP ends within its frame header.");
  const std::uint32_t bits = littleEndian(bitstream, 1, 4);
  const std::uint32_t version = bits >> 29;
  if (bitstream[0] != 0x2f || version != 0) return malformedImage("The WebP has no valid frame header.");
  return ImageSize{static_cast<int>(bits & 0x3fff) + 1, static_cast<int>(bits >> 14 & 0x3fff) + 1};
}

Result<StillWebp> stillOf(const Chunk& chunk, EncodedBytes alpha) {
  const bool lossless = chunk.type == "VP8L";
  const auto size = lossless ? losslessSize(chunk.payload) : lossySize(chunk.payload);
  if (!size) return size.problems();
  return StillWebp{*size, lossless, chunk.payload, chunk.length, lossless ? EncodedBytes{} : alpha};
}

bool isPicture(const Chunk& chunk) {
  return chunk.type == "VP8 " || chunk.type == "VP8L";
}

/// The picture behind the chunk `header` of an extended file.
Result<StillWebp> extendedStill(EncodedBytes riff, const Chunk& header) {
  if (header.payload.size() != kExtendedHeader) return malformedImage("The WebP has no valid extended header.");
  if ((header.payload[0] & kAnimationFlag) != 0) return animated();
  const std::uint32_t width = littleEndian(header.payload, 4, 3) + 1;
  const std::uint32_t height = littleEndian(header.payload, 7, 3) + 1;
  EncodedBytes alpha;
  std::size_t position = header.next;
  while (const std::optional<Chunk> chunk = chunkAt(riff, position)) {
    if (chunk->type == "ANIM" || chunk->type == "ANMF") return animated();
    if (chunk->type == "ALPH") alpha = chunk->payload;
    if (isPicture(*chunk)) {
      auto still = stillOf(*chunk, alpha);
      if (still && (static_cast<std::uint32_t>(still->size.width) != width ||
                    static_cast<std::uint32_t>(still->size.height) != height)) {
        return malformedImage("The WebP's picture is not as large as its canvas.");
      }
      return still;
    }
    position = chunk->next;
  }
  return cutShort();
}

Result<StillWebp> readStill(EncodedBytes encoded) {
  if (encoded.size() < kFileHeader) return cutShort();
  const std::size_t size = littleEndian(encoded, 4, 4);
  if (size < 4) return cutShort();
  const EncodedBytes riff = encoded.first(std::min(encoded.size(), kChunkHeader + size));
  const std::optional<Chunk> first = chunkAt(riff, kFileHeader);
  if (!first) return cutShort();
  if (first->type == "VP8X") return extendedStill(riff, *first);
  if (isPicture(*first)) return stillOf(*first, {});
  return malformedImage("The WebP does not begin with a picture.");
}

void appendLittleEndian(Bytes& bytes, std::size_t value, int count) {
  for (int i = 0; i < count; ++i) bytes.push_back(static_cast<std::uint8_t>(value >> 8 * i & 0xff));
}

/// `length`: what it states to have; of the last chunk it may be more than it has.
void appendRiffChunk(Bytes& bytes, std::string_view type, EncodedBytes payload, std::size_t length) {
  bytes.insert(bytes.end(), type.begin(), type.end());
  appendLittleEndian(bytes, length, 4);
  bytes.insert(bytes.end(), payload.begin(), payload.end());
  if (payload.size() == length && length % 2 != 0) bytes.push_back(0);
}

/// The bytes that the picture lacks.
std::size_t missingFrom(const StillWebp& still) {
  const std::size_t padded = still.bitstreamLength + still.bitstreamLength % 2;
  return still.bitstream.size() < still.bitstreamLength ? padded - still.bitstream.size() : 0;
}

Bytes fileOf(const Bytes& chunks, const StillWebp& still) {
  constexpr std::string_view kForm = "WEBP";
  Bytes content(kForm.begin(), kForm.end());
  content.insert(content.end(), chunks.begin(), chunks.end());
  Bytes file;
  appendRiffChunk(file, "RIFF", content, content.size() + missingFrom(still));
  return file;
}

Bytes pictureChunk(const StillWebp& still) {
  Bytes chunk;
  appendRiffChunk(chunk, still.lossless ? "VP8L" : "VP8 ", still.bitstream, still.bitstreamLength);
  return chunk;
}

Bytes withLossyAlpha(const StillWebp& still) {
  Bytes header{kAlphaFlag, 0, 0, 0};
  appendLittleEndian(header, static_cast<std::size_t>(still.size.width - 1), 3);
  appendLittleEndian(header, static_cast<std::size_t>(still.size.height - 1), 3);
  Bytes chunks;
  appendRiffChunk(chunks, "VP8X", header, header.size());
  appendRiffChunk(chunks, "ALPH", still.alpha, still.alpha.size());
  const Bytes picture = pictureChunk(still);
  chunks.insert(chunks.end(), picture.begin(), picture.end());
  return fileOf(chunks, still);
}

} // namespace

Result<ImageSize> webpSize(EncodedBytes encoded) {
  const auto still = readStill(encoded);
  if (!still) return still.problems();
  return still->size;
}

Result<EssentialImage> essentialWebp(EncodedBytes encoded) {
  const auto still = readStill(encoded);
  if (!still) return still.problems();
  Bytes bytes = still->alpha.empty() ? fileOf(pictureChunk(*still), *still) : withLossyAlpha(*still);
  return EssentialImage{std::move(bytes), missingFrom(*still) > 0};
}

} // namespace gnomon
