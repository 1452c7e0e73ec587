#include "renderer/cpu/surface/texture.h"

#include <algorithm>
#include <new>
#include <utility>

#include "renderer/cpu/surface/halved_rows.h"

namespace gnomon::cpu {

Texture::Texture(std::shared_ptr<const SceneImage> image, bool srgb)
    : image_(std::move(image)),
      srgb_(srgb),
      width_(image_->width()),
      height_(image_->height()),
      levels_(levelsOf(width_, height_)) {}

Result<Pyramid> Texture::pyramidFrom(std::size_t finest, const Pyramid& known) const {
  if (finest == 0) { // the largest level is the image itself, which is kept for it
    if (Status decoded = image_->decode(); !decoded) return decoded.problems();
    return pyramidOf(image_->pixels(), srgb_, 0, known);
  }
  const ImageSize size{width_, height_};
  HalvedRows halved(size, srgb_, std::min(finest, evenLevels(size)));
  const auto take = [&](int first, std::span<const std::uint8_t> rgba) { halved.add(first, rgba); };
  if (Status read = image_->readRows(halved.atOnce(), take); !read) return read.problems();
  return pyramidOf(size, srgb_, std::move(halved).given(), finest, known);
}

Status Texture::make(std::size_t finest) const {
  const std::lock_guard lock(making_);
  static const Pyramid kNone;
  const Pyramid& known = made_.empty() ? kNone : *made_.back();
  if (!made_.empty() && known.finest <= finest) return Done{};
  auto pyramid = pyramidFrom(finest, known);
  if (!pyramid) return std::move(pyramid).problems();
  made_.push_back(std::make_unique<const Pyramid>(*std::move(pyramid)));
  const Pyramid& made = *made_.back();
  std::size_t bytes = 0;
  for (const auto& texels : made.owned) bytes += texels ? texels->size() * sizeof(texels->front()) : 0;
  bytes_.store(bytes, std::memory_order_relaxed);
  latest_.store(&made, std::memory_order_release);
  return Done{};
}

const Pyramid& Texture::madeFrom(std::size_t finest) const {
  if (!make(finest)) throw std::bad_alloc(); // it was decoded before
  return *latest();
}

} // namespace gnomon::cpu
