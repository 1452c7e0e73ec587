#include "renderer/cpu/shadow/largest_seen.h"

#include <algorithm>

#include "renderer/prepare/draw_list.h"

namespace gnomon::cpu {
namespace {

constexpr int kSide = 16; // pixels of a square
constexpr std::size_t kLeastSquares = 4, kMostTriangles = 16;
constexpr double kLeastShare = 0.03; // of the picture: below it, what is told of them takes as long as it saves

/// The triangle of each square that shows the same one at its corners.
std::vector<std::uint32_t> filledSquares(const DepthBuffer& surfaces) {
  std::vector<std::uint32_t> triangles;
  const auto shownAt = [&](int x, int y) { return surfaces.triangles[surfaces.at(x, y)]; };
  for (int y = 0; y + kSide <= surfaces.height; y += kSide) {
    for (int x = 0; x + kSide <= surfaces.width; x += kSide) {
      const std::uint32_t own = shownAt(x, y);
      const int right = x + kSide - 1, top = y + kSide - 1;
      if (own == kNoNumber || shownAt(right, y) != own || shownAt(x, top) != own || shownAt(right, top) != own)
        continue;
      triangles.push_back(own);
    }
  }
  return triangles;
}

} // namespace

std::vector<std::uint32_t> largestSeen(const DepthBuffer& surfaces) {
  struct Seen {
    std::size_t squares;
    std::uint32_t triangle;
  };
  std::vector<std::uint32_t> squares = filledSquares(surfaces);
  std::sort(squares.begin(), squares.end());
  std::vector<Seen> all;
  for (auto first = squares.begin(); first != squares.end();) {
    const auto next = std::upper_bound(first, squares.end(), *first);
    const auto count = static_cast<std::size_t>(next - first);
    if (count >= kLeastSquares) all.push_back({count, *first});
    first = next;
  }
  std::stable_sort(all.begin(), all.end(), [](const Seen& a, const Seen& b) { return a.squares > b.squares; });
  if (all.size() > kMostTriangles) all.resize(kMostTriangles);
  std::size_t filled = 0;
  std::vector<std::uint32_t> triangles;
  for (const Seen& seen : all) {
    filled += seen.squares * kSide * kSide;
    triangles.push_back(seen.triangle);
  }
  if (static_cast<double>(filled) < kLeastShare * surfaces.width * surfaces.height) return {};
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

} // namespace gnomon::cpu
