#pragma once

#include <future>
#include <map>
#include <mutex>

#include "renderer/render.h"
#include "server/system/file_descriptor.h"
#include "server/wire/channel.h"

namespace gnomon {

/// Light maps that the front keeps: a worker has no files of its own. Any thread.
class FrontLightMaps : public LightMapStore {
 public:
  /// `channel` outlives it.
  explicit FrontLightMaps(Channel& channel) : channel_(channel) {}

  std::optional<Bytes> read(const std::string& key) override;
  void write(const std::string& key, const Bytes& lightMap) override;

  /// The front's answer to the request of this number; nullptr = it keeps no such map.
  void found(std::uint64_t number, const FileDescriptor* file);

 private:
  Channel& channel_;
  std::mutex mutex_;
  std::uint64_t requests_ = 0;
  std::map<std::uint64_t, std::promise<std::optional<Bytes>>> waiting_;
};

} // namespace gnomon
