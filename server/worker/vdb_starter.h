#pragma once

#include <memory>

#include "renderer/render.h"
#include "server/wire/channel.h"

namespace gnomon {

/// A process that starts the reader of VDB files (gnomon_vdb) for a worker, which may start none once it is sealed. It
/// is given nothing but a grid's name, the file, and where the voxels go, and ends with the worker.
class VdbStarter {
 public:
  /// Call it before starting threads: it forks. nullptr where the system refused.
  static std::unique_ptr<VdbStarter> start();

  /// As StartVdb. Any thread.
  std::unique_ptr<VdbProcess> startVdb(VdbPrograms programs, const std::string& name, int input, int output);

 private:
  explicit VdbStarter(FileDescriptor channel) : channel_(std::move(channel)) {}

  Channel channel_;
};

} // namespace gnomon
