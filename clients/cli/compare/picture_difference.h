#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "renderer/render.h"

/// How far two pictures are apart.
namespace gnomon::cli {

/// The difference of a pixel is the largest of its channels: of 8 bits R, G, B and A a share of the whole range, 0..1;
/// of floats what the numbers differ by. Equal infinities, and NaN and NaN, do not differ; a number and none do
/// infinitely.
struct PictureDifference {
  double largest = 0;
  double mean = 0;         ///< over all pixels
  std::int64_t pixels = 0; ///< of a picture
  std::int64_t beyond = 0; ///< pixels whose difference is more than the threshold
  int worstX = 0;          ///< the pixel with the largest difference, the first of several
  int worstY = 0;
};

/// A PNG, JPEG or WebP as one layer without a name, of 8 bits of R, G, B and A; an EXR as its layers, of floats;
/// those without a name are called color, as the view that a frame's file has there.
/// `name`: for problems.
Result<std::vector<ExrLayer>> decodePicture(std::span<const std::uint8_t> file, const std::string& name);

/// Two layers to be compared, by their place in their pictures.
struct LayerPair {
  std::size_t first = 0, second = 0;
};

/// Which layers of two pictures are compared: those asked for as "NAME", or "NAME=OTHER" where the second picture's has
/// another name; without any, the only ones, or each by its name. Problems: a layer that there is not, or that only
/// one of the pictures has.
Result<std::vector<LayerPair>> layerPairs(std::span<const ExrLayer> first, std::span<const ExrLayer> second,
                                          std::span<const std::string> asked);

/// Problems: sizes or channels that differ, and floats against 8 bits.
Result<PictureDifference> differenceOf(const Image& a, const Image& b, double threshold);

/// A PNG that shows where they differ: black where they don't, ever lighter up to the largest finite difference, and
/// red where it is more than the threshold. REQUIRES: pictures that differenceOf takes.
Result<Bytes> differencePicture(const Image& a, const Image& b, double threshold);

/// "largest 0.0118 at 12,7, mean 0.000304, beyond 0.01: 12 of 3072 pixels".
std::string differenceText(const PictureDifference& difference, double threshold);

} // namespace gnomon::cli
