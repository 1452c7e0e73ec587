// The only code that calls OpenVDB, which trusts the counts in a file: it runs as a process of its own, which gives up
// its rights first, so that a hostile file ends this one at worst, and within its memory.
#include <algorithm>
#include <cstdint>
#include <ext/stdio_filebuf.h>
#include <fstream>
#include <istream>
#include <iterator>
#include <new>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <string>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <tbb/global_control.h>
#include <unistd.h>
#include <utility>
#include <vector>

#include "renderer/core/system_calls.h"
#include "renderer/volume/density_grid.h"
#include "renderer/volume/vdb/vdb_program.h"

namespace {

using namespace gnomon;

void boundMemory() {
  const rlimit memory{vdb::kMaxMemoryBytes, vdb::kMaxMemoryBytes};
  setrlimit(RLIMIT_AS, &memory);
  const rlimit none{0, 0};
  setrlimit(RLIMIT_CORE, &none);
  // Where the machine has less, this process has to go, and no other.
  std::ofstream("/proc/self/oom_score_adj") << 1000;
}

/// From here on it computes, on one thread, and reads and writes the files that it has.
bool seal() {
  const rlimit none{0, 0};
  return setrlimit(RLIMIT_NPROC, &none) == 0 && prctl(PR_SET_DUMPABLE, 0) == 0 && dropPrivileges() == 0 &&
         keepSystemCalls(Duty::compute) == 0;
}

bool writeAll(const void* bytes, std::size_t size) {
  const char* from = static_cast<const char*>(bytes);
  while (size > 0) {
    const ssize_t written = write(STDOUT_FILENO, from, size);
    if (written <= 0) return false;
    from += written;
    size -= static_cast<std::size_t>(written);
  }
  return true;
}

std::vector<openvdb::FloatGrid::Ptr> floatGrids(const openvdb::GridPtrVec& grids) {
  std::vector<openvdb::FloatGrid::Ptr> floats;
  for (const auto& grid : grids) {
    if (auto found = openvdb::gridPtrCast<openvdb::FloatGrid>(grid)) floats.push_back(std::move(found));
  }
  return floats;
}

bool writeNames(const std::vector<openvdb::FloatGrid::Ptr>& grids) {
  std::string text;
  for (const auto& grid : grids) text += (text.empty() ? "" : ", ") + grid->getName();
  text.resize(std::min<std::size_t>(text.size(), vdb::kMaxNameBytes));
  const vdb::Reply reply{vdb::noSuchGrid, static_cast<std::int32_t>(text.size()), {}};
  return writeAll(&reply, sizeof(reply)) && writeAll(text.data(), text.size());
}

bool writeGrid(const openvdb::FloatGrid& grid) {
  const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
  vdb::Reply reply{box.empty() ? vdb::empty : vdb::grid, 0, {}};
  for (int axis = 0; axis < 3; ++axis) {
    reply.voxels[static_cast<std::size_t>(axis)] = std::int64_t{box.max()[axis]} - box.min()[axis] + 1;
  }
  if (!writeAll(&reply, sizeof(reply))) return false;
  const auto [x, y, z] = reply.voxels;
  if (box.empty() || std::max({x, y, z}) > kMaxGridSide || x * y * z > kMaxGridVoxels) return true;
  constexpr std::int64_t kVoxelsAtOnce = 1 << 20;
  const std::int64_t planes = std::max<std::int64_t>(kVoxelsAtOnce / (x * y), 1), last = box.max().z();
  for (std::int64_t low = box.min().z(); low <= last; low += planes) {
    openvdb::CoordBBox slab = box;
    slab.min().z() = static_cast<int>(low);
    slab.max().z() = static_cast<int>(std::min(low + planes - 1, last));
    openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(slab);
    openvdb::tools::copyToDense(grid, dense);
    if (!writeAll(dense.data(), dense.valueCount() * sizeof(float))) return false;
  }
  return true;
}

vdb::Outcome readVdb(const std::string& name) {
  // For as long as the process lives: where that ends, threads are started.
  [[maybe_unused]] static const auto* oneThread =
      new tbb::global_control(tbb::global_control::max_allowed_parallelism, 1);
  openvdb::initialize();
  __gnu_cxx::stdio_filebuf<char> input(STDIN_FILENO, std::ios::in | std::ios::binary);
  std::istream bytes(&input);
  if (!seal()) return vdb::unsealed;
  // OpenVDB itself reads on beyond the end, for as long as the counts in the file say.
  bytes.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  const auto all = floatGrids(*openvdb::io::Stream(bytes, false).getGrids());
  std::vector<openvdb::FloatGrid::Ptr> named;
  std::copy_if(all.begin(), all.end(), std::back_inserter(named),
               [&](const auto& grid) { return name.empty() || grid->getName() == name; });
  return (named.size() == 1 ? writeGrid(*named.front()) : writeNames(all)) ? vdb::grid : vdb::broken;
}

vdb::Outcome outcomeOf(const std::string& name) {
  try {
    return readVdb(name);
  } catch (const std::bad_alloc&) { // of a size that no system has
    return vdb::tooLarge;
  } catch (const std::exception&) {
    return vdb::broken;
  }
}

} // namespace

int main(int argumentCount, char** arguments) {
  boundMemory();
  std::set_new_handler([] { _exit(vdb::tooLarge); });      // libraries let no exception through everywhere
  _exit(outcomeOf(argumentCount > 1 ? arguments[1] : "")); // nothing is left that would have to end in order
}
