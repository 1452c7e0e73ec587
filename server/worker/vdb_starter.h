#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>

#include "renderer/render.h"
#include "server/wire/channel.h"

namespace gnomon {

/// A process that starts the reader of VDB files (gnomon_vdb) for a worker, which may start none once it is sealed. It
/// is sealed, too, knows its program before it takes a message, and takes from one nothing but a grid's name, the file,
/// and where the voxels go. One reader at a time; each ends with its caller, and all of it with the worker.
class VdbStarter {
 public:
  struct Options {
    std::optional<std::filesystem::path> program; ///< nothing = every reader ends as where it can't be executed
    std::uint64_t readerBytes = 0;                ///< what a reader may allocate; 0 = what it allows itself
  };

  /// Call it before starting threads: it forks. nullptr where the system refused.
  static std::unique_ptr<VdbStarter> start(const Options& options);

  /// As StartVdb. Any thread.
  std::unique_ptr<VdbProcess> startVdb(const std::string& name, int input, int output);

 private:
  explicit VdbStarter(FileDescriptor channel) : channel_(std::move(channel)) {}

  Channel channel_;
};

} // namespace gnomon
