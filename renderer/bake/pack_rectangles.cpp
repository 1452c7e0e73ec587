#include "renderer/bake/pack_rectangles.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace gnomon {
namespace {

/// A level stretch of the skyline, as far as the next one's x.
struct Step {
  int x = 0;
  int y = 0;
};

struct Place {
  std::size_t step = 0; ///< that it begins at
  int y = 0;
};

/// The lowest place for something of this width; of equally low ones the leftmost.
Place lowest(const std::vector<Step>& skyline, int width, int stripWidth) {
  Place best{0, -1};
  for (std::size_t i = 0; i < skyline.size() && skyline[i].x + width <= stripWidth; ++i) {
    int y = 0;
    for (std::size_t k = i; k < skyline.size() && skyline[k].x < skyline[i].x + width; ++k)
      y = std::max(y, skyline[k].y);
    if (best.y < 0 || y < best.y) best = {i, y};
  }
  return best;
}

void raise(std::vector<Step>& skyline, const Rect& rect, std::size_t first, int stripWidth) {
  const int right = rect.x + rect.width;
  std::size_t last = first;
  while (last < skyline.size() && skyline[last].x < right) ++last;
  const int level = skyline[last - 1].y; // of what is left of the last stretch
  const auto at = skyline.begin() + static_cast<std::ptrdiff_t>(first);
  const auto next = skyline.erase(at, skyline.begin() + static_cast<std::ptrdiff_t>(last));
  const bool rest = right < stripWidth && (next == skyline.end() || next->x > right);
  const auto placed = skyline.insert(next, {rect.x, rect.y + rect.height});
  if (rest) skyline.insert(placed + 1, {right, level});
}

} // namespace

RectanglePacking packRectangles(std::span<const glm::ivec2> sizes, int width) {
  std::vector<std::size_t> order(sizes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::tuple(-sizes[a].y, -sizes[a].x, a) < std::tuple(-sizes[b].y, -sizes[b].x, b);
  });
  RectanglePacking packing;
  packing.rects.resize(sizes.size());
  std::vector<Step> skyline{{0, 0}};
  for (const std::size_t i : order) {
    const Place place = lowest(skyline, sizes[i].x, width);
    const Rect rect{skyline[place.step].x, place.y, sizes[i].x, sizes[i].y};
    raise(skyline, rect, place.step, width);
    packing.rects[i] = rect;
    packing.height = std::max(packing.height, rect.y + rect.height);
  }
  return packing;
}

} // namespace gnomon
