#include "renderer/core/parallel.h"

#include <algorithm>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "renderer/core/cpu_quota.h"

namespace gnomon {

void onAllCores(const std::function<void()>& task) {
  static tbb::task_arena arena(coresToUse());
  arena.execute([&] { task(); });
}

void forEachPiece(std::size_t count, std::size_t size, const std::function<void(std::size_t, std::size_t)>& each) {
  const std::size_t pieces = (count + size - 1) / size;
  if (pieces == 0) return;
  if (pieces == 1) {
    each(0, count);
    return;
  }
  onAllCores([&] {
    tbb::parallel_for(std::size_t{0}, pieces,
                      [&](std::size_t piece) { each(piece * size, std::min(count, (piece + 1) * size)); });
  });
}

void forEach(std::size_t count, const std::function<void(std::size_t)>& each) {
  forEachPiece(count, 1, [&](std::size_t i, std::size_t) { each(i); });
}

} // namespace gnomon
