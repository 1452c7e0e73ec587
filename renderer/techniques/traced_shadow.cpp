#include "renderer/techniques/traced_shadow.h"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "renderer/core/parallel.h"
#include "renderer/core/rect.h"
#include "renderer/techniques/neighbours.h"

namespace gnomon {
namespace {

/// Pixels that one core has in hand at a time: what is kept of them stays in its caches.
constexpr std::size_t kPixels = 512;

/// Blocks of the picture, in which a packet of rays takes squares of 4 x 4 pixels: rays of a packet stay together.
constexpr int kBlockWidth = 32;
constexpr int kBlockHeight = 16;
constexpr int kSquare = 4;
constexpr int kLeastHeight = 8; ///< of blocks that are asked for as a whole
static_assert(kBlockWidth * kBlockHeight == kPixels);

/// Shares of 255 that differ by less show no edge between them.
constexpr int kEdge = 26;

using Pixels = std::vector<std::uint32_t>;

Pixels eachOnce(Pixels pixels) {
  std::sort(pixels.begin(), pixels.end());
  pixels.erase(std::unique(pixels.begin(), pixels.end()), pixels.end());
  return pixels;
}

/// Calls `each(pixel)` for the pixels of a block of the picture, square by square.
template <class Each>
void forEachPixel(const SampleGrid& grid, const Rect& block, Each each) {
  const int right = std::min(block.x + block.width, grid.width);
  const int top = std::min(block.y + block.height, grid.height);
  for (int y = block.y; y < top; y += kSquare) {
    for (int x = block.x; x < right; x += kSquare) {
      for (int row = y; row < std::min(y + kSquare, top); ++row) {
        for (int column = x; column < std::min(x + kSquare, right); ++column) each(glm::ivec2(column, row));
      }
    }
  }
}

/// One light's shadow over the picture while rays complete it.
class ShadowTracing {
 public:
  ShadowTracing(const PicturePoints& points, const TraceInput& rays, int light, int samples)
      : points_(points),
        light_(rays, light),
        samples_(samples),
        places_(grid().samples()),
        values_(count() + count() % 2), // read by pairs
        shares_(grid().pixels()),
        marks_(grid().pixels()) {}

  /// Takes what the verdicts are sure of, and sends rays from the other points as they were drawn, but from blocks
  /// that are lit or turned away as a whole. Gives how many pixels rays were sent from.
  std::uint64_t traceDrawn(std::span<const Verdict> verdicts) {
    const int columns = (grid().width + kBlockWidth - 1) / kBlockWidth;
    const int rows = (grid().height + kBlockHeight - 1) / kBlockHeight;
    std::atomic<std::uint64_t> traced = 0;
    forEach(static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), [&](std::size_t i) {
      const int block = static_cast<int>(i);
      traced += traceBlock({block % columns * kBlockWidth, block / columns * kBlockHeight, kBlockWidth, kBlockHeight},
                           verdicts);
    });
    return traced;
  }

  /// Sends rays from where camera rays lead. Gives the pixels that other shares came of.
  Pixels traceExactly(const Pixels& pixels) {
    std::vector<std::uint8_t> changed(pixels.size());
    forEachPiece(pixels.size(), kPixels, [&](std::size_t first, std::size_t last) {
      const auto piece = std::span(pixels).subspan(first, last - first);
      const std::vector<SurfacePoint> hits = points_.traced(piece);
      std::vector<float> found(hits.size());
      light_.visibility(hits, samples_, found);
      for (std::size_t i = 0; i < piece.size(); ++i) {
        const auto own = std::span(found).subspan(i * places_, places_);
        std::transform(own.begin(), own.end(), valuesOf(piece[i]), unorm16);
        const float mean = std::accumulate(own.begin(), own.end(), 0.0f) / static_cast<float>(places_);
        changed[first + i] = unorm8(mean) != shares_[piece[i]] ? 1 : 0;
        shares_[piece[i]] = unorm8(mean);
        marks_[piece[i]] |= kExact;
      }
    });
    Pixels moved;
    for (std::size_t i = 0; i < pixels.size(); ++i) {
      if (changed[i] != 0) moved.push_back(pixels[i]);
    }
    return moved;
  }

  /// The pixels to both sides of where surfaces that are turned away end. REQUIRES: no point is exact yet.
  Pixels whereTurnedAwayEnds() const {
    return pixelsWhere(grid(), marks_, [](std::uint8_t least, std::uint8_t most) { return least != most; });
  }

  /// The pixels at edges of the shadow whose points are not exact yet.
  Pixels atEdges() const {
    Pixels pixels = pixelsWhere(grid(), shares_, [](std::uint8_t least, std::uint8_t most) {
      return static_cast<int>(most) - static_cast<int>(least) >= kEdge;
    });
    std::erase_if(pixels, [&](std::uint32_t pixel) { return isExact(pixel); });
    return pixels;
  }

  /// Those of them that lie next to one of `moved`, or to a corner.
  Pixels atEdgesBeside(const Pixels& moved) const {
    Pixels pixels;
    const int width = grid().width;
    for (const std::uint32_t pixel : moved) {
      const int x = static_cast<int>(pixel) % width;
      const int row = static_cast<int>(pixel) / width;
      for (int line = std::max(row - 1, 0); line <= std::min(row + 1, grid().height - 1); ++line) {
        for (int column = std::max(x - 1, 0); column <= std::min(x + 1, width - 1); ++column) {
          const auto other = static_cast<std::uint32_t>(line * width + column);
          const int apart = std::abs(static_cast<int>(shares_[other]) - static_cast<int>(shares_[pixel]));
          if (!isExact(other) && apart >= kEdge) pixels.push_back(other);
        }
      }
    }
    return eachOnce(std::move(pixels));
  }

