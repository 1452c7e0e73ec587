#include "renderer/image/decoded_rows.h"

#include <algorithm>

namespace gnomon {

DecodedRows::DecodedRows(const ImageSize& size, std::uint8_t* rgba) : size_(size), rgba_(rgba), held_(size.height) {}

DecodedRows::DecodedRows(const ImageSize& size, int atOnce, const TakeRows& take) : size_(size), take_(take) {
  holdRows(std::min(atOnce, size.height));
}

void DecodedRows::holdRows(int rows) {
  buffer_.resize(rowBytes() * static_cast<std::size_t>(rows));
  rgba_ = buffer_.data();
  held_ = rows;
}

std::uint8_t* DecodedRows::all() {
  if (held_ < size_.height) holdRows(size_.height);
  return rgba_;
}

void DecodedRows::complete(int end) {
  if (!take_ || (end < first_ + held_ && end < size_.height)) return;
  take_(first_, {rgba_, rowBytes() * static_cast<std::size_t>(end - first_)});
  first_ = end;
}

} // namespace gnomon
