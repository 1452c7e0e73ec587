#include "renderer/cpu/surface/texture.h"

#include <new>
#include <utility>

namespace gnomon::cpu {

Texture::Texture(std::shared_ptr<const SceneImage> image, bool srgb)
    : image_(std::move(image)),
      srgb_(srgb),
      width_(image_->width()),
      height_(image_->height()),
      levels_(levelsOf(width_, height_)) {}

Status Texture::make(std::size_t finest, Cores cores) const {
  const std::lock_guard lock(making_);
  static const Pyramid kNone;
  const Pyramid& known = made_.empty() ? kNone : *made_.back();
  if (!made_.empty() && known.finest <= finest) return Done{};
  // The largest level is the image itself, which is kept for it.
  if (finest == 0) {
    if (Status decoded = image_->decode(); !decoded) return decoded;
  }
  const auto pixels = image_->read();
  if (!pixels) return pixels.problems();
  made_.push_back(std::make_unique<const Pyramid>(pyramidOf(**pixels, srgb_, finest, known, cores)));
  const Pyramid& made = *made_.back();
  std::size_t bytes = 0;
  for (const auto& texels : made.owned) bytes += texels ? texels->size() * sizeof(texels->front()) : 0;
  bytes_.store(bytes, std::memory_order_relaxed);
  latest_.store(&made, std::memory_order_release);
  return Done{};
}

const Pyramid& Texture::madeFrom(std::size_t finest) const {
  if (!make(finest, Cores::one)) throw std::bad_alloc(); // it was decoded before
  return *latest();
}

} // namespace gnomon::cpu
