#include "renderer/cpu/surface/textures.h"

#include <algorithm>
#include <iterator>
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
      (void)untilStopped({}, [&] { return makeAll(*this, lacking); }); // need() tells what is broken
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
