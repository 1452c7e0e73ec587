#pragma once

#include "renderer/render.h"

namespace gnomon::bench {

/// `side` x `side` round bodies of 2,600 triangles, side by side on a floor of 60 m: one mesh, drawn that many times.
/// The bodies fill the floor whatever their number, so that more triangles mean finer ones in the same picture. Has a
/// camera node called "camera".
ScenePtr bodiesScene(int side);

/// The same as a file.
Bytes bodiesGlb(int side);

} // namespace gnomon::bench
