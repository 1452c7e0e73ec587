#include "renderer/image/deflate_stripe.h"

#include <algorithm>
#include <array>
#include <isa-l/igzip_lib.h>
#include <libdeflate.h>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <zlib.h>

#include "renderer/core/vectors.h"

namespace gnomon {
namespace {

using Data = std::span<const std::uint8_t>;

constexpr std::size_t kMaxStored = 0xffff;                     ///< bytes of a stored block
constexpr std::size_t kStoredHeader = 5;                       ///< of a stored block that begins on a byte
constexpr std::size_t kSlack = 1024;                           ///< more than the headers of a few blocks
constexpr int kFirstOfLibdeflate = 3;                          ///< level
constexpr std::array kLibdeflateLevels{1, 2, 4, 6, 7, 10, 12}; ///< of our levels 3..9

std::size_t storedSize(std::size_t size) {
  return size + (size + kMaxStored - 1) / kMaxStored * kStoredHeader;
}

Bytes stored(Data data) {
  Bytes blocks;
  blocks.reserve(storedSize(data.size()));
  while (!data.empty()) {
    const auto length = static_cast<std::uint16_t>(std::min(data.size(), kMaxStored));
    const auto low = [](unsigned value) { return static_cast<std::uint8_t>(value & 0xff); };
    const std::array<std::uint8_t, kStoredHeader> header{0, low(length), low(length >> 8u), low(~length),
                                                         low(~length >> 8u)};
    blocks.insert(blocks.end(), header.begin(), header.end());
    blocks.insert(blocks.end(), data.begin(), data.begin() + length);
    data = data.subspan(length);
  }
  return blocks;
}

/// Empty where it does not fit into `room`. The first byte is stored and is the dictionary of the rest: without one
/// ISA-L 2.30 enters the stream's own address into its table (level 1 on x86: `write_first_byte`). Level 3 is not used:
/// its bytes differ between SSE 4.2, AVX2 and AVX-512.
Bytes byIsal(Data data, int level, std::size_t room) {
  static_assert(ISAL_DEF_LVL1_SMALL > ISAL_DEF_LVL0_SMALL);
  constexpr std::size_t kMost = std::numeric_limits<std::uint32_t>::max() - kSlack;
  constexpr std::size_t kStored = 1;
  if (data.size() <= kStored || data.size() > kMost) return {};
  const Data rest = data.subspan(kStored);
  Bytes blocks = stored(data.first(kStored));
  UnfilledVector<std::uint8_t> more(std::min(room, kMost) - blocks.size());
  // Zeroed: ISA-L reads members that its init leaves alone, hist_bits among them.
  const auto tokens = std::make_unique<std::uint8_t[]>(ISAL_DEF_LVL1_SMALL);
  const auto stream = std::make_unique<isal_zstream>();
  isal_deflate_init(stream.get());
  stream->level = static_cast<std::uint32_t>(level);
  stream->level_buf = tokens.get();
  stream->level_buf_size = level == 0 ? ISAL_DEF_LVL0_SMALL : ISAL_DEF_LVL1_SMALL;
  stream->flush = FULL_FLUSH;
  stream->end_of_stream = 0;
  // ISA-L only reads dictionary and input.
  if (isal_deflate_set_dict(stream.get(), const_cast<std::uint8_t*>(data.data()), kStored) != COMP_OK) return {};
  stream->next_in = const_cast<std::uint8_t*>(rest.data());
  stream->avail_in = static_cast<std::uint32_t>(rest.size());
  stream->next_out = more.data();
  stream->avail_out = static_cast<std::uint32_t>(more.size());
  if (isal_deflate(stream.get()) != COMP_OK || stream->avail_in != 0 || stream->avail_out == 0) return {};
  blocks.insert(blocks.end(), more.begin(), more.begin() + stream->total_out);
  return blocks;
}

/// Where the last block of a deflate stream begins and ends, in bits from its first.
struct LastBlock {
  std::size_t begin = 0;
  std::size_t end = 0;
};

/// zlib stops at each block's end and says at which bit; `size` bytes are in the stream. Empty = no such stream.
std::optional<LastBlock> lastBlockOf(Data stream, std::size_t size) {
  z_stream zlib{};
  if (inflateInit2(&zlib, -MAX_WBITS) != Z_OK) return std::nullopt;
  const std::unique_ptr<z_stream, int (*)(z_stream*)> ending(&zlib, inflateEnd);
  const auto data = std::make_unique_for_overwrite<std::uint8_t[]>(size);
  zlib.next_in = const_cast<std::uint8_t*>(stream.data());
  zlib.avail_in = static_cast<uInt>(stream.size());
  zlib.next_out = data.get();
  zlib.avail_out = static_cast<uInt>(size);
  LastBlock last;
  while (inflate(&zlib, Z_BLOCK) == Z_OK) {
    if ((zlib.data_type & 128) == 0) continue; // not at the end of a block
    last.begin = last.end;
    last.end = std::size_t{zlib.total_in} * 8 - static_cast<std::size_t>(zlib.data_type & 7);
    if (zlib.data_type & 64) return last;
  }
  return std::nullopt;
}

/// libdeflate writes whole streams: the last block is made one like the others, and an empty stored block reaches to
/// the next byte. Empty where the stream does not fit into `room`.
Bytes byLibdeflate(Data data, int level, std::size_t room) {
  const std::unique_ptr<libdeflate_compressor, void (*)(libdeflate_compressor*)> compressor(
      libdeflate_alloc_compressor(level), libdeflate_free_compressor);
  if (!compressor) throw std::bad_alloc();
  Bytes blocks(room);
  blocks.resize(libdeflate_deflate_compress(compressor.get(), data.data(), data.size(), blocks.data(), blocks.size()));
  const auto last = blocks.empty() ? std::nullopt : lastBlockOf(blocks, data.size());
  if (!last) return {};
  blocks[last->begin / 8] &= static_cast<std::uint8_t>(~(1u << last->begin % 8)); // BFINAL
  constexpr std::size_t kBlockHeader = 3;                                         // bits: not the last, stored
  blocks.resize((last->end + kBlockHeader + 7) / 8, 0);
  blocks.insert(blocks.end(), {0x00, 0x00, 0xff, 0xff});
  return blocks;
}

} // namespace

Bytes deflateStripe(std::span<const std::uint8_t> data, int level) {
  if (level <= 0) return stored(data);
  const std::size_t room = storedSize(data.size()) + kSlack;
  Bytes blocks =
      level < kFirstOfLibdeflate
          ? byIsal(data, level - 1, room)
          : byLibdeflate(data, kLibdeflateLevels[static_cast<std::size_t>(level - kFirstOfLibdeflate)], room);
  return blocks.empty() || blocks.size() > storedSize(data.size()) ? stored(data) : blocks;
}

} // namespace gnomon
