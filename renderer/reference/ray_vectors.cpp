#include "renderer/reference/ray_vectors.h"

#include <atomic>

namespace gnomon {
namespace {

std::atomic<RayVectors> used = RayVectors::widest;

} // namespace

void useRayVectors(RayVectors vectors) {
  used = vectors;
}

const char* rayDeviceOptions() {
  switch (used) {
    case RayVectors::widest:
      break;
    case RayVectors::avx2:
      return "set_affinity=0,max_isa=avx2";
    case RayVectors::sse4:
      return "set_affinity=0,max_isa=sse4.2";
  }
  return "set_affinity=0";
}

} // namespace gnomon
