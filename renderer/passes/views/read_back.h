#pragma once

#include "renderer/image/image.h"
#include "renderer/passes/views/view_pass.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A shaded view as an image, first row on top.
Image readView(const DrawnView& drawn, const ViewRequest& request);

/// The whole atlas, from its depths. Encoded, as RGB: grey (near = dark), each tile outlined in its tint and named
/// "light.tile"; else the depths as they are.
Image readAtlas(const gl::Texture& depths, const ShadowPlan& plan, const ViewRequest& request);

/// One tile of it, border included: grey when encoded, else the depths as they are.
Image readTile(const gl::Texture& depths, const ShadowTile& tile, const ViewRequest& request);

} // namespace gnomon
