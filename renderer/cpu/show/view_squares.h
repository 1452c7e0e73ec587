#pragma once

#include "renderer/core/parallel.h"
#include "renderer/cpu/show/show_view.h"

/// A square of the picture, whose lower left pixel is x, y; `list`: its fragments.
namespace gnomon::cpu {

/// The colors of a view of source `picture`: the mean of each pixel's samples.
void pictureSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

/// The numbers of a view of source `data`.
void dataSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

/// Calls `each(list, x, y)` with the fragments of every square of the picture, on all cores.
template <class Each>
void forEachSquare(const DepthBuffer& buffer, const Each& each) {
  const auto across = static_cast<std::size_t>((buffer.width + kTileSide - 1) / kTileSide);
  const auto up = static_cast<std::size_t>((buffer.height + kTileSide - 1) / kTileSide);
  forEachPiece(across * up, 8, [&](std::size_t first, std::size_t last) {
    FragmentList list;
    for (std::size_t i = first; i < last; ++i) {
      const int x = static_cast<int>(i % across) * kTileSide;
      const int y = static_cast<int>(i / across) * kTileSide;
      listFragments(buffer, x, y, list);
      each(list, x, y);
    }
  });
}

} // namespace gnomon::cpu
