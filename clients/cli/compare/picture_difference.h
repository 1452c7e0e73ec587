#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/render.h"

/// How far two pictures are apart.
namespace gnomon::cli {

/// The difference of a pixel is the largest of its channels R, G, B and A, as a share of the whole range: 0..1.
struct PictureDifference {
  double largest = 0;
  double mean = 0;         ///< over all pixels
  std::int64_t pixels = 0; ///< of a picture
  std::int64_t beyond = 0; ///< pixels whose difference is more than the threshold
  int worstX = 0;          ///< the pixel with the largest difference, the first of several
  int worstY = 0;
};

/// A PNG, JPEG or WebP as 8 bits of R, G, B and A. `name`: for problems.
Result<Image> decodePicture(std::span<const std::uint8_t> file, const std::string& name);

/// Of two pictures as decodePicture gives them. Problems: sizes that differ.
Result<PictureDifference> differenceOf(const Image& a, const Image& b, double threshold);

/// A PNG that shows where they differ: black where they don't, ever lighter up to the largest difference, and red where
/// it is more than the threshold. REQUIRES: pictures of one size.
Result<Bytes> differencePicture(const Image& a, const Image& b, double threshold);

/// "largest 0.0118 at 12,7, mean 0.000304, beyond 0.01: 12 of 3072 pixels".
std::string differenceText(const PictureDifference& difference, double threshold);

} // namespace gnomon::cli
