#pragma once

#include <gtest/gtest.h>

#include "renderer/cpu/lanes/instruction_set.h"

namespace gnomon::cpu {

/// Runs `check` with each instruction set that the program and this machine have; kernels are chosen anew each time.
template <class Check>
void onEachInstructionSet(const Check& check) {
  const auto targets = instructionSets();
  ASSERT_FALSE(targets.empty());
  for (const auto target : targets) {
    SCOPED_TRACE(hwy::TargetName(target));
    useInstructionSet(target);
    check();
  }
  useInstructionSet(targets.front());
}

} // namespace gnomon::cpu
