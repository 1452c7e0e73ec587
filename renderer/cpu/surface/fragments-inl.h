// Sixteen places of the picture and the triangle that each shows: what surfaces, shadows and pictures are made of.
#if defined(GNOMON_CPU_FRAGMENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_FRAGMENTS_INL_H
#undef GNOMON_CPU_FRAGMENTS_INL_H
#else
#define GNOMON_CPU_FRAGMENTS_INL_H
#endif

#include "renderer/cpu/frame_scene.h"
#include "renderer/cpu/lanes/vectors-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

struct Fragments {
  Mask shown;    ///< lanes that show a surface; the others' numbers mean nothing
  Int triangle;  ///< FrameScene's number
  Int x, y;      ///< pixel; y from the BOTTOM of the picture
  Float2 center; ///< where the material is read, pixels: the pixel's middle
  Float2 place;  ///< where light is asked for, pixels: the mean of the samples that show it
};

/// The lanes that show one instance.
struct OfInstance {
  std::uint32_t instance;
  Mask lanes;
  Int triangle; ///< of the instance's primitive; the other lanes hold one of these
};

/// What the lowest of the lanes `left`, a bit each, shows. REQUIRES: these are some of those that show a surface.
HWY_INLINE OfInstance instanceShown(const FrameScene& scene, const Fragments& fragments, unsigned left) {
  static_assert(kClusterTriangles == 1 << 10);
  alignas(64) std::int32_t triangles[kLanes];
  store(fragments.triangle, triangles);
  const std::int32_t triangle = triangles[__builtin_ctz(left)];
  OfInstance of;
  of.instance = scene.slots[static_cast<std::uint32_t>(triangle) >> 10].instance;
  const auto begin = static_cast<std::int32_t>(scene.geometry.firstSlot[of.instance]);
  const auto end = static_cast<std::int32_t>(scene.geometry.firstSlot[of.instance + 1]);
  const Int slot = shiftRightUnsigned<10>(fragments.triangle);
  of.lanes = fragments.shown & (slot >= Int(begin)) & (slot < Int(end));
  of.triangle = select(of.lanes, fragments.triangle, Int(triangle)) - shiftLeft<10>(Int(begin));
  return of;
}

/// The place of the curved surface that shading shows where a triangle bends outwards.
struct SmoothPlace {
  Mask bends;    ///< lanes that have one; the others hold anything
  Float3 normal; ///< unit length, on the eye's side
  Float height;  ///< over the triangle, along that, metres
  Mask lifted;   ///< lanes whose receivers stand there: as shadedReceiver gives them
};

HWY_INLINE SmoothPlace noSmoothPlace() {
  return {maskOf(0), Float3(Float(0.0f)), 0.0f, maskOf(0)};
}

/// A point that light is asked for.
struct Receiver {
  Mask shown;
  Float3 relative; ///< to the eye, metres
  Float3 normal;   ///< of the triangle, on the eye's side, unit length
  Float viewDepth; ///< metres
  Int groupBit;    ///< 1 << receiver group
  Float2 place;    ///< pixels, as Fragments::place
  Int samples;     ///< of the pixel that show it, a bit each; 1 where a pixel has one
  Int triangle;    ///< that it lies in, FrameScene's number; -1 = it is not known
  Float2 weights;  ///< of that triangle's second and third corner
  SmoothPlace smooth;
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
