// The only code that calls OpenVDB, which trusts the counts in a file: it runs as a process of its own, so that a
// hostile file ends this one at worst, and within its memory.
#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <new>
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Dense.h>
#include <string>
#include <sys/resource.h>
#include <unistd.h>
#include <utility>
#include <vector>

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
  openvdb::tools::Dense<float, openvdb::tools::LayoutXYZ> dense(box);
  openvdb::tools::copyToDense(grid, dense);
  return writeAll(dense.data(), dense.valueCount() * sizeof(float));
}

bool readVdb(const std::string& name) {
  openvdb::initialize();
  std::ifstream bytes("/proc/self/fd/0", std::ios::binary);
  // OpenVDB itself reads on beyond the end, for as long as the counts in the file say.
  bytes.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
  const auto all = floatGrids(*openvdb::io::Stream(bytes, false).getGrids());
  std::vector<openvdb::FloatGrid::Ptr> named;
  std::copy_if(all.begin(), all.end(), std::back_inserter(named),
               [&](const auto& grid) { return name.empty() || grid->getName() == name; });
  return named.size() == 1 ? writeGrid(*named.front()) : writeNames(all);
}

} // namespace

int main(int argumentCount, char** arguments) {
  boundMemory();
  try {
    return readVdb(argumentCount > 1 ? arguments[1] : "") ? vdb::grid : vdb::broken;
  } catch (const std::bad_alloc&) {
    return vdb::tooLarge;
  } catch (const std::exception&) {
    return vdb::broken;
  }
}
