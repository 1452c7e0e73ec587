#include "renderer/techniques/traced_shadow.h"

#include <algorithm>
#include <atomic>

#include "protocol/spec/traits.h"
#include "renderer/core/parallel.h"
#include "renderer/techniques/neighbours.h"
#include "renderer/techniques/picture_shares.h"

namespace gnomon {
namespace {

constexpr int kLeastHeight = 8; ///< of blocks that are asked for as a whole

/// Shares of a soft shadow that differ by less lie within a penumbra some pixels wide.
constexpr std::uint8_t kSoftEdge = 128;

/// What the triangles that a few pixels side by side show see of a light, where one answer holds for all of a triangle.
class TrianglesAcross {
 public:
  TrianglesAcross(const PicturePoints& points, const TracedLight& light) : points_(points), light_(light) {
    numbers_.fill(kNoNumber);
  }

  /// REQUIRES: the number of a triangle that is shown.
  LightAcross of(std::uint32_t number) {
    if (!light_.knowsTriangles()) return LightAcross::unsure;
    const std::size_t at = number % kRemembered;
    if (numbers_[at] != number) {
      numbers_[at] = number;
      across_[at] = light_.across(points_.placed(number));
    }
    return across_[at];
  }

 private:
  static constexpr std::size_t kRemembered = 8;

  const PicturePoints& points_;
  const TracedLight& light_;
  std::array<std::uint32_t, kRemembered> numbers_; ///< by their last bits
  std::array<LightAcross, kRemembered> across_;
};

/// One light's shadow over the picture while rays complete it.
class ShadowTracing {
 public:
  ShadowTracing(const PicturePoints& points, const TraceInput& rays, int light, int samples)
      : points_(points),
        light_(rays, light, std::max(samples, static_cast<int>(points.grid().samples()))),
        samples_(samples),
        places_(grid().samples()),
        known_(grid()) {}

  /// Sends rays from the points as they were drawn, but from blocks that are lit or turned away as a whole. Gives how
  /// many pixels rays were sent from.
  std::uint64_t traceDrawn() {
    std::atomic<std::uint64_t> traced = 0;
    forEachBlock(grid(), [&](const Rect& block) { traced += traceBlock(block); });
    return traced;
  }

  /// Finds out where camera rays lead, and gives the pixels that other shares came of.
  Pixels traceExactly(const Pixels& pixels) {
    return isSoft() ? traceDoubtful(points_, light_, samplesOfPoint(), pixels, known_)
                    : gnomon::traceExactly(points_, light_, pixels, known_);
  }

  /// The same at edges. Towards a light that has a size the points as they were drawn suffice.
  Pixels traceEdges(const Pixels& pixels) {
    return isSoft() ? traceSamples(points_, light_, samplesOfPoint(), pixels, known_) : traceExactly(pixels);
  }

  /// The pixels next to masks, and to both sides of where surfaces that are turned away end. REQUIRES: no point is
  /// exact yet.
  Pixels doubtful() {
    return either(
        known_, points_.besideMasks(),
        pixelsWhere(grid(), known_.marks, [](std::uint8_t least, std::uint8_t most) { return least != most; }));
  }

  /// Sends the other rays to a light that has a size. REQUIRES: no point is exact yet.
  void tracePenumbras() {
    if (isSoft()) gnomon::tracePenumbras(points_, light_, samples_, known_);
  }

  /// The pixels at edges of the shadow whose points are not exact yet. None in the shadow of a light that has a size
  /// where a pixel has one sample: rays from there have found it.
  Pixels atEdges() {
    if (isSoft() && places_ == 1) return {};
    const auto apartBy = [&](std::uint8_t apart) { return pixelsApart(grid(), known_.shares, apart); };
    Pixels pixels = apartBy(isSoft() ? kSoftEdge : kEdge);
    if (isSoft()) {
      Pixels apart = apartBy(kEdge);
      std::erase_if(apart, [&](std::uint32_t pixel) { return !isEdge(pixel, kEdge); });
      pixels = either(known_, std::move(pixels), apart);
    }
    std::erase_if(pixels, [&](std::uint32_t pixel) { return isExact(pixel); });
    return pixels;
  }

  /// Those of them that lie next to one of `moved`, or to a corner.
  Pixels atEdgesBeside(const Pixels& moved) {
    return pixelsBeside(known_, moved, [&](std::uint32_t pixel, std::uint32_t other) {
      return !isExact(pixel) && isEdge(pixel, known_.apart(pixel, other));
    });
  }

  UnfilledVector<std::uint16_t> takeValues() {
    known_.values.resize(grid().pixels() * places_);
    return std::move(known_.values);
  }

 private:
  static constexpr std::uint8_t kAway = PictureShares::kAway;
  static constexpr std::uint8_t kExact = PictureShares::kExact;

  bool isExact(std::uint32_t pixel) const { return (known_.marks[pixel] & kExact) != 0; }

  /// Whether an edge shows between a pixel and those beside it, which differ by so much. In a penumbra one does where
  /// the samples of the pixel show several triangles, each of which may see another share.
  bool isEdge(std::uint32_t pixel, int apart) const {
    return apart >= (isSoft() ? kSoftEdge : kEdge) || (apart >= kEdge && points_.showsSeveral(grid().pixelAt(pixel)));
  }

