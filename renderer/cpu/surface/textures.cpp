#include "renderer/cpu/surface/textures.h"

#include <algorithm>
#include <iterator>
#include <new>
#include <numeric>
#include <system_error>
#include <utility>

#include "renderer/core/parallel.h"
#include "renderer/core/stop.h"

namespace gnomon::cpu {
namespace {

std::vector<ReadTexture> missing(const Textures& textures, std::span<const ReadTexture> wanted) {
  std::vector<ReadTexture> missing;
  std::copy_if(wanted.begin(), wanted.end(), std::back_inserter(missing),
               [&](const ReadTexture& each) { return !textures.of(each.texture).has(each.finest); });
  return missing;
}

Status makeAll(const Textures& textures, std::span<const ReadTexture> wanted) {
  return forEachOrProblems(wanted.size(),
                           [&](std::size_t i) { return textures.of(wanted[i].texture).make(wanted[i].finest); });
}

} // namespace

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

Textures::Textures(const SceneImages& images) {
  for (const auto& image : images) {
    textures_.emplace_back(image, false);
    textures_.emplace_back(image, true);
  }
}

bool Textures::areMade(std::span<const TextureImage> wanted) const {
  return std::all_of(wanted.begin(), wanted.end(), [&](const TextureImage& each) { return of(each).isMade(); });
}

std::future<void> Textures::makeAhead(std::span<const ReadTexture> wanted) const {
  std::vector<ReadTexture> lacking = missing(*this, wanted);
  if (lacking.empty()) return {};
  try {
    return std::async(std::launch::async, [this, lacking = std::move(lacking), stop = Stop::current()] {
      const CancellationScope scope(stop);
      (void)untilStopped({}, [&] { return makeAll(*this, lacking); }); // need() reports what is broken
    });
  } catch (const std::system_error&) { // no thread to be had: need() does it all
    return {};
  }
}

Status Textures::need(std::span<const ReadTexture> wanted) const {
  return makeAll(*this, missing(*this, wanted));
}

std::size_t Textures::bytes() const {
  return std::accumulate(textures_.begin(), textures_.end(), std::size_t{0},
                         [](std::size_t sum, const Texture& each) { return sum + each.bytes(); });
}

} // namespace gnomon::cpu
