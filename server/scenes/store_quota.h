#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <set>
#include <string>

#include "protocol/base/result.h"
#include "server/system/clock.h"

namespace gnomon {

/// The insufficientStorage problem of a scene of so many bytes, where `taken` of a quota are taken.
Problem noRoom(std::uint64_t quota, std::uint64_t taken, std::uint64_t bytes);

/// How many bytes the scenes of a directory may take together, all writers included. What is there is counted again
/// ever so often, so that what other servers wrote or removed counts, too: as often as counting takes a twentieth of
/// the time. Any thread.
class StoreQuota {
 public:
  using SceneIds = std::multiset<std::string>;

  /// `bytes` 0 = no quota. `count` gives the bytes there without these scenes.
  StoreQuota(std::uint64_t bytes, std::function<std::uint64_t(const SceneIds& without)> count)
      : bytes_(bytes), count_(std::move(count)) {}

  /// insufficientStorage where so many bytes do not fit now.
  Status check(std::uint64_t bytes);

  /// Writes a scene of so many bytes with `write`, unless they do not fit.
  Status write(const std::string& id, std::uint64_t bytes, const std::function<Status()>& write);

  /// A scene of so many bytes is gone.
  void giveBack(std::uint64_t bytes);

 private:
  Status room(std::uint64_t bytes);

  const std::uint64_t bytes_;
  const std::function<std::uint64_t(const SceneIds& without)> count_;
  std::mutex mutex_;
  std::uint64_t kept_ = 0;    ///< when they were counted, and since
  std::uint64_t writing_ = 0; ///< not kept yet
  SceneIds unfinished_;       ///< that are being written: their files may be there already, and are not counted
  Clock::time_point countAgain_ = Clock::time_point::min();
};

} // namespace gnomon
