#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "renderer/rays/trace.h"

/// Rays to light that comes from everywhere: what the scene hides of it.
namespace gnomon {

/// What drawn places are to such light.
struct SkyPlaces {
  static constexpr std::size_t kCount = DrawnPlaces::kCount;
  alignas(64) float normal[3][kCount]; ///< of the triangle, on the eye's side; unit length
  float shading[3][kCount];            ///< by which a picture shades, without a normal map; unit length
  float toEye[3][kCount];              ///< unit length
  float roughness[kCount];             ///< perceptual, without a texture
  int receives[kCount];                ///< -1: a surface that shows shadows; else 0, and the others mean nothing
};

/// A direction for each of them.
struct SkyWays {
  alignas(64) float toward[3][SkyPlaces::kCount]; ///< unit length
  int asked[SkyPlaces::kCount];                   ///< -1: a ray is sent; else 0
};

/// What throws shadows of such light: all nodes that cast shadows, whatever their layers, and the input's media. Made
/// once for a frame; any thread. What the input refers to outlives it.
class TracedSky {
 public:
  explicit TracedSky(const TraceInput& input);
  ~TracedSky();

  bool receives(std::uint32_t instance) const; ///< whether it shows shadows

  /// A point of a triangle: `weights`, those of its second and third corner. Its normal is on the front side.
  SurfacePoint pointInFront(const PlacedTriangle& triangle, const glm::dvec2& weights) const;

  /// By which a picture shades a point, without a normal map; unit length. REQUIRES: a surface.
  glm::dvec3 shadingNormal(const SurfacePoint& point) const;

  /// The share of the light that comes to a point along each way, past casters as doubles find them and past media; on
  /// the calling thread. REQUIRES: as many of each; ways of unit length that lead off the triangle's plane, to the
  /// eye's side.
  void through(const SurfacePoint& point, std::span<const glm::dvec3> ways, std::span<float> shares) const;

  /// The same of a place in the air, in the world, and any ways of unit length.
  void through(const glm::dvec3& place, std::span<const glm::dvec3> ways, std::span<float> shares) const;

  struct State; ///< for the files of this folder
  const State& state() const { return *state_; }

 private:
  std::unique_ptr<const State> state_;
};

/// Sixteen drawn places, and rays from there. One thread at a time.
class SkyPacket {
 public:
  explicit SkyPacket(const TracedSky& sky); ///< which outlives it
  ~SkyPacket();

  void start(const DrawnPlaces& places);

  /// REQUIRES: start.
  const SkyPlaces& places() const { return places_; }

  /// The share of the light that comes along each way past the casters, as they let a light's through, and past media;
  /// 0 where none is asked for. REQUIRES: each way that is asked for leads off the triangle's plane, to the eye's side.
  std::array<float, SkyPlaces::kCount> through(const SkyWays& ways);

 private:
  struct Starts;
  /// Of the lanes whose bits are set, where floats are not sure.
  void traceExactly(const SkyWays& ways, unsigned lanesAsked, std::array<float, SkyPlaces::kCount>& shares) const;

  const TracedSky& sky_;
  SkyPlaces places_;
  std::unique_ptr<Starts> starts_;
};

} // namespace gnomon
