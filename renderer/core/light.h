#pragma once

#include <glm/glm.hpp>

#include "protocol/spec/frame_lights.h"

namespace gnomon {

/// Unit length.
glm::dvec3 towardsSun(const Sun& sun);

/// Where the light travels, unit length, from `direction` or `sun`; for a point light it means nothing.
glm::dvec3 directionOf(const Light& light);

/// How far the edge of the light's own disc is off its middle: a tangent (directional) or metres; 0 = it has no size.
double radiusOf(const Light& light);

/// The color of a black body's glow as linear sRGB of luminance 1, so that it changes no lux and no candela: components
/// may exceed 1. What lies outside of sRGB is brought to its edge. `kelvin`: 1000..15000.
glm::dvec3 blackBodyColor(double kelvin);

/// Luminance of linear sRGB (Rec. 709).
double luminanceOf(const glm::dvec3& color);

/// The share of each component of `open` light that arrives, 0..1. A component that nothing is lit by has the share of
/// all others; without any light all are 1.
glm::dvec3 arrivingShare(const glm::dvec3& open, const glm::dvec3& arriving);

} // namespace gnomon