  void setLit(const Rect& block) {
    const std::size_t width = static_cast<std::size_t>(std::min(block.width, grid().width - block.x));
    for (int y = block.y; y < std::min(block.y + block.height, grid().height); ++y) {
      const std::uint32_t first = grid().numberOf({block.x, y});
      std::fill_n(known_.valuesOf(first), width * places_, std::uint16_t{65535});
      std::fill_n(known_.shares.begin() + first, width, std::uint8_t{255});
      std::fill_n(known_.marks.begin() + first, width, std::uint8_t{0});
    }
  }

  /// What is lit, and what shows no surface, is left as it is: lit.
  std::uint64_t traceBlock(const Rect& block) {
    setLit(block);
    ShownSamples waiting;
    const std::uint64_t traced = traceWhereUnsure(block, waiting);
    traceDrawn(waiting);
    return traced;
  }

  /// Asks for a block as a whole where it shows one triangle, or none; then for its quarters; at last for its pixels.
  std::uint64_t traceWhereUnsure(const Rect& block, ShownSamples& waiting) {
    const Rect shown{block.x, block.y, std::min(block.width, grid().width - block.x),
                     std::min(block.height, grid().height - block.y)};
    if (shown.width <= 0 || shown.height <= 0) return 0;
    std::uint64_t traced = 0;
    if (const auto number = points_.onlyNumberIn(shown)) {
      if (*number == kNoNumber) return 0;
      const LightAcross across = light_.across(points_.drawnBlock(shown, *number));
      if (across == LightAcross::turnedAway) {
        forEachPixel(grid(), shown, [&](const glm::ivec2& pixel) { setTurnedAway(pixel); });
      }
      if (across != LightAcross::unsure) return 0;
    }
    if (block.height > kLeastHeight) {
      const int width = block.width / 2;
      const int height = block.height / 2;
      for (const int y : {block.y, block.y + height}) {
        for (const int x : {block.x, block.x + width}) traced += traceWhereUnsure({x, y, width, height}, waiting);
      }
      return traced;
    }
    TrianglesAcross triangles(points_, light_);
    forEachPixel(grid(), shown, [&](const glm::ivec2& pixel) {
      const std::uint32_t number = points_.numberAt(pixel);
      if (number == kNoNumber) return;
      const LightAcross across = triangles.of(number);
      if (across == LightAcross::turnedAway) setTurnedAway(pixel);
      if (across == LightAcross::unsure) traced += trace(pixel, number, waiting);
    });
    return traced;
  }

  /// Whether that takes rays.
  bool trace(const glm::ivec2& pixel, std::uint32_t number, ShownSamples& waiting) {
    if (number == kNoNumber) return false;
    waiting.add(pixel, 0, number);
    if (waiting.full()) traceDrawn(waiting);
    return true;
  }

  void setTurnedAway(const glm::ivec2& pixel) {
    known_.set(grid().numberOf(pixel), 0);
    known_.marks[grid().numberOf(pixel)] = kAway;
  }

  /// Then none wait any more.
  void traceDrawn(ShownSamples& waiting) {
    float found[DrawnPlaces::kCount];
    std::uint8_t away[DrawnPlaces::kCount];
    light_.visibility(points_.drawn(waiting), 0, 1, found, away);
    for (std::size_t i = 0; i < waiting.count; ++i) {
      if (found[i] == 1) continue;
      const std::uint32_t pixel = grid().numberOf(waiting.pixels[i]);
      known_.set(pixel, found[i]);
      known_.marks[pixel] = away[i] != 0 ? kAway : 0;
    }
    waiting.count = 0;
  }

  const SampleGrid& grid() const { return points_.grid(); }

  /// The samples of a pixel share its rays.
  int samplesOfPoint() const { return std::max(1, samples_ / static_cast<int>(places_)); }

  bool isSoft() const { return light_.hasSize(); }

  const PicturePoints& points_;
  TracedLight light_;
  int samples_;
  std::size_t places_; ///< samples of a pixel
  PictureShares known_;
};

} // namespace

bool sendsRays(std::span<const int> layered, std::span<const Light> lights) {
  return std::any_of(layered.begin(), layered.end(), [&](int light) {
    const TechniqueTraits& traits = traitsOf(lights[static_cast<std::size_t>(light)].shadow->technique);
    return traits.traced && !traits.baked;
  });
}

TracedShadow tracedShadow(const PicturePoints& points, const TraceInput& rays, int light, int samples) {
  ShadowTracing shadow(points, rays, light, samples);
  const std::uint64_t traced = shadow.traceDrawn();
  const Pixels doubtful = shadow.doubtful();
  shadow.tracePenumbras();
  shadow.traceExactly(doubtful);
  for (Pixels next = shadow.atEdges(); !next.empty();) {
    next = shadow.atEdgesBeside(shadow.traceEdges(next));
  }
  return {shadow.takeValues(), traced};
}

} // namespace gnomon
