// Sixteen places of the picture and the triangle that each shows: what surfaces, shadows and pictures are made of.
#if defined(GNOMON_CPU_FRAGMENTS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_FRAGMENTS_INL_H
#undef GNOMON_CPU_FRAGMENTS_INL_H
#else
#define GNOMON_CPU_FRAGMENTS_INL_H
#endif

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
};

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
