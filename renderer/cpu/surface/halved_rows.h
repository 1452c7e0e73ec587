#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "renderer/cpu/surface/pyramid.h"

namespace gnomon::cpu {

/// A small level of an image whose rows come from the top down, so that the image itself never is in memory. The same
/// texels as pyramidOf() makes of the whole image.
class HalvedRows {
 public:
  /// `level`: no larger than evenLevels() of the image.
  HalvedRows(const ImageSize& size, bool srgb, std::size_t level);

  /// How many rows are best added at a time: a multiple of DecodedRows::kStep and of what a row of the level is made
  /// from.
  int atOnce() const { return atOnce_; }
  /// Rows of 8-bit RGBA from row `first` on; a multiple of atOnce(), or up to the last one.
  void add(int first, std::span<const std::uint8_t> rgba);

  /// Once all rows are there.
  GivenLevel given() && { return {level_, texels_->data(), std::move(texels_)}; }

 private:
  void addFew(std::size_t first, const std::uint32_t* texels, std::size_t rows);

  std::size_t width_;
  bool srgb_;
  std::size_t level_;
  int atOnce_;
  std::shared_ptr<Pyramid::Texels> texels_;
  std::vector<Pyramid::Texels> between_; ///< of the levels on the way, for atOnce() rows
};

/// How often both sides of an image can be halved before one is odd.
std::size_t evenLevels(const ImageSize& size);

} // namespace gnomon::cpu
