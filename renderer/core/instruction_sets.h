#pragma once

/// Before a function of plain loops: it is compiled for each of these instruction sets, and what the processor has is
/// chosen when the program starts. Its results are the same bits on all of them: nothing is fused (-ffp-contract=off).
/// Not with sanitizers, which are not ready when a clone is chosen.
#if defined(__x86_64__) && defined(__ELF__) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#define GNOMON_FOR_EACH_INSTRUCTION_SET __attribute__((target_clones("avx512f", "avx2", "default")))
#else
#define GNOMON_FOR_EACH_INSTRUCTION_SET
#endif
