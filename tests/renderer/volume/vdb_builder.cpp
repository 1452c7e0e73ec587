#include "tests/renderer/volume/vdb_builder.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#include <sstream>

namespace gnomon {
namespace {

template <class Grid>
openvdb::GridBase::Ptr built(const VdbGrid& from) {
  const auto grid = Grid::create(from.background);
  grid->setName(from.name);
  auto voxels = grid->getAccessor();
  for (const auto& [place, value] : from.voxels) voxels.setValue({place[0], place[1], place[2]}, value);
  return grid;
}

} // namespace

std::string vdbFile(const std::vector<VdbGrid>& grids) {
  openvdb::initialize();
  openvdb::GridPtrVec pointers;
  for (const VdbGrid& grid : grids) {
    pointers.push_back(grid.isFloat ? built<openvdb::FloatGrid>(grid) : built<openvdb::DoubleGrid>(grid));
  }
  std::ostringstream file;
  openvdb::io::Stream(file).write(pointers);
  return file.str();
}

} // namespace gnomon