  UnfilledVector<std::uint16_t> takeValues() {
    values_.resize(count());
    return std::move(values_);
  }

 private:
  static constexpr std::uint8_t kAway = 1;  ///< what was drawn there is turned away from the light
  static constexpr std::uint8_t kExact = 2; ///< camera rays led to its points

  bool isExact(std::uint32_t pixel) const { return (marks_[pixel] & kExact) != 0; }

  void setLit(const Rect& block) {
    const std::size_t width = static_cast<std::size_t>(std::min(block.width, grid().width - block.x));
    for (int y = block.y; y < std::min(block.y + block.height, grid().height); ++y) {
      const std::uint32_t first = numberOf({block.x, y});
      std::fill_n(valuesOf(first), width * places_, std::uint16_t{65535});
      std::fill_n(shares_.begin() + first, width, std::uint8_t{255});
      std::fill_n(marks_.begin() + first, width, std::uint8_t{0});
    }
  }

  void set(std::uint32_t pixel, float share) {
    std::uint16_t* values = valuesOf(pixel);
    *values = unorm16(share);
    for (std::size_t i = 1; i < places_; ++i) values[i] = *values;
    shares_[pixel] = unorm8(share);
  }

  std::uint32_t numberOf(const glm::ivec2& pixel) const {
    return static_cast<std::uint32_t>(pixel.y * grid().width + pixel.x);
  }

  /// What is lit, and what shows no surface, is left as it is: lit.
  std::uint64_t traceBlock(const Rect& block, std::span<const Verdict> verdicts) {
    setLit(block);
    ShownPixels waiting;
    const std::uint64_t traced =
        verdicts.empty() ? traceWhereUnsure(block, waiting) : traceJudged(block, verdicts, waiting);
    traceDrawn(waiting);
    return traced;
  }

  std::uint64_t traceJudged(const Rect& block, std::span<const Verdict> verdicts, ShownPixels& waiting) {
    std::uint64_t traced = 0;
    forEachPixel(grid(), block, [&](const glm::ivec2& pixel) {
      const Verdict verdict = verdicts[numberOf(pixel)];
      if (verdict == Verdict::unsure) {
        traced += trace(pixel, waiting);
      } else if (verdict == Verdict::turnedAway) {
        setTurnedAway(pixel);
      } else if (verdict != Verdict::lit) {
        set(numberOf(pixel), 0);
      }
    });
    return traced;
  }

  /// Asks for a block as a whole where it shows one triangle, or none; then for its quarters; at last for its pixels.
  std::uint64_t traceWhereUnsure(const Rect& block, ShownPixels& waiting) {
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
    forEachPixel(grid(), shown, [&](const glm::ivec2& pixel) { traced += trace(pixel, waiting); });
    return traced;
  }

  /// Whether that takes rays.
  bool trace(const glm::ivec2& pixel, ShownPixels& waiting) {
    const std::uint32_t number = points_.numberAt(pixel);
    if (number == kNoNumber) return false;
    waiting.add(pixel, number);
    if (waiting.full()) traceDrawn(waiting);
    return true;
  }

  void setTurnedAway(const glm::ivec2& pixel) {
    set(numberOf(pixel), 0);
    marks_[numberOf(pixel)] = kAway;
  }

  /// Then none wait any more.
  void traceDrawn(ShownPixels& waiting) {
    float found[DrawnPlaces::kCount];
    std::uint8_t away[DrawnPlaces::kCount];
    light_.visibility(points_.drawn(waiting), samples_, found, away);
    for (std::size_t i = 0; i < waiting.count; ++i) {
      if (found[i] == 1) continue;
      const std::uint32_t pixel = numberOf(waiting.pixels[i]);
      set(pixel, found[i]);
      marks_[pixel] = away[i] != 0 ? kAway : 0;
    }
    waiting.count = 0;
  }

  const SampleGrid& grid() const { return points_.grid(); }
  std::size_t count() const { return grid().pixels() * grid().samples(); }
  std::uint16_t* valuesOf(std::uint32_t pixel) { return values_.data() + pixel * places_; }

  const PicturePoints& points_;
  TracedLight light_;
  int samples_;
  std::size_t places_; ///< samples of a pixel
  UnfilledVector<std::uint16_t> values_;
  UnfilledVector<std::uint8_t> shares_; ///< 0..255, one a pixel: the mean of its samples
  UnfilledVector<std::uint8_t> marks_;  ///< one a pixel
};

} // namespace

TracedShadow tracedShadow(const PicturePoints& points, const TraceInput& rays, int light, int samples,
                          std::span<const Verdict> verdicts) {
  ShadowTracing shadow(points, rays, light, samples);
  std::uint64_t traced = shadow.traceDrawn(verdicts);
  const auto traceExactly = [&](const Pixels& pixels) {
    traced += static_cast<std::uint64_t>(std::count_if(pixels.begin(), pixels.end(), [&](std::uint32_t pixel) {
      return !verdicts.empty() && verdicts[pixel] != Verdict::unsure;
    }));
    return shadow.traceExactly(pixels);
  };
  Pixels doubtful = shadow.whereTurnedAwayEnds();
  const Pixels masked = points.besideMasks();
  doubtful.insert(doubtful.end(), masked.begin(), masked.end());
  traceExactly(eachOnce(std::move(doubtful)));
  for (Pixels next = shadow.atEdges(); !next.empty();) next = shadow.atEdgesBeside(traceExactly(next));
  return {shadow.takeValues(), traced};
}

std::vector<Light> withoutSizes(std::span<const Light> lights) {
  std::vector<Light> sharp(lights.begin(), lights.end());
  for (Light& light : sharp) {
    light.angularDiameterDegrees.reset();
    light.radius.reset();
  }
  return sharp;
}

} // namespace gnomon
