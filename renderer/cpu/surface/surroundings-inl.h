// The light around the scene: of an environment, or the studio.
#if defined(GNOMON_CPU_SURROUNDINGS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SURROUNDINGS_INL_H
#undef GNOMON_CPU_SURROUNDINGS_INL_H
#else
#define GNOMON_CPU_SURROUNDINGS_INL_H
#endif

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/lanes/shared_functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// By itself, so that frames in the studio keep their registers.
inline HWY_NOINLINE Float3 radianceOfEnvironment(const FrameScene& scene, const Float3& direction,
                                                 const Float& roughness) {
  const Float3 towards = inEnvironment(direction, Float2(scene.frame.environmentTurn));
  return environmentRadiance(scene.environment, towards, roughness) * scene.frame.environmentIntensity;
}

/// Their radiance from world directions. `roughness`: perceptual, of the surface that shows it.
HWY_INLINE Float3 radianceOfSurroundings(const FrameScene& scene, const Float3& direction, const Float& roughness) {
  if (scene.environment == nullptr) {
    return Float3(scene.frame.ambient) *
           radianceOfStudio(direction, Float2(scene.frame.environmentTurn), scene.frame.studioLamps, roughness);
  }
  return radianceOfEnvironment(scene, direction, roughness);
}

/// Their irradiance over pi on what faces a world direction.
HWY_INLINE Float3 irradianceOfSurroundings(const FrameScene& scene, const Float3& normal) {
  if (scene.environment == nullptr) {
    return Float3(scene.frame.ambient) *
           irradianceOfStudio(normal, Float2(scene.frame.environmentTurn), scene.frame.studioLamps);
  }
  const Float3 towards = inEnvironment(normal, Float2(scene.frame.environmentTurn));
  return environmentIrradiance(scene.environment, towards) * scene.frame.environmentIntensity;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
