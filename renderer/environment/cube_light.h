#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <string>

#include "protocol/base/result.h"
#include "renderer/environment/environment_map.h"
#include "renderer/image/image_codec.h"

/// Light from all around as a glTF holds it: six pictures, the faces of a cube (EXT_lights_image_based).
namespace gnomon {

/// Faces are in the order +X, -X, +Y, -Y, +Z, -Z of a left-handed cube: the face +Z lies towards -Z of the glTF, all
/// others where their names say. The first row of a picture is the lowest of its face as OpenGL has it; seen from
/// within, the four faces at the sides are the right way up once they are flipped top to bottom. So Babylon.js draws
/// them in a right-handed scene.
struct CubeLight {
  std::array<std::shared_ptr<const CheckedImage>, 6> faces; ///< squares of one size
  std::array<std::string, 6> places;                        ///< of each picture in the glTF, for problems
  glm::dmat3 cubeFromWorld{1};                              ///< a turn: undoes the light's
  double intensity = 1;                                     ///< radiance is multiplied by it
  /// Spherical harmonics of what the file states as irradiance, before `intensity`, in the order of
  /// irradianceCoefficients; linear RGB. What lights is the picture.
  std::array<glm::dvec3, 9> irradiance{};
};

/// Texels along one side of a face.
inline int sideOf(const CubeLight& light) {
  return light.faces[0]->size.width;
}

/// Of the map that faces of this side become: as fine as they are in their middle, and no less than a map may have.
glm::ivec2 mapSizeOf(int side);

/// Of the encoded faces.
std::uint64_t bytesIn(const CubeLight& light);

/// The map that it is, with `cubeFromWorld` and `intensity` applied: each texel the mean over its solid angle. A face
/// is sRGB; where it has alpha it is RGBD, its linear color divided by alpha. On all cores; takes twice what the map
/// takes. Problems have no pointer and name the picture: damaged, an alpha of 0, or light that a map can't hold
/// (environment_checks.h).
Result<EnvironmentMap> readCube(const CubeLight& light);

} // namespace gnomon
