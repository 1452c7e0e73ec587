#pragma once

#include <cstdint>
#include <span>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Compresses `data` on its own: whole deflate blocks (RFC 1951) that end on a byte, none of them the last of a stream
/// and none referring to what came before. So the results for the pieces of some data, in order, are a stream of all of
/// it that lacks its end, `kDeflateEnd`, and the pieces may be compressed in any order and on any thread. `level` 0..9:
/// 0 stores; 1 and 2 are ISA-L's, made for speed; 3 to 9 are libdeflate's, ever smaller and slower. The bytes depend on
/// the arguments, the two libraries, and whether the CPU knows SSE 4.2 (levels 1 and 2); they are the same with AVX2
/// and AVX-512.
Bytes deflateStripe(std::span<const std::uint8_t> data, int level);

/// The last block of a stream, with nothing in it.
inline constexpr std::uint8_t kDeflateEnd[]{0x03, 0x00};

} // namespace gnomon
