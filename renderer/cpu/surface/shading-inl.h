// The light of surfaces on its way to the eye: linear radiance.
#if defined(GNOMON_CPU_SHADING_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SHADING_INL_H
#undef GNOMON_CPU_SHADING_INL_H
#else
#define GNOMON_CPU_SHADING_INL_H
#endif

#include <span>

#include "renderer/cpu/shadow/sky_share-inl.h"
#include "renderer/cpu/surface/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The lights of a frame.
struct Lighting {
  std::span<const LightData> lights;
  std::span<const std::uint32_t> lists; ///< lightLists; empty = every light may reach every pixel
  SkyLayer sky{};
};

HWY_INLINE SurfacePoint pointOf(const Surface& surface) {
  return surfacePoint(surface.baseColor, surface.metallic, surface.roughness, surface.normal, surface.toEye);
}

/// As environmentReflected has it. By itself, so that frames in the studio keep their registers.
inline HWY_NOINLINE Float3 reflectedEnvironment(const FrameScene& scene, const Surface& surface,
                                                const SurfacePoint& point, const Float4& arriving) {
  const Float3 reflected =
      environmentReflected(scene.environment, Float2(scene.frame.environmentTurn), point, surface.baseColor,
                           surface.metallic, surface.roughness, surface.receiver.normal, arriving);
  return reflected * scene.frame.environmentIntensity;
}

/// What surfaces show of the surroundings. `arriving`: what the scene leaves of their light.
HWY_INLINE Float3 reflectedSurroundings(const FrameScene& scene, const Surface& surface, const SurfacePoint& point,
                                        const Float4& arriving) {
  if (scene.environment == nullptr) {
    return Float3(scene.frame.ambient) * studioReflected(Float2(scene.frame.environmentTurn), scene.frame.studioLamps,
                                                         point, surface.baseColor, surface.metallic, surface.roughness,
                                                         surface.receiver.normal, arriving);
  }
  return reflectedEnvironment(scene, surface, point, arriving);
}

/// What one light adds to the lanes `asked`, all of which show a surface. `visibility(light, receiver, toLight,
/// where)`: the share of it that arrives, 0..1, asked for the lanes `where`, of which it reflects something; in the
/// others it may be any number.
template <class Visibility>
HWY_INLINE Float3 radianceFrom(const Lighting& lighting, std::uint32_t light, const SurfacePoint& point,
                               const Receiver& receiver, const Mask& asked, const Visibility& visibility) {
  const LightData& data = lighting.lights[light];
  const Int lit = receiver.groupBit & Int(static_cast<std::int32_t>(data.litGroups));
  const Mask reached = asked & (lit != Int(0));
  if (none(reached)) return Float3(0.0f);
  Float3 toLight;
  const Float3 arriving = irradiance(data, receiver.relative, toLight);
  const Float3 reflected = reflectedRadiance(point, toLight) * arriving;
  const Mask lights = reached & ((reflected.x != 0.0f) | (reflected.y != 0.0f) | (reflected.z != 0.0f));
  if (none(lights)) return Float3(0.0f);
  const Float arrives = visibility(light, receiver, toLight, lights);
  if (data.hasShadowColor == 0u) return select(lights, reflected * arrives, Float3(0.0f));
  const Float3 left = Float3(data.shadowColor) * (1.0f - arrives) + Float3(arrives);
  return select(lights, reflected * left, Float3(0.0f));
}

