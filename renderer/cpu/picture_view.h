#pragma once

#include "renderer/cpu/show_view.h"

namespace gnomon::cpu {

/// The colors of a picture's square: the mean of each pixel's samples. `list`: its fragments; `x`, `y`: its lower left
/// pixel.
void pictureSquare(const ShowJob& job, const FragmentList& list, int x, int y, TileColors& colors);

} // namespace gnomon::cpu
