#include "renderer/cpu/lanes/instruction_set.h"

#include <algorithm>
#include <hwy/detect_targets.h>

namespace gnomon::cpu {
namespace {

/// From the best one on.
std::vector<std::int64_t> known() {
#if defined(__x86_64__)
  __builtin_cpu_init();
  const bool sse4 =
      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul");
  // Whatever knows BMI2 and FMA knows LZCNT and F16C, which Highway's AVX2 is made of, too.
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw") &&
                      __builtin_cpu_supports("avx512cd");
  std::vector<std::int64_t> sets;
  if (avx512) sets.push_back(HWY_AVX3);
  if (avx2) sets.push_back(HWY_AVX2);
  if (sse4) sets.push_back(HWY_SSE4);
  return sets;
#else
  return {HWY_STATIC_TARGET};
#endif
}

} // namespace

std::vector<std::int64_t> instructionSets() {
  std::vector<std::int64_t> sets = known();
  std::erase_if(sets, [](std::int64_t set) { return (set & HWY_TARGETS) == 0; });
  return sets;
}

hwy::ChosenTarget& chosenInstructionSet() {
  struct Best : hwy::ChosenTarget {
    Best() { Update(instructionSets().front()); }
  };
  static Best chosen;
  return chosen;
}

void useInstructionSet(std::int64_t set) {
  chosenInstructionSet().Update(set);
}

} // namespace gnomon::cpu
