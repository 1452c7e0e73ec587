#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "renderer/volume/density_grid.h"

namespace gnomon {

/// A grid from a NumPy or an OpenVDB file; its first bytes say which it is. `name`: the grid's in a file of several,
/// empty = the only float grid; a NumPy file has one without a name, so that any other is a problem.
Result<DensityGrid> readGridFile(std::span<const std::uint8_t> file, const std::string& name = {});

} // namespace gnomon