/// Calls each(light, where) for the lights that may reach the lanes `lit`, and those of them that each may reach.
template <class Each>
HWY_INLINE void forEachLight(const FrameScene& scene, const Lighting& lighting, const Fragments& fragments,
                             const Mask& lit, const Each& each) {
  if (lighting.lists.empty()) {
    for (std::uint32_t k = 0; k < lighting.lights.size(); ++k) each(k, lit);
    return;
  }
  // Squares count from the top of the picture, so that a packet may lie in two of them, or in four.
  const auto columns = static_cast<std::size_t>((scene.width + GNOMON_REGION_SIZE - 1) / GNOMON_REGION_SIZE);
  static_assert(GNOMON_REGION_SIZE == 1 << 6);
  const Int square = shiftRight<6>(Int(scene.height - 1) - fragments.y) * Int(static_cast<std::int32_t>(columns)) +
                     shiftRight<6>(fragments.x);
  alignas(64) std::int32_t squares[kLanes];
  store(square, squares);
  for (unsigned left = bitsOf(lit); left != 0;) {
    const std::int32_t own = squares[__builtin_ctz(left)];
    const Mask where = lit & (square == Int(own));
    const auto list = static_cast<std::size_t>(own);
    for (std::uint32_t k = lighting.lists[2 * list]; k < lighting.lists[2 * list + 1]; ++k) {
      each(lighting.lists[k], where);
    }
    left &= ~bitsOf(where);
  }
}

/// Of lanes that show a surface.
template <class Visibility>
HWY_INLINE Float3 radianceToEye(const FrameScene& scene, const Lighting& lighting, const Fragments& fragments,
                                const Surface& surface, const Visibility& visibility) {
  const Mask lit = andNot(surface.unlit, fragments.shown);
  if (none(lit)) return surface.emission;
  const SurfacePoint point = pointOf(surface);
  const Float4 arriving =
      lighting.sky.values != nullptr ? skyShare(lighting.sky, surface.receiver, lit) : Float4(1.0f, 1.0f, 1.0f, 1.0f);
  Float3 sum = surface.emission + reflectedSurroundings(scene, surface, point, arriving) * surface.occlusion;
  const auto add = [&](std::uint32_t light, const Mask& where)
                       HWY_ATTR { sum += radianceFrom(lighting, light, point, surface.receiver, where, visibility); };
  forEachLight(scene, lighting, fragments, lit, add);
  return select(surface.unlit, surface.emission, sum);
}

/// What one light brings to the lanes `asked`, all of which catch shadows; `visibility` as in radianceFrom.
template <class Visibility>
HWY_INLINE CaughtLight caughtOf(const Lighting& lighting, std::uint32_t light, const Surface& surface,
                                const Mask& asked, const Visibility& visibility) {
  const LightData& data = lighting.lights[light];
  const Int lit = surface.receiver.groupBit & Int(static_cast<std::int32_t>(data.litGroups));
  Float3 toLight;
  const Float3 arriving = irradiance(data, surface.receiver.relative, toLight);
  const Mask arrives = (arriving.x != 0.0f) | (arriving.y != 0.0f) | (arriving.z != 0.0f);
  const Mask lights = asked & (lit != Int(0)) & arrives & (dot(surface.normal, toLight) > 0.0f);
  if (none(lights)) return caughtLight(0.0f, 0.0f);
  const Float share = visibility(light, surface.receiver, toLight, lights);
  const Float3 left = Float3(data.shadowColor) * (1.0f - share) + Float3(share);
  const CaughtLight caught = caughtFrom(surface.normal, toLight, arriving, left);
  return caughtLight(select(lights, caught.all, Float(0.0f)), select(lights, caught.lost, Float(0.0f)));
}

/// What arrives at lanes that catch shadows.
template <class Visibility>
HWY_INLINE CaughtLight caughtHere(const FrameScene& scene, const Lighting& lighting, const Fragments& fragments,
                                  const Surface& surface, const Mask& asked, const Visibility& visibility) {
  const Float4 open =
      lighting.sky.values != nullptr ? skyShare(lighting.sky, surface.receiver, asked) : Float4(1.0f, 1.0f, 1.0f, 1.0f);
  CaughtLight sum = caughtAround(irradianceOfSurroundings(scene, surface.normal), Float3(open.x, open.y, open.z));
  const auto add = [&](std::uint32_t light, const Mask& where) HWY_ATTR {
    const CaughtLight one = caughtOf(lighting, light, surface, where, visibility);
    sum.all += one.all;
    sum.lost += one.lost;
  };
  forEachLight(scene, lighting, fragments, asked, add);
  return sum;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
