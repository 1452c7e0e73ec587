#pragma once

#include <cstdint>
#include <hwy/targets.h>
#include <vector>

/// Which of the instruction sets that kernels are compiled for runs them. Highway would choose, but its shared library
/// measures the processor's clock whenever a program starts: four thousandths of a second before anything is drawn.
namespace gnomon::cpu {

/// Those that kernels are compiled for and that this processor knows, as Highway's HWY_TARGETS has them; the best one
/// first. None where it lacks what all of them are made of.
std::vector<std::int64_t> instructionSets();

/// The one that runs kernels, for the whole process: the best one until another is asked for. REQUIRES: there is one.
hwy::ChosenTarget& chosenInstructionSet();

/// REQUIRES: one of instructionSets(), and that no kernel runs.
void useInstructionSet(std::int64_t set);

} // namespace gnomon::cpu

/// After the last of a kernel's versions, in the namespace around them all: what GNOMON_KERNEL(name) calls.
/// (As HWY_EXPORT, whose table begins with what chooses when it is first called.)
#if HWY_IDE || ((HWY_TARGETS & (HWY_TARGETS - 1)) == 0)
#define GNOMON_EXPORT_KERNEL(name) static constexpr auto* name##Kernel = &HWY_STATIC_DISPATCH(name)
#define GNOMON_KERNEL(name) (*name##Kernel)
#else
#define GNOMON_EXPORT_KERNEL(name)                                                                     \
  static constexpr decltype(&HWY_STATIC_DISPATCH(name)) name##Kernels[HWY_MAX_DYNAMIC_TARGETS + 2] = { \
      nullptr, HWY_CHOOSE_TARGET_LIST(name), HWY_CHOOSE_FALLBACK(name)}
#define GNOMON_KERNEL(name) (*name##Kernels[gnomon::cpu::chosenInstructionSet().GetIndex()])
#endif
