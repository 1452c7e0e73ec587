#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE \
  "tests/renderer/cpu/surface/surface_kernels.cpp" // NOLINT: included again for each instruction set
#include "tests/renderer/cpu/surface/surface_kernels.h"

#include <hwy/foreach_target.h>

#include "renderer/cpu/surface/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {
namespace {

HWY_INLINE Fragments fragmentsAt(const FragmentInput& in, std::size_t row) {
  Fragments f;
  f.triangle = load(in.triangles.data() + row);
  f.shown = f.triangle != Int(-1);
  f.place = {load(in.x.data() + row), load(in.y.data() + row)};
  f.center = f.place;
  f.x = truncated(f.place.x);
  f.y = truncated(f.place.y);
  return f;
}

HWY_INLINE void store3(const Float3& v, std::size_t first, std::size_t row, NumberTable& out) {
  store(v.x, out.column(first) + row);
  store(v.y, out.column(first + 1) + row);
  store(v.z, out.column(first + 2) + row);
}

} // namespace

void surfaces(const FrameScene& scene, const FragmentInput& in, NumberTable& out) {
  for (std::size_t row = 0; row < out.rows; row += kLanes) {
    const Fragments fragments = fragmentsAt(in, row);
    if (none(fragments.shown)) continue;
    const Surface s = surfaceOf(scene, in.textures, fragments);
    store3(s.receiver.relative, kRelative, row, out);
    store3(s.receiver.normal, kFace, row, out);
    store3(s.normal, kNormal, row, out);
    store3(s.baseColor, kBaseColor, row, out);
    store3(s.emission, kEmission, row, out);
    store(s.receiver.viewDepth, out.column(kViewDepth) + row);
    store(s.metallic, out.column(kMetallic) + row);
    store(s.roughness, out.column(kRoughness) + row);
    store(s.occlusion, out.column(kOcclusion) + row);
    store(select(s.unlit, Float(1.0f), Float(0.0f)), out.column(kUnlit) + row);
    store(toFloat(s.receiver.groupBit), out.column(kGroupBit) + row);
  }
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(surfaces);

NumberTable surfacesByLanes(const FrameScene& scene, const FragmentInput& in) {
  NumberTable out(in.triangles.size(), kSurfaceNumbers);
  GNOMON_KERNEL(surfaces)(scene, in, out);
  return out;
}

} // namespace gnomon::cpu
#endif
