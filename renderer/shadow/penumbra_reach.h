#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "renderer/core/aabb.h"

namespace gnomon {

/// How far from a receiver's own place a caster may be that takes a share of a light's disc from it.
struct PenumbraReach {
  double nearest = 0; ///< light space z of the caster nearest to the light
  double radius = 0;  ///< metres across the light
};

/// The least z (light space) of the part of a box that lies over a rectangle of the map; none where no part does.
/// `lightFromBox`: a turn and a shift.
std::optional<double> nearestOver(const Aabb& box, const glm::dmat4& lightFromBox, const glm::dvec2& lowest,
                                  const glm::dvec2& highest);

/// The same in the pyramid from the origin of light space in which x / z and y / z lie between these. REQUIRES: the
/// lowest are less than the highest.
std::optional<double> nearestInPyramid(const Aabb& box, const glm::dmat4& lightFromBox, const glm::dvec2& lowest,
                                       const glm::dvec2& highest);

/// Parallel light whose disc's edge is `lightRadius` off its middle (a tangent): the casters in `scene`, a box that
/// `lightFromScene` takes to light space, and the receivers in a box of light space. Only the casters over the
/// receivers and the penumbra around them count: each bounds how far the others matter. Never too little.
PenumbraReach penumbraReach(const Aabb& receiversLs, const Aabb& scene, const glm::dmat4& lightFromScene,
                            double lightRadius);

/// For light from a disc of `lightRadius` metres across the tile's direction, as pcss takes it, a tangent: the widest
/// that the penumbra shows from the light between casters no nearer than `nearest` and receivers no farther than
/// `farthest`, metres along that direction.
double penumbraTangent(double nearest, double farthest, double lightRadius);

/// Light space z, metres, of the nearest caster in `scene` that takes a share of such light from a receiver and is
/// no more than `widest` (a tangent) off it. `seen`: the receivers as tangentsOf gives them (fit.h). Never too much;
/// that of the nearest receiver where no caster does.
double nearestCasterInPyramid(const Aabb& seen, const Aabb& scene, const glm::dmat4& lightFromScene, double lightRadius,
                              double widest);

} // namespace gnomon
