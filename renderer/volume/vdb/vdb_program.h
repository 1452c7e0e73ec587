#pragma once

#include <array>
#include <cstdint>

/// Between Gnomon and the program gnomon_vdb, which is started with a .vdb file as its standard input and the name of a
/// grid, which may be empty, as its argument. Before it reads it gives up all rights but to compute on that file, and
/// it uses one thread. It writes a Reply and what belongs to it.
namespace gnomon::vdb {

inline constexpr const char* kProgram = "gnomon_vdb";

/// What came of it; also how the program ends, where it ends early.
enum Outcome : std::int32_t {
  grid = 0,        ///< a float for each voxel follows, x fastest; none where there are more than the limits allow
  broken = 10,     ///< not a VDB file, or not a whole one
  noSuchGrid = 11, ///< the names of the float grids follow
  empty = 12,      ///< the grid has no active voxel
  tooLarge = 13,   ///< more memory than it may take
  unsealed = 14    ///< the system refused to take its rights from it, and it has read nothing
};

struct Reply {
  std::int32_t outcome = grid;
  std::int32_t nameBytes = 0;           ///< of noSuchGrid, at most kMaxNameBytes
  std::array<std::int64_t, 3> voxels{}; ///< of a grid, along x, y, z
};

inline constexpr std::int32_t kMaxNameBytes = 400;
inline constexpr unsigned long kMaxMemoryBytes = 2ul << 30;

} // namespace gnomon::vdb
