#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "protocol/report/replies.h"
#include "protocol/spec/frame_spec.h"

/// The work of a frame, estimated before it is drawn, from the request and counts of the scene alone: nanoseconds that
/// it takes about on two cores without a GPU.
namespace gnomon {

/// What a scene brings to each of its frames.
struct SceneCounts {
  std::uint64_t triangles = 0;           ///< of the default glTF scene
  std::vector<LightType> lights{};       ///< the scene's own; they count where a request names none
  std::uint64_t holed = 0;               ///< triangles whose materials have holes, or let light through
  double voxels = 262'144;               ///< of a volume, about: of floats, as large as its files are on average
  std::optional<int> environmentLight{}; ///< the image-based light that the glTF gives the scene
};

/// What draws, as far as costs differ.
enum class DeviceKind { processor, softwareGl, gpu };
DeviceKind kindOf(const RendererInfo& info);

double pixelsOf(const FrameSpec& spec);

/// The frame's lights, the technique of each chosen where it was left open.
std::vector<Light> settledLights(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device);

/// Texels of all tiles of `light`, as if it showed in all of the picture: as many as there can be.
double tileTexels(const Light& light, const FrameSpec& spec);

/// Of drawing all tiles of `light` as if it showed in all of the picture.
double tileCost(const Light& light, const FrameSpec& spec, std::uint64_t triangles);
/// Of reading a map for one pixel.
double lookupOfPixel(const Filter& filter);
/// Of finding a light's shadow by rays in every pixel.
double rayCost(const Light& light, const FrameSpec& spec, const SceneCounts& scene);

/// What technique auto is for a light: rays where they cost at most kRaysPerMap times the map. A pure function, so that
/// the same request gives the same frame; neither the camera nor a clock has a part in it, so that a sequence keeps one
/// technique. Filters and biases belong to maps: a light that sets one gets a map. REQUIRES: the light's shadow is set.
TechniqueChoice chooseTechnique(const Light& light, const FrameSpec& spec, const SceneCounts& scene, DeviceKind device);

inline constexpr double kRaysPerMap = 2;

SceneCounts sceneCounts(const SceneSummary& summary);

/// Where a frame spends its time: the stages of a report, those that belong together as one. What `shade` of a report
/// takes to find shadows sample by sample (passes `visibility` and `sky`) is a part of its own here.
enum class FramePart { fixed, bake, volume, survey, shadow, visibility, shade, predict, reference, readback, encode };

inline constexpr std::size_t kFrameParts = static_cast<std::size_t>(FramePart::encode) + 1;

/// Work by part, in nanoseconds that it takes about on two cores without a GPU: a unit that other machines are
/// proportional to, part by part. 0 = the frame has no such part.
struct FrameCost {
  std::array<double, kFrameParts> parts{};

  double& operator[](FramePart part) { return parts[static_cast<std::size_t>(part)]; }
  double operator[](FramePart part) const { return parts[static_cast<std::size_t>(part)]; }
};

/// Of a frame that finds nothing of earlier ones: every tile is drawn, every light map baked. What the camera sees is
/// not known, so that it counts as if surfaces filled the picture, lit by every light. Grows with each of: pixels,
/// samples, views, lights, rays, texels, triangles, voxels. `device`: what technique auto chooses for. REQUIRES: `spec`
/// has passed protocol/validate.
FrameCost frameCost(const FrameSpec& spec, const SceneCounts& scene, DeviceKind device = DeviceKind::processor);

} // namespace gnomon
