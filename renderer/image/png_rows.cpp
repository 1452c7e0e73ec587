#include "renderer/image/png_rows.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <isa-l/igzip_lib.h>
#include <type_traits>

namespace gnomon {
namespace {

constexpr std::size_t kHeldBytes = 1 << 16; ///< inflated at a time, about

/// The spec's section 9.4.
inline int paeth(int a, int b, int c) {
  const int toA = std::abs(b - c), toB = std::abs(a - c), toC = std::abs(a + b - 2 * c);
  if (toA <= toB && toA <= toC) return a;
  return toB <= toC ? b : c;
}

/// `step`: bytes from a pixel to the next.
template <class Step>
void undoFilter(int filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, Step step) {
  const std::size_t first = std::min<std::size_t>(step, bytes);
  switch (filter) {
    case 1:
      for (std::size_t i = step; i < bytes; ++i) row[i] = static_cast<std::uint8_t>(row[i] + row[i - step]);
      break;
    case 2:
      for (std::size_t i = 0; i < bytes; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      break;
    case 3:
      for (std::size_t i = 0; i < first; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i] / 2);
      for (std::size_t i = step; i < bytes; ++i) {
        row[i] = static_cast<std::uint8_t>(row[i] + (row[i - step] + above[i]) / 2);
      }
      break;
    case 4:
      for (std::size_t i = 0; i < first; ++i) row[i] = static_cast<std::uint8_t>(row[i] + above[i]);
      for (std::size_t i = step; i < bytes; ++i) {
        row[i] = static_cast<std::uint8_t>(row[i] + paeth(row[i - step], above[i], above[i - step]));
      }
      break;
    default:
      break;
  }
}

template <std::size_t bytes>
using Constant = std::integral_constant<std::size_t, bytes>;

void undo(int filter, std::uint8_t* row, const std::uint8_t* above, std::size_t bytes, std::size_t pixelBytes) {
  if (pixelBytes == 4) return undoFilter(filter, row, above, bytes, Constant<4>());
  if (pixelBytes == 3) return undoFilter(filter, row, above, bytes, Constant<3>());
  undoFilter(filter, row, above, bytes, pixelBytes);
}

/// Samples of a row as they are stored.
class Samples {
 public:
  Samples(const std::uint8_t* row, int bitDepth) : row_(row), depth_(static_cast<std::size_t>(bitDepth)) {}

  std::uint32_t raw(std::size_t i) const {
    if (depth_ == 8) return row_[i];
    if (depth_ == 16) return static_cast<std::uint32_t>(row_[2 * i] << 8 | row_[2 * i + 1]);
    const std::size_t bit = i * depth_;
    return static_cast<std::uint32_t>(row_[bit / 8] >> (8 - depth_ - bit % 8)) & ((1u << depth_) - 1);
  }
  /// The nearest of 0..255.
  std::uint8_t byte(std::size_t i) const {
    const std::uint32_t value = raw(i), most = (1u << depth_) - 1;
    return static_cast<std::uint8_t>(depth_ == 8 ? value : (value * 255 + most / 2) / most);
  }

 private:
  const std::uint8_t* row_;
  std::size_t depth_;
};

} // namespace

InflatedRows::InflatedRows(std::span<const EncodedBytes> compressed)
    : parts_(compressed), state_(std::make_unique<inflate_state>()) {
  isal_inflate_init(state_.get());
  state_->crc_flag = ISAL_ZLIB;
}

InflatedRows::~InflatedRows() = default;

void InflatedRows::begin(std::size_t rowBytes, std::size_t pixelBytes, std::size_t rows) {
  rowBytes_ = rowBytes;
  pixelBytes_ = pixelBytes;
  left_ = rows;
  above_.assign(rowBytes, 0);
  held_ = at_ = 0;
  rows_.resize(std::min(std::max<std::size_t>(kHeldBytes / (rowBytes + 1), 1), rows) * (rowBytes + 1));
}

const std::uint8_t* InflatedRows::next() {
  if (at_ == held_) {
    if (!wrong_.empty()) return nullptr;
    held_ = std::min(left_, rows_.size() / (rowBytes_ + 1));
    at_ = 0;
    held_ = inflate(rows_.data(), held_ * (rowBytes_ + 1)) / (rowBytes_ + 1);
    if (held_ == 0) return nullptr;
    left_ -= held_;
  }
  std::uint8_t* row = &rows_[at_ * (rowBytes_ + 1)];
  if (*row > 4) {
    wrong_ = "a row has a filter that PNG does not have";
    at_ = held_;
    return nullptr;
  }
  const std::uint8_t* above = at_ == 0 ? above_.data() : row - rowBytes_;
  undo(*row, row + 1, above, rowBytes_, pixelBytes_);
  if (++at_ == held_) std::copy_n(row + 1, rowBytes_, above_.begin());
  return row + 1;
}

std::size_t InflatedRows::inflate(std::uint8_t* to, std::size_t bytes) {
  state_->next_out = to;
  state_->avail_out = static_cast<std::uint32_t>(bytes);
  while (state_->avail_out > 0) {
    if (state_->avail_in == 0 && !parts_.empty()) {
      state_->next_in = const_cast<std::uint8_t*>(parts_.front().data());
      state_->avail_in = static_cast<std::uint32_t>(parts_.front().size());
      parts_ = parts_.subspan(1);
    }
    const std::uint32_t before = state_->avail_out;
    const bool more = state_->avail_in > 0;
    if (isal_inflate(state_.get()) != ISAL_DECOMP_OK) {
      wrong_ = "its compressed data are broken";
      break;
    }
    const bool ended = state_->block_state == ISAL_BLOCK_FINISH || (!more && parts_.empty());
    if (ended && state_->avail_out == before) {
      wrong_ = "it has too few pixels";
      break;
    }
  }
  return bytes - state_->avail_out;
}

void expandRow(const PngPixels& pixels, const std::uint8_t* row, std::size_t count, std::uint8_t* rgba) {
  if (pixels.colorType == 6 && pixels.bitDepth == 8) {
    std::memcpy(rgba, row, 4 * count);
    return;
  }
  if (pixels.colorType == 2 && pixels.bitDepth == 8 && !pixels.transparent) {
    for (std::size_t i = 0; i < count; ++i) {
      std::memcpy(rgba + 4 * i, row + 3 * i, 3);
      rgba[4 * i + 3] = 255;
    }
    return;
  }
  const Samples samples(row, pixels.bitDepth);
  if (pixels.colorType == 3) {
    for (std::size_t i = 0; i < count; ++i) std::memcpy(rgba + 4 * i, pixels.palette[samples.raw(i)].data(), 4);
    return;
  }
  const std::size_t colors = pixels.colorType == 2 || pixels.colorType == 6 ? 3 : 1;
  const std::size_t channels = colors + (pixels.colorType >= 4 ? 1 : 0);
  for (std::size_t i = 0; i < count; ++i) {
    std::uint8_t* to = rgba + 4 * i;
    bool hidden = pixels.transparent.has_value();
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t sample = i * channels + (colors == 3 ? c : 0);
      to[c] = samples.byte(sample);
      if (hidden) hidden = samples.raw(sample) == (*pixels.transparent)[colors == 3 ? c : 0];
    }
    to[3] = channels > colors ? samples.byte(i * channels + colors) : hidden ? 0 : 255;
  }
}

} // namespace gnomon
