#pragma once

#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/aabb.h"
#include "renderer/core/camera_view.h"
#include "renderer/shadow/depth_range.h"
#include "renderer/shadow/shadow_plan.h"
#include "renderer/shadow/tile_space.h"

namespace gnomon {

/// The surfaces that the camera sees in a cascade, as small boxes in light space relative to the eye. Conservative:
/// together they hold the whole piece of view behind each survey block, half a pixel wider on every side, between the
/// block's nearest and farthest depth, cut to the cascade, each end depthSlack farther.
std::vector<Aabb> receiverPieces(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                                 const CascadeInterval& cascade);

/// The nearest and the farthest point in the middle of every few survey blocks, within these depths; relative to the
/// eye.
std::vector<glm::dvec3> sampledReceivers(const CameraView& view, const ReceiverDepths& receivers,
                                         const DepthInterval& depths);

/// The box around boxes.
Aabb boxAround(const std::vector<Aabb>& boxes);

/// The basis turned about the light's direction, radians, from right towards up.
LightBasis rolled(const LightBasis& basis, double angle);

/// The turn, radians, of a rectangle of nearly the least area around points: a side of the least one lies along a side
/// of their hull (Freeman and Shapira, "Determining the Minimum-Area Encasing Rectangle for an Arbitrary Closed Curve",
/// 1975); the hull is taken at the points that are extreme in 64 directions. 0 without points, and where no turn saves
/// this share of the area.
double rollOfLeastArea(std::span<const glm::dvec2> points, double leastSaved = 0);

/// For a tight fit: the basis turned so that a box around the receivers in a cascade spends few texels on what is not
/// seen. It changes with every move of the camera.
LightBasis tightBasis(const CameraView& view, const ReceiverDepths& receivers, const LightBasis& basis,
                      const CascadeInterval& cascade);

} // namespace gnomon
