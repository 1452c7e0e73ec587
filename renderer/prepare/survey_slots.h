#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/core/camera_view.h"
#include "renderer/prepare/frame_geometry.h"

/// What a survey draws, and in which order: slots are marked by a byte each. Pure.
namespace gnomon {

struct SurveyInput {
  const Scene& scene;
  const SceneView& view;
  const FrameGeometry& geometry;
  const CameraView& camera;
  std::span<const NodeSwitches> nodes; ///< one a node of the file; empty = every node has the defaults
};

/// The slots that may lie in the camera's view, of nodes that it may see.
std::vector<std::uint8_t> slotsInView(const SurveyInput& input);

/// Of the slots in view those to be drawn first, because they may hide others: the nearest, with a share of all
/// triangles in view; every one where there are few triangles.
std::vector<std::uint8_t> firstToDraw(const SurveyInput& input, const std::vector<std::uint8_t>& inView);

/// The marked slots whose instances belong to one of these receiver groups, a bit each.
std::vector<std::uint8_t> slotsOfGroups(const FrameGeometry& geometry, std::uint32_t groups,
                                        std::vector<std::uint8_t> marked);

/// The marked slots that `done` does not mark.
std::vector<std::uint8_t> without(std::span<const std::uint8_t> marked, std::span<const std::uint8_t> done);

} // namespace gnomon
