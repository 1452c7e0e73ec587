#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/spec/frame_spec.h"

/// The lights of a frame, as far as a request and the scene's own lights decide them: what plans, draws and estimates
/// a frame asks here.
namespace gnomon {

/// The request's lights, else the first kLimits.maxLights of the scene's own, else one sun. What they leave open is
/// set: their shadow is the frame's, a tile's size that of the light's type, a sun has azimuth and elevation. A sun by
/// place and time has intensity 0 at night.
/// Then come those of the environment; where that is no studio, there is no other sun by default.
std::vector<Light> lightsOf(const FrameSpec& spec, std::span<const Light> ofScene,
                            std::span<const Light> ofEnvironment = {});

/// Whether the studio is all that lights from all around: no file, sky or light is named.
bool isStudio(const EnvironmentOptions& environment);

/// With its source named: where the request names none, not even the studio, the light `ofScene` that the glTF gives
/// the frame's scene, where it gives one.
EnvironmentOptions withSource(EnvironmentOptions environment, const std::optional<int>& ofScene);

/// What the environment of a frame may add to its lights, before it is read: one sun or none.
std::vector<Light> assumedSun(const EnvironmentOptions& environment);

/// Gives off light: else it has no shadow to be seen.
bool shines(const Light& light);

/// Has a disc, or is a ball: its shadows have penumbras.
bool hasSize(const Light& light);

/// The lights that cast shadows, by their index. REQUIRES: their shadows are set.
std::vector<int> shadowingLights(std::span<const Light> lights, ShadowLightPolicy policy);

/// Of the lights that cast shadows, the ones that get a shadow map: those whose technique reads one, and all of them
/// where a view shows tiles. REQUIRES: no technique is auto any more.
std::vector<int> mappedLights(std::span<const Light> lights, const FrameSpec& spec);

/// The widest half angle of a spot that one tile serves, degrees: at its rim a texel is already four times as large,
/// seen from the light, as in the middle. A wider one takes faces of a cube.
inline constexpr double kWidestTileDegrees = 60;

/// Tiles of a light's shadow map, those included that nothing in view lies in: its cascades, or the faces of a cube
/// that a spot or point light reaches. REQUIRES: its shadow is set.
int tileCount(const Light& light);

/// Texels along a side of one tile, a power of two: min(baseSize * f, nextPowerOfTwo(lightSize * f)), f = size times
/// importance: 2 (XLarge), 1, 1/2, 1/4, 1/8 (XSmall) times 1 (high), 1/2, 1/4 (low). `lightSize`: pixels that the light
/// covers. 0 where it covers none. Counted in integers: log(x) / log(2) misrounds.
int askedTileSize(ShadowSize size, ShadowImportance importance, int baseSize, int lightSize);

/// Samples a pixel of pictures.
int samplesOf(Antialiasing antialiasing);

/// The settings of a light's shadow, as members of `shadow`, that differ from their defaults and that nothing reads:
/// its technique, filter, type or size has no use for them. `mapped`: whether its shadow map is planned or drawn,
/// whatever decides the shadow. REQUIRES: the shadow is set, its technique is not auto.
std::vector<std::string_view> unusedSettings(const Light& light, bool mapped);

/// Where a spec, as it was asked for, names shadow volumes, which only OpenGL draws. JSON Pointers.
inline std::vector<std::string> placesOfShadowVolumes(const FrameSpec& spec) {
  std::vector<std::string> places;
  if (spec.shadow.technique == ShadowTechnique::shadowVolume) places.emplace_back("/shadow/technique");
  if (!spec.lights) return places;
  for (std::size_t i = 0; i < spec.lights->size(); ++i) {
    const std::optional<Shadow>& own = (*spec.lights)[i].shadow;
    if (own && own->technique == ShadowTechnique::shadowVolume) {
      places.push_back("/lights/" + std::to_string(i) + "/shadow/technique");
    }
  }
  return places;
}

} // namespace gnomon
