#pragma once

#include <cstdint>
#include <hwy/detect_targets.h>
#include <hwy/targets.h>

namespace gnomon::cpu {

/// Calls `each(name)` once for every instruction set that this processor has and kernels are compiled for, with kernels
/// pinned to it.
template <class Each>
void onEachTarget(const Each& each) {
  hwy::SetSupportedTargetsForTest(0);
  for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
    const std::int64_t target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    each(hwy::TargetName(target));
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace gnomon::cpu
