#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "tests/renderer/cpu/surface/sampling_kernels.cpp" // NOLINT: included again for each instruction set
#include "tests/renderer/cpu/surface/sampling_kernels.h"

#include <hwy/foreach_target.h>

#include "renderer/cpu/surface/sampling-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

void sampleRows(const Texture& texture, const TextureUse& use, const NumberTable& in, NumberTable& out) {
  for (std::size_t row = 0; row < in.rows; row += kLanes) {
    const auto pair = [&](std::size_t column)
                          HWY_ATTR { return Float2(load(in.column(column) + row), load(in.column(column + 1) + row)); };
    const TextureSpot spot{pair(0), pair(2), pair(4)};
    Taps taps;
    findTaps(texture, use, spot, maskOf(0xffffu), taps);
    const Texel texel = sampled<kAllChannels>(texture, taps);
    store(texel.rgb.x, out.column(0) + row);
    store(texel.rgb.y, out.column(1) + row);
    store(texel.rgb.z, out.column(2) + row);
    store(texel.a, out.column(3) + row);
    store(sampled<kAlpha>(texture, taps).a, out.column(4) + row);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(sampleRows);

NumberTable sampledByLanes(const Texture& texture, const TextureUse& use, const NumberTable& in) {
  NumberTable out(in.rows, 5);
  GNOMON_KERNEL(sampleRows)(texture, use, in, out);
  return out;
}

} // namespace gnomon::cpu
#endif
