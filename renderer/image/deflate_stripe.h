#pragma once

#include <cstdint>
#include <span>

#include "protocol/base/bytes.h"

namespace gnomon {

/// Compresses `data` on its own to whole deflate blocks (RFC 1951) that end on a byte, none of them the last; the
/// results for the pieces of some data, in order, and kDeflateEnd are a stream. `level` 0..9: 0 stores; 1 and 2 are
/// ISA-L's; 3 to 9 libdeflate's. The bytes depend on the arguments, the libraries and, at levels 1 and 2, on SSE 4.2.
Bytes deflateStripe(std::span<const std::uint8_t> data, int level);

/// The last block of a stream, with nothing in it.
inline constexpr std::uint8_t kDeflateEnd[]{0x03, 0x00};

} // namespace gnomon
