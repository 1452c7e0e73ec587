// What the scene hides of an environment.
#if defined(GNOMON_CPU_SKY_SHARE_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_SKY_SHARE_INL_H
#undef GNOMON_CPU_SKY_SHARE_INL_H
#else
#define GNOMON_CPU_SKY_SHARE_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/shadow/shadow_maps.h"
#include "renderer/cpu/surface/fragments-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

/// The share of an environment's light that arrives: rgb of the diffuse light, a of the mirrored. The mean over the
/// samples of each pixel that show the receiver. Lanes outside of `asked` hold anything. REQUIRES: the layer has
/// values.
HWY_INLINE Float4 skyShare(const SkyLayer& layer, const Receiver& receiver, const Mask& asked) {
  const Int pixel = truncated(receiver.place.y) * Int(layer.width) + truncated(receiver.place.x);
  const Int first = select(asked, pixel, Int(0)) * Int(4 * layer.samples);
  Int sums[4]{Int(0), Int(0), Int(0), Int(0)};
  Int count(0);
  for (int i = 0; i < layer.samples; ++i) {
    const Mask shows = (receiver.samples & Int(1 << i)) != Int(0);
    for (int c = 0; c < 4; ++c) {
      sums[c] = select(shows, sums[c] + gather(layer.values, first + Int(4 * i + c)), sums[c]);
    }
    count = select(shows, count + Int(1), count);
  }
  const Float over = 1.0f / (max(toFloat(count), 1.0f) * 65535.0f);
  return {toFloat(sums[0]) * over, toFloat(sums[1]) * over, toFloat(sums[2]) * over, toFloat(sums[3]) * over};
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
