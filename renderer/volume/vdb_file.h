#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/volume/density_grid.h"

namespace gnomon {

inline constexpr std::chrono::seconds kVdbDeadline{60};

/// Whether a grid may have this name: no control characters, and at most 1020 bytes, 255 characters. Empty = the only
/// float grid.
bool isGridName(std::string_view name);

/// Where the program that calls OpenVDB may lie: beside the executable, then in ../lib/gnomon from there.
std::vector<std::filesystem::path> vdbProgramPaths(const std::filesystem::path& executable);

/// The one that belongs to this program; nothing where there is none.
std::optional<std::filesystem::path> ownVdbProgram();

/// The program at work; it is ended, and waited for, with this.
class VdbProcess {
 public:
  virtual ~VdbProcess() = default;

  /// How it ended, as of waitpid(2). Once.
  virtual int wait() = 0;
};

/// Starts the program with a grid's name as argument, `input` as stdin, `output` as stdout, and no other file. nullptr
/// on failure. Any thread.
using StartVdb = std::function<std::unique_ptr<VdbProcess>(const std::string& name, int input, int output)>;

/// By a child of this process: the first of `programs` that exists.
StartVdb vdbAsChild(std::vector<std::filesystem::path> programs);

/// How the program is started from now on; call it before grids are read.
void startVdbBy(StartVdb start);

/// A float grid of an OpenVDB file: the box of its active voxels, with the background elsewhere. `name`: of the grid;
/// empty = the only float grid. Read by what `start` starts, within bounds of memory and time. Any thread.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name, const StartVdb& start,
                            std::chrono::milliseconds deadline = kVdbDeadline);

/// By a child of this process, or as startVdbBy was given.
Result<DensityGrid> readVdb(std::span<const std::uint8_t> file, const std::string& name = {});

} // namespace gnomon
