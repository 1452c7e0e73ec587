#include "renderer/bake/bake_texels.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <mutex>

#include "renderer/core/parallel.h"

namespace gnomon {
namespace {

constexpr int kBandRows = 16; ///< of a chart, that one core has in hand at a time
constexpr std::int32_t kUncovered = TexelSums::kUncovered;

/// Rows of a chart, and the triangles that reach into them.
struct Band {
  std::size_t chart = 0;
  Rect rect; ///< texels of the map
  std::vector<std::uint32_t> triangles;
};

std::vector<Band> bandsOf(const LightMapLayout& layout) {
  std::vector<Band> bands;
  for (std::size_t chart = 0; chart < layout.charts.size(); ++chart) {
    const PlacedChart& placed = layout.charts[chart];
    const std::size_t first = bands.size();
    const int top = placed.rect.y + placed.rect.height;
    for (int y = placed.rect.y; y < top; y += kBandRows) {
      bands.push_back({chart, {placed.rect.x, y, placed.rect.width, std::min(kBandRows, top - y)}, {}});
    }
    const auto bandAt = [&](double y) {
      const int row = std::clamp(static_cast<int>(y), placed.rect.y, top - 1) - placed.rect.y;
      return first + static_cast<std::size_t>(row / kBandRows);
    };
    for (const std::uint32_t triangle : placed.triangles) {
      const FlatTriangle flat = layout.flat({placed.instance, triangle});
      const auto [low, high] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
      for (std::size_t band = bandAt(low); band <= bandAt(high); ++band) bands[band].triangles.push_back(triangle);
    }
  }
  return bands;
}

/// Says how much is done, one thread at a time, and asks often whether to go on.
class Listener {
 public:
  Listener(const Progress& progress, std::size_t texels) : progress_(progress), texels_(texels) {}

  bool stopped() const { return stopped_; }

  void done(std::size_t texels) {
    if (!progress_) return;
    const std::lock_guard lock(mutex_);
    done_ += texels;
    report();
  }

  /// False = stop. Cheap: asks no more often than every few milliseconds.
  bool goOn() {
    constexpr std::chrono::milliseconds kPause{10};
    if (!progress_ || stopped_) return !stopped_;
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (lock && std::chrono::steady_clock::now() - reported_ >= kPause) report();
    return !stopped_;
  }

 private:
  /// With the mutex held.
  void report() {
    reported_ = std::chrono::steady_clock::now();
    if (!stopped_ && !progress_(static_cast<double>(done_) / static_cast<double>(texels_))) stopped_ = true;
  }

  const Progress& progress_;
  std::size_t texels_;
  std::size_t done_ = 0;
  std::chrono::steady_clock::time_point reported_{};
  std::mutex mutex_;
  std::atomic<bool> stopped_ = false;
};

/// Where a place of the map lies in a triangle: weights of its second and third corner. Nothing outside of it.
class Weights {
 public:
  explicit Weights(const FlatTriangle& t)
      : origin_(t[0]), ab_(t[1] - t[0]), ac_(t[2] - t[0]), over_(1 / signedArea(t)) {}

  std::optional<glm::dvec2> at(const glm::dvec2& place) const {
    const glm::dvec2 p = place - origin_;
    const double u = (p.x * ac_.y - p.y * ac_.x) * over_;
    const double v = (ab_.x * p.y - ab_.y * p.x) * over_;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt;
    return glm::dvec2(u, v);
  }

 private:
  glm::dvec2 origin_, ab_, ac_;
  double over_;
};

void addPlaces(const PlacedTriangle& triangle, const FlatTriangle& flat, const Rect& rect, TexelSums& sums) {
  if (signedArea(flat) == 0) return;
  const Weights weights(flat);
  const auto [left, right] = std::minmax({flat[0].x, flat[1].x, flat[2].x});
  const auto [low, high] = std::minmax({flat[0].y, flat[1].y, flat[2].y});
  const int firstX = std::max(rect.x, static_cast<int>(left));
  const int lastX = std::min(rect.x + rect.width - 1, static_cast<int>(right));
  const int firstY = std::max(rect.y, static_cast<int>(low));
  const int lastY = std::min(rect.y + rect.height - 1, static_cast<int>(high));
  for (int y = firstY; y <= lastY; ++y) {
    for (int x = firstX; x <= lastX; ++x) {
      for (int place = 0; place < kTexelPlaces * kTexelPlaces; ++place) {
        const glm::dvec2 within(place % kTexelPlaces + 0.5, place / kTexelPlaces + 0.5);
        const auto at = weights.at(glm::dvec2(x, y) + within / double{kTexelPlaces});
        if (at) sums.add({triangle, *at, {x, y}, place});
      }
    }
  }
}

using Plane = std::vector<std::int32_t>; ///< of the whole map, row by row

std::size_t numberAt(const LightMapLayout& layout, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(layout.width) + static_cast<std::size_t>(x);
}

/// Gives each texel that no surface covers the mean of its neighbours that are known, ring by ring.
void spread(const Rect& rect, const LightMapLayout& layout, Listener& listener, Plane& shares) {
  std::vector<glm::ivec2> open;
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width; ++x) {
      if (shares[numberAt(layout, x, y)] == kUncovered) open.emplace_back(x, y);
    }
  }
  while (!open.empty() && listener.goOn()) {
    stopIfAsked();
    std::vector<glm::ivec2> still;
    std::vector<std::pair<std::size_t, std::int32_t>> found;
    for (const glm::ivec2& texel : open) {
      std::int32_t sum = 0, count = 0;
      for (int y = std::max(texel.y - 1, rect.y); y <= std::min(texel.y + 1, rect.y + rect.height - 1); ++y) {
        for (int x = std::max(texel.x - 1, rect.x); x <= std::min(texel.x + 1, rect.x + rect.width - 1); ++x) {
          const std::int32_t share = shares[numberAt(layout, x, y)];
          if (share == kUncovered) continue;
          sum += share;
          ++count;
        }
      }
      if (count > 0) {
        found.emplace_back(numberAt(layout, texel.x, texel.y), (sum + count / 2) / count);
      } else {
        still.push_back(texel);
      }
    }
    if (found.empty()) return; // nothing of the chart is known
    for (const auto& [texel, share] : found) shares[texel] = share;
    open = std::move(still);
  }
}

