#pragma once

#include <cstdint>
#include <span>

#include "renderer/core/camera_view.h"
#include "renderer/scene/scene.h"

namespace gnomon {

/// An orthographic picture is the same from anywhere along its view axis: this is the same view from an eye amid the
/// receivers that it may show, so that floats, which hold places relative to the eye, are as fine as from nearby; and
/// with its depths stored between planes no farther apart than what it may show (CameraView::ahead, drawnDepths). The
/// eye moves by whole steps, so that it stays put while the camera moves a little. A perspective view is returned as
/// it is. `receiving`: one an instance, 1 where it shows shadows; where none of them is in view, all count.
CameraView movedToScene(const CameraView& view, const SceneView& scene, std::span<const std::uint8_t> receiving);

} // namespace gnomon
