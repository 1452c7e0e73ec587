#pragma once

#include <array>
#include <glm/glm.hpp>

#include "renderer/rays/crossings.h"
#include "renderer/rays/light_source.h"
#include "renderer/rays/ray_packet.h"
#include "renderer/rays/trace.h"

/// The points of drawn triangles as rays to a light start from them, in floats, kLanes at a time: they say of nearly
/// all points whether a ray is needed and where it runs, and know of which ones they can't.
namespace gnomon {

/// A camera as floats see it: relative to the eye, in the tree's units.
struct DrawnView {
  glm::vec3 eyeHigh{0}, eyeLow{0}; ///< their sum is the eye
  glm::vec3 middle{0}, right{0}, up{0};
  glm::vec2 size{1};             ///< of the picture, pixels
  glm::vec2 spread{0}, slope{0}; ///< as Sight
};

struct DrawnLight {
  bool directional = true;
  float radius = 0;      ///< as LightSource::radius, in the tree's units; 0 = a point
  glm::vec3 toward{0};   ///< of a directional light; unit length
  glm::vec3 position{0}; ///< of the others, relative to the eye, in the tree's units
  float range = 0;       ///< in the tree's units; may be infinite
  glm::vec3 axis{0};
  float cosOuter = -2; ///< -2: of a point light
};

DrawnView drawnView(const Sight& sight, double scale);
DrawnLight drawnLight(const LightSource& light, const glm::dvec3& eye, double scale);

/// Lanes of what is decided hold -1, or 0 where it does not hold.
struct alignas(64) DrawnPoints : TriangleLanes {
  float u[kLanes], v[kLanes]; ///< weights of the second and third corner, in the triangle
  float relative[3][kLanes];  ///< the point, from the eye
  float normal[3][kLanes];    ///< unit length, on the eye's side
  float start[3][kLanes];  ///< of rays; lifted off the surface as startOf does: more would pass over rims close above
  float unsure[kLanes];    ///< how far off the triangle's plane the point may lie
  float turn[kLanes];      ///< how wrong a cosine of the normal may be
  float toward[3][kLanes]; ///< the light, or a place on it; unit length
  float length[kLanes];    ///< to the light; infinite for directional ones
  int faces[kLanes];       ///< the surface is turned to the light
  int reached[kLanes];     ///< the light shines as far as here, and in this direction
  int leaves[kLanes];      ///< the way leads off the surface; of a light with a size some may not
  int sure[kLanes];        ///< floats decide all that; else the other values mean nothing
};

inline glm::vec3 laneOf(const float (&from)[3][kLanes], unsigned lane) {
  return {from[0][lane], from[1][lane], from[2][lane]};
}

/// Sets each lane's corners to those of what is drawn there.
void setTriangles(const TracedScene::Tree& tree, const DrawnPlaces& places, DrawnPoints& points);

/// Finds each lane's point from its corners. (`view` is a copy, which no lane that is written can change.)
void findPoints(DrawnView view, const DrawnPlaces& places, DrawnPoints& points);

/// Finds the way from there to the light's middle.
void aim(const DrawnLight& light, DrawnPoints& points);

/// Places in the unit square, one a lane, in units of 2^-32.
struct SquarePlaces {
  std::uint32_t x[kLanes], y[kLanes];
};

/// Turns the way to a place of the light's disc, as discFacing and waysTo have it. REQUIRES: aim.
void aimAside(const DrawnLight& light, const SquarePlaces& places, DrawnPoints& points);

} // namespace gnomon
