#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "protocol/spec/scene_options.h"
#include "renderer/core/camera_view.h"
#include "renderer/scene/node_switches.h"
#include "renderer/shadow/filter_kernel.h"
#include "renderer/shadow/shadow_plan.h"

namespace gnomon {

/// A manual bias, metres.
struct ManualBias {
  double depth = 0;        ///< towards the light
  double slope = 0;        ///< the same, to be multiplied by the tangent of the angle between normal and light
  double normalOffset = 0; ///< along the normal
};

/// A light as it lights one frame, with what was planned for its shadow. Devices pack it as they need it.
struct LitLight {
  LightType type = LightType::directional;
  glm::dvec3 direction{0, -1, 0}; ///< along which it shines, unit length; of no meaning for a point light
  glm::dvec3 position{0};         ///< spot and point: relative to the eye, metres
  double range = 0;               ///< metres; 0 = infinite
  glm::dvec3 radiance{0};         ///< color times intensity: lux (directional) or candela, linear RGB
  double innerCone = 0;           ///< spot: radians from the axis to where the falloff begins
  double outerCone = 0;           ///< spot: radians from the axis to where it ends
  double strength = 0;            ///< of its shadow, 0..1; 0 = casts none
  glm::dvec3 shadowColor{0};      ///< what share of the light a full shadow of strength 1 leaves
  LitGroups groups;               ///< the receiver groups that it lights, and casts shadows onto

  // Its shadow map. Without tiles the rest has no meaning.
  int firstTile = 0; ///< of the plan
  int tileCount = 0; ///< cascades or faces; 0 = no map
  FilterKernel filter;
  std::optional<ManualBias> manualBias; ///< none = each tile's automatic one
  bool fadesOut = false;                ///< at the far end of its last cascade
  bool smoothTerminator = false;        ///< receivers may be on the surface that shading shows

  // Its visibility layer.
  int visibilityLayer = -1;           ///< index among the lights that have one; -1 = none
  bool layerOmitsTurnedFaces = false; ///< the layer is lit where a face is turned away from the light
};

/// The frame's lights, in their order. `plan` says which have tiles; `groups`: what each does to the receiver groups,
/// none = every light lights and shadows all; `layered`: lights that visibility layers serve, one a layer.
std::vector<LitLight> litLights(std::span<const Light> lights, const ShadowPlan& plan, const glm::dvec3& eye,
                                std::span<const LitGroups> groups = {}, std::span<const int> layered = {});

/// The lights at full strength: where they cast a shadow, it is the share of the light that is kept away.
std::vector<LitLight> atFullStrength(std::vector<LitLight> lights);

/// Frames with more lights than this are lit by lists; fewer are all tried at every pixel, which is faster then.
inline constexpr std::size_t kLightsWithoutLists = 4;

/// Pixels along a side of the squares of the picture that have a list of lights each; whole blocks of the survey.
inline constexpr int kLightListSquare = 64;

/// For each square of the picture, row by row from the TOP, where its list begins and ends; then the lists: the lights
/// that may reach a surface in the square, in the order of `lights`. Never leaves one out that does.
std::vector<std::uint32_t> lightLists(const CameraView& view, const ReceiverDepths& receivers,
                                      std::span<const LitLight> lights);

} // namespace gnomon
