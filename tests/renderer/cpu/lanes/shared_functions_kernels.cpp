#include "tests/renderer/cpu/lanes/shared_functions_kernels.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/renderer/cpu/lanes/shared_functions_kernels.cpp"
#include <hwy/foreach_target.h>

#include "renderer/cpu/lanes/shared_functions-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {
namespace {

#include "tests/renderer/cpu/lanes/shared_functions_cases.h"

struct Columns {
  const float* first;
  std::size_t rows;

  Float one(std::size_t column) const { return load(first + column * rows); }
  Float3 three(std::size_t column) const { return {one(column), one(column + 1), one(column + 2)}; }
};

template <class Case>
void runCase(std::size_t rows, const float* in, float* out) {
  for (std::size_t row = 0; row < rows; row += kLanes) {
    const Float3 result = Case::of(Columns{in + row, rows});
    store(result.x, out + row);
    store(result.y, out + rows + row);
    store(result.z, out + 2 * rows + row);
  }
}

template <class... Cases>
struct List {
  static void run(std::size_t which, std::size_t rows, const float* in, float* out) {
    using Run = void (*)(std::size_t, const float*, float*);
    constexpr Run runs[] = {&runCase<Cases>...};
    runs[which](rows, in, out);
  }
};

} // namespace

void sharedFunction(std::size_t which, std::size_t rows, const float* in, float* out) {
  List<GNOMON_SHARED_FUNCTION_CASES>::run(which, rows, in, out);
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace gnomon::cpu {

GNOMON_EXPORT_KERNEL(sharedFunction);

void sharedFunctionByLanes(std::size_t which, std::size_t rows, const float* in, float* out) {
  GNOMON_KERNEL(sharedFunction)(which, rows, in, out);
}

} // namespace gnomon::cpu
#endif
