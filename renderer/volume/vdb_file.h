#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "renderer/volume/density_grid.h"

namespace gnomon {

inline constexpr std::chrono::seconds kVdbDeadline{60};

/// Where the program that calls OpenVDB may lie: beside the executable, then in ../lib/gnomon from there.
std::vector<std::filesystem::path> vdbProgramPaths(const std::filesystem::path& executable);

/// The program at work; it is ended, and waited for, with this.
class VdbProcess {
 public:
  virtual ~VdbProcess() = default;

  /// How it ended, as of waitpid(2). Once.
  virtual int wait() = 0;
};

using VdbPrograms = std::span<const std::filesystem::path>;

/// Starts the first of `programs` that exists with a grid's name as argument, `input` as stdin, `output` as stdout, and
/// no other file. nullptr on failure. Any thread.
using StartVdb =
    std::function<std::unique_ptr<VdbProcess>(VdbPrograms programs, const std::string& name, int input, int output)>;

/// By a child of this process.
std::unique_ptr<VdbProcess> startVdbAsChild(VdbPrograms programs, const std::string& name, int input, int output);

/// How the program is started from now on; call it before the process gives up files and children, and before grids are
/// read.
void startVdbBy(StartVdb start);

/// A float grid of an OpenVDB file: the box of its active voxels, with the background elsewhere. `name`: of the grid;
/// empty = the only float grid. Read by the first of `programs` that exists, within bounds of memory and time. Any
/// thread.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name, VdbPrograms programs,
                            std::chrono::milliseconds deadline = kVdbDeadline);

/// By the program that belongs to this one.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name = {});

} // namespace gnomon
