#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "renderer/volume/density_grid.h"

namespace gnomon {

inline constexpr std::chrono::seconds kVdbDeadline{60};

/// Where the program that calls OpenVDB may lie: beside the executable, then in ../lib/gnomon from there.
std::vector<std::filesystem::path> vdbProgramPaths(const std::filesystem::path& executable);

/// A float grid of an OpenVDB file: the box of its active voxels, with the background's value where there is none.
/// `name`: that of the grid; empty = the only float grid. The first of `programs` that exists reads it, as a process of
/// its own, whose memory and time are bounded. Safe from any thread.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name,
                            std::span<const std::filesystem::path> programs,
                            std::chrono::milliseconds deadline = kVdbDeadline);

/// By the program that belongs to this one.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name = {});

} // namespace gnomon
