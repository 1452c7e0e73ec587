// PNG, JPEG and WebP as they come in a model: what their headers claim, their parts, their pixels.
#include "renderer/image/image_codec.h"
#include "renderer/image/image_container.h"
#include "tests/fuzz/sound_problems.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  constexpr int kSide = 256;
  const std::span<const std::uint8_t> encoded(data, size);
  const auto claimed = imageSize(encoded);
  if (!claimed) fuzz::requireSound(claimed.problems());
  const auto image = decodeImage(encoded, kSide, kSide * kSide);
  if (!image) {
    fuzz::requireSound(image.problems());
    return 0;
  }
  fuzz::require(claimed && claimed->width == image->width && claimed->height == image->height,
                "the size that was told");
  fuzz::require(image->width <= kSide && image->height <= kSide, "no larger than the limit");
  const auto* pixels = std::get_if<std::vector<std::uint8_t>>(&image->pixels);
  fuzz::require(pixels && pixels->size() == static_cast<std::size_t>(image->width) * image->height * 4, "all pixels");
  return 0;
}
