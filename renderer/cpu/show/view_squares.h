#pragma once

#include "renderer/cpu/show/show_view.h"

/// A square of the picture, whose lower left pixel is x, y; `list`: its fragments.
namespace gnomon::cpu {

/// The colors of a view of source `picture`: the mean of each pixel's samples.
void pictureSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

/// The numbers of a view of source `data`.
void dataSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

} // namespace gnomon::cpu
