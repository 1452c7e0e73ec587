#pragma once

#include "renderer/render.h"

namespace gnomon {

/// Draws a small frame and looks for the shadow in it: the proof that this renderer works.
Status drawFirstFrame(Renderer& renderer);

} // namespace gnomon
