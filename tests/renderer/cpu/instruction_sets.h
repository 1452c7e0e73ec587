#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

namespace gnomon::cpu {

/// Runs `check` with each instruction set that the program and this machine have; kernels are chosen anew each time.
template <class Check>
void onEachInstructionSet(const Check& check) {
  const auto targets = hwy::SupportedAndGeneratedTargets();
  ASSERT_FALSE(targets.empty());
  for (const auto target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    hwy::SetSupportedTargetsForTest(target);
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
}

} // namespace gnomon::cpu
