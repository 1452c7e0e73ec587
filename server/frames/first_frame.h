#pragma once

#include "renderer/render.h"

namespace gnomon {

/// Draws a small shadowed frame and looks whether the shadow is there: the proof that this renderer works.
Status drawFirstFrame(Renderer& renderer);

} // namespace gnomon
