#include <bit>
#include <cmath>

#include "renderer/video/video_file.h"

namespace gnomon {
namespace {

// EBML (RFC 8794): an element is its id, the size of what it holds, and that.

void putBytes(std::string& text, std::uint64_t value, int bytes) {
  while (bytes-- > 0) text += static_cast<char>(value >> (8 * bytes) & 0xff);
}

/// An id has its own length in its first bits.
void putId(std::string& text, std::uint32_t id) {
  putBytes(text, id, id > 0xffffff ? 4 : id > 0xffff ? 3 : id > 0xff ? 2 : 1);
}

/// As short as it can be: the first set bit says how many bytes there are, of 7 bits each. All bits set = unknown.
void putSize(std::string& text, std::uint64_t size) {
  int bytes = 1;
  while (size >= (1ull << (7 * bytes)) - 1) ++bytes;
  putBytes(text, size | 1ull << (7 * bytes), bytes);
}

std::string element(std::uint32_t id, std::string_view content) {
  std::string text;
  putId(text, id);
  putSize(text, content.size());
  return text.append(content);
}

std::string number(std::uint32_t id, std::uint64_t value) {
  std::string content;
  putBytes(content, value, value > 0xffffffff ? 8 : value > 0xffff ? 4 : value > 0xff ? 2 : 1);
  return element(id, content);
}

std::string real(std::uint32_t id, double value) {
  std::string content;
  putBytes(content, std::bit_cast<std::uint64_t>(value), 8);
  return element(id, content);
}

constexpr double kTicksPerSecond = 1'000; ///< as WebM recommends

std::string info(const VideoTrack& track) {
  const double seconds = track.frames / track.framesPerSecond;
  return element(0x1549a966, number(0x2ad7b1, 1'000'000) +                 // TimestampScale: nanoseconds of a tick
                                 real(0x4489, seconds * kTicksPerSecond) + // Duration
                                 element(0x4d80, "Gnomon") +               // MuxingApp
                                 element(0x5741, "Gnomon"));               // WritingApp
}

/// Code points of ISO/IEC 23091-2.
std::string colour() {
  return element(0x55b0, number(0x55b1, 1) +      // MatrixCoefficients: BT.709
                             number(0x55b2, 8) +  // BitsPerChannel
                             number(0x55b3, 1) +  // ChromaSubsamplingHorz
                             number(0x55b4, 1) +  // ChromaSubsamplingVert
                             number(0x55b7, 2) +  // ChromaSitingHorz: between the pixels
                             number(0x55b8, 2) +  // ChromaSitingVert
                             number(0x55b9, 1) +  // Range: 16..235
                             number(0x55ba, 13) + // TransferCharacteristics: sRGB
                             number(0x55bb, 1));  // Primaries: BT.709
}

std::string tracks(const VideoTrack& track) {
  const auto width = static_cast<std::uint64_t>(track.width);
  const auto height = static_cast<std::uint64_t>(track.height);
  const auto nanoseconds = static_cast<std::uint64_t>(std::llround(1e9 / track.framesPerSecond));
  const std::string video = element(0xe0, number(0xb0, width) + number(0xba, height) + // PixelWidth, PixelHeight
                                              number(0x9a, 2) + colour());             // FlagInterlaced: no
  return element(0x1654ae6b, element(0xae, number(0xd7, 1) +                           // TrackNumber
                                               number(0x73c5, 1) +                     // TrackUID
                                               number(0x83, 1) +                       // TrackType: video
                                               number(0x9c, 0) +                       // FlagLacing
                                               number(0x23e383, nanoseconds) +         // DefaultDuration
                                               element(0x86, "V_VP9") +                // CodecID
                                               video));
}

} // namespace

std::string webmHead(const VideoTrack& track) {
  std::string head =
      element(0x1a45dfa3, number(0x4286, 1) + number(0x42f7, 1) +     // EBMLVersion, EBMLReadVersion
                              number(0x42f2, 4) + number(0x42f3, 8) + // EBMLMaxIDLength, EBMLMaxSizeLength
                              element(0x4282, "webm") +               // DocType
                              number(0x4287, 4) + number(0x4285, 2)); // DocTypeVersion, DocTypeReadVersion
  putId(head, 0x18538067);                                            // Segment
  putBytes(head, 0x01ffffffffffffff, 8);
  return head + info(track) + tracks(track);
}

std::string webmFrame(const VideoTrack& track, int index, std::string_view vp9, bool isKey) {
  const auto ticks = static_cast<std::uint64_t>(std::llround(index * kTicksPerSecond / track.framesPerSecond));
  std::string block;
  block.reserve(vp9.size() + 4);
  block += '\x81';                  // track 1
  putBytes(block, 0, 2);            // ticks behind the cluster's
  block += isKey ? '\x80' : '\x00'; // flags
  block += vp9;
  return element(0x1f43b675, number(0xe7, ticks) + element(0xa3, block)); // Cluster: Timestamp, SimpleBlock
}

std::string webmTag(std::string_view name, std::string_view text) {
  const std::string tag =
      element(0x67c8, element(0x45a3, name) + element(0x4487, text)); // SimpleTag: TagName, TagString
  return element(0x1254c367, element(0x7373, element(0x63c0, number(0x68ca, 50)) + tag)); // Tags, Tag, Targets
}

} // namespace gnomon