/// The share at the middle of a chart's first triangle, for all of a chart so narrow that none of the places lies in
/// it.
void fillNarrow(const PlacedChart& chart, const LightMapLayout& layout, const MakeTexelSums& makeSums,
                Listener& listener, std::vector<Plane>& planes) {
  const Rect& rect = chart.rect;
  if (planes.front()[numberAt(layout, rect.x, rect.y)] != kUncovered) return;
  const auto sums = makeSums({rect.x, rect.y, 1, 1}, 1, [&listener] { return listener.goOn(); });
  sums->add({{chart.instance, chart.triangles.front()}, glm::dvec2(1.0 / 3), {rect.x, rect.y}, 0});
  const auto means = sums->means();
  for (std::size_t plane = 0; plane < planes.size(); ++plane) {
    for (int y = rect.y; y < rect.y + rect.height; ++y) {
      std::fill_n(&planes[plane][numberAt(layout, rect.x, y)], rect.width, means[plane].front());
    }
  }
}

LightMap mapOf(const LightMapLayout& layout, const Plane& shares) {
  LightMap map{layout.width, layout.height, std::vector<std::uint16_t>(shares.size(), 65535)};
  for (std::size_t i = 0; i < shares.size(); ++i) {
    if (shares[i] != kUncovered) map.shares[i] = static_cast<std::uint16_t>(shares[i]);
  }
  return map;
}

} // namespace

std::optional<std::vector<LightMap>> bakeTexels(const LightMapLayout& layout, std::size_t count,
                                                const MakeTexelSums& makeSums, const Progress& progress) {
  const std::vector<Band> bands = bandsOf(layout);
  std::vector<Plane> planes(count, Plane(numberAt(layout, 0, layout.height), kUncovered));
  std::size_t texels = 0;
  for (const Band& band : bands) texels += texelsIn(band.rect);
  Listener listener(progress, texels);
  const GoOn goOn = [&listener] { return listener.goOn(); };
  forEach(bands.size(), [&](std::size_t i) {
    if (listener.stopped()) return;
    const Band& band = bands[i];
    const auto sums = makeSums(band.rect, kTexelPlaces * kTexelPlaces, goOn);
    const std::uint32_t instance = layout.charts[band.chart].instance;
    for (const std::uint32_t triangle : band.triangles) {
      if (listener.stopped()) return;
      addPlaces({instance, triangle}, layout.flat({instance, triangle}), band.rect, *sums);
    }
    const auto means = sums->means();
    const auto rowLength = static_cast<std::size_t>(band.rect.width);
    for (std::size_t plane = 0; plane < count; ++plane) {
      for (int row = 0; row < band.rect.height; ++row) {
        const auto from = means[plane].begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * rowLength);
        std::copy_n(from, rowLength, &planes[plane][numberAt(layout, band.rect.x, band.rect.y + row)]);
      }
    }
    listener.done(texelsIn(band.rect));
  });
  if (listener.stopped()) return std::nullopt;
  forEach(layout.charts.size(), [&](std::size_t i) {
    if (!listener.goOn()) return;
    for (Plane& plane : planes) spread(layout.charts[i].rect, layout, listener, plane);
    fillNarrow(layout.charts[i], layout, makeSums, listener, planes);
  });
  if (listener.stopped()) return std::nullopt;
  std::vector<LightMap> maps;
  for (const Plane& plane : planes) maps.push_back(mapOf(layout, plane));
  return maps;
}

} // namespace gnomon
