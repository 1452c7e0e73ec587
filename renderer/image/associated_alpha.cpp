#include "renderer/image/associated_alpha.h"

namespace gnomon {

bool hasAlpha(const Image& image) {
  return image.channels.size() > 1 && image.channels.back() == "A";
}

std::vector<float> associated(const Image& image) {
  std::vector<float> pixels = std::get<std::vector<float>>(image.pixels);
  const std::size_t channels = image.channels.size();
  for (std::size_t pixel = 0; pixel < pixels.size(); pixel += channels) {
    for (std::size_t c = 0; c + 1 < channels; ++c) pixels[pixel + c] *= pixels[pixel + channels - 1];
  }
  return pixels;
}

} // namespace gnomon
