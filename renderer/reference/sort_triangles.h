#pragma once

#include "renderer/reference/tree.h"

namespace gnomon {

/// Sorts a tree's placed triangles for rays: makes `device` and `rays`, or sets `error`.
/// A primitive of many triangles that several instances place is sorted once, in its own space, where the rounding of
/// rays that are turned into it is no worse than that of placed vertices. `rays` refers to the tree's vectors.
void sortTriangles(TracedScene::Tree& tree);

} // namespace gnomon
