#pragma once

#include <gtest/gtest.h>

#include "renderer/image/image_codec.h"

namespace gnomon {

/// The pixels as decodeRows() gives them, which must come in order, in steps of `atOnce` or all in one.
inline Bytes rowsOf(const Bytes& file, int atOnce) {
  const auto checked = checkImage(file, 512, 512 * 512);
  EXPECT_TRUE(checked);
  if (!checked) return {};
  const std::size_t row = 4 * static_cast<std::size_t>(checked->size.width);
  Bytes pixels;
  const std::string wrong = decodeRows(*checked, atOnce, [&](int first, std::span<const std::uint8_t> rgba) {
    EXPECT_EQ(static_cast<std::size_t>(first) * row, pixels.size());
    EXPECT_EQ(first % atOnce, 0);
    pixels.insert(pixels.end(), rgba.begin(), rgba.end());
  });
  EXPECT_EQ(wrong, "");
  return pixels;
}

} // namespace gnomon
