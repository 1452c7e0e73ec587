#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/environment/environment_map.h"

/// What a file states as the irradiance of its light, beside that of its picture.
namespace gnomon {

/// Irradiance as real spherical harmonics up to l = 2 (Ramamoorthi and Hanrahan, "An Efficient Representation for
/// Irradiance Environment Maps", 2001): of 1, y, z, x, xy, yz, 3zz - 1, xz, xx - yy.
using Irradiance = std::array<double, 9>;

/// That of a map's luminance; directions are `axesFromMap` of the map's.
Irradiance irradianceOf(const EnvironmentMap& map, const glm::dmat3& axesFromMap);

/// Of a surface with this normal.
double irradianceAt(const Irradiance& irradiance, const glm::dvec3& normal);

/// How far one is from another at most, over 26 normals, as a share of the greatest of `right`. Infinite where `right`
/// is dark and the other is not.
double greatestDifference(const Irradiance& stated, const Irradiance& right);

} // namespace gnomon
