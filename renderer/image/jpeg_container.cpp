// JPEG's marker segments: ITU-T Recommendation T.81, annex B.
#include <optional>
#include <utility>

#include "renderer/image/image_container.h"

namespace gnomon {
namespace {

constexpr std::uint8_t kTemporary = 0x01;
constexpr std::uint8_t kRestartFirst = 0xd0;
constexpr std::uint8_t kRestartLast = 0xd7;
constexpr std::uint8_t kEndOfImage = 0xd9;
constexpr std::uint8_t kStartOfScan = 0xda;
constexpr std::uint8_t kJfif = 0xe0;
constexpr std::uint8_t kAdobe = 0xee; ///< says whether three components are YCbCr or RGB
constexpr std::uint8_t kApplicationLast = 0xef;
constexpr std::uint8_t kComment = 0xfe;

/// A bound on the work of decoding: each scan may touch every pixel; encoders write about ten.
constexpr int kMaxScans = 64;

/// A marker and its segment's payload, as positions in the file.
struct Segment {
  std::uint8_t marker = 0;
  std::size_t begin = 0;   ///< of the marker's 0xff
  std::size_t payload = 0; ///< after the length field
  std::size_t end = 0;
};

bool standsAlone(std::uint8_t marker) {
  return marker == kTemporary || (marker >= kRestartFirst && marker <= kEndOfImage);
}

/// The segment at `position`; fill bytes before the marker are skipped. Nothing where there is none or it is cut short.
std::optional<Segment> segmentAt(EncodedBytes bytes, std::size_t position) {
  if (position >= bytes.size() || bytes[position] != 0xff) return std::nullopt;
  while (position + 1 < bytes.size() && bytes[position + 1] == 0xff) ++position;
  if (position + 1 >= bytes.size()) return std::nullopt;
  const std::uint8_t marker = bytes[position + 1];
  if (standsAlone(marker)) return Segment{marker, position, position + 2, position + 2};
  if (bytes.size() - position < 4) return std::nullopt;
  const std::size_t length = bigEndian(bytes, position + 2, 2);
  if (length < 2 || length > bytes.size() - position - 2) return std::nullopt;
  return Segment{marker, position, position + 4, position + 2 + length};
}

/// Where the entropy-coded data that begins at `position` ends: at the next marker that is no restart.
std::size_t endOfScan(EncodedBytes bytes, std::size_t position) {
  for (; position + 1 < bytes.size(); ++position) {
    if (bytes[position] != 0xff) continue;
    const std::uint8_t next = bytes[position + 1];
    const bool partOfData = next == 0 || next == 0xff || (next >= kRestartFirst && next <= kRestartLast);
    if (!partOfData) return position;
  }
  return bytes.size();
}

bool isFrameHeader(std::uint8_t marker) {
  return marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

/// Sequential or progressive, Huffman or arithmetic coding.
bool isSupportedFrame(std::uint8_t marker) {
  return marker == 0xc0 || marker == 0xc1 || marker == 0xc2 || marker == 0xc9 || marker == 0xca;
}

Result<ImageSize> sizeFromFrame(EncodedBytes encoded, const Segment& frame) {
  if (!isSupportedFrame(frame.marker)) {
    return unsupportedImage("The JPEG is lossless or hierarchical; only sequential and progressive ones are read.");
  }
  if (frame.end - frame.payload < 6) return malformedImage("The JPEG's frame header is too short.");
  if (encoded[frame.payload] != 8) return unsupportedImage("The JPEG does not have 8 bits a sample.");
  const auto height = static_cast<int>(bigEndian(encoded, frame.payload + 1, 2));
  const auto width = static_cast<int>(bigEndian(encoded, frame.payload + 3, 2));
  if (width == 0 || height == 0) return malformedImage("The JPEG has no valid width and height.");
  const int components = encoded[frame.payload + 5];
  if (components != 1 && components != 3) {
    return unsupportedImage("The JPEG is neither grey nor RGB; CMYK is not read.");
  }
  return ImageSize{width, height};
}

bool isEssential(std::uint8_t marker) {
  if (marker == kJfif || marker == kAdobe) return true;
  return !(marker > kJfif && marker <= kApplicationLast) && marker != kComment;
}

} // namespace

Result<ImageSize> jpegSize(EncodedBytes encoded) {
  std::size_t position = 2;
  while (const std::optional<Segment> segment = segmentAt(encoded, position)) {
    if (isFrameHeader(segment->marker)) return sizeFromFrame(encoded, *segment);
    if (segment->marker == kStartOfScan || segment->marker == kEndOfImage) break;
    position = segment->end;
  }
  return malformedImage("The JPEG has no frame header before its data.");
}

Result<EssentialImage> essentialJpeg(EncodedBytes encoded) {
  Bytes essential(encoded.begin(), encoded.begin() + 2);
  std::size_t position = 2;
  int scans = 0;
  while (const std::optional<Segment> segment = segmentAt(encoded, position)) {
    const bool scan = segment->marker == kStartOfScan;
    if (scan && ++scans > kMaxScans) {
      return Problem{ProblemCode::tooLarge, "", "The JPEG has too many scans.", "1.." + std::to_string(kMaxScans),
                     "more"};
    }
    const std::size_t end = scan ? endOfScan(encoded, segment->end) : segment->end;
    if (isEssential(segment->marker)) {
      essential.insert(essential.end(), encoded.begin() + segment->begin, encoded.begin() + end);
    }
    if (segment->marker == kEndOfImage) return EssentialImage{std::move(essential)};
    position = end;
  }
  if (scans == 0) return malformedImage("The JPEG ends before its pixels.");
  return EssentialImage{std::move(essential), true};
}

} // namespace gnomon
