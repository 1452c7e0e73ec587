#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/access/access_key.h"
#include "server/system/clock.h"

namespace gnomon {

/// The keys of a file, as they were when it was last read whole. Any thread.
class KeyRing {
 public:
  /// Reads the file. Its problems say which lines are wrong. Logs nothing.
  static Result<std::shared_ptr<KeyRing>> open(std::string file);

  explicit KeyRing(std::vector<AccessKey> keys) : keys_(std::make_shared<const Keys>(std::move(keys))) {}

  /// Reads the file again. Where it can't be read or is wrong, the keys stay, and the log says why.
  void reload();

  /// Says in the log where every user of the machine may read the file.
  void warnOfReaders() const;

  /// The key that has this secret; every key is looked at, whichever it is.
  std::optional<AccessKey> withSecret(std::string_view secret) const;

  /// The key of this name.
  std::optional<AccessKey> named(std::string_view name) const;

 private:
  using Keys = std::vector<AccessKey>;

  std::shared_ptr<const Keys> keys() const;

  std::string file_;
  mutable std::mutex mutex_;
  std::shared_ptr<const Keys> keys_;
};

/// Whether a request of a key may go on.
struct Admission {
  std::shared_ptr<void> place; ///< counts as one in progress while it is held; nothing = refused
  int retryAfterSeconds = 0;   ///< of a refusal, >= 1: when the next request may come, or when to ask again
};

/// What each key has used of its share: a token bucket of requests, and the requests in progress. Any thread.
class KeyUsage {
 public:
  /// Seconds until a request of this key may begin; 0 = now. Takes nothing.
  int wait(const AccessKey& key, Clock::time_point now = Clock::now());

  /// Takes a token and a place, if there is one of each.
  Admission admit(const AccessKey& key, Clock::time_point now = Clock::now());

 private:
  struct Share {
    double tokens = 0;
    Clock::time_point filled; ///< when `tokens` was right
    bool isNew = true;
    std::size_t running = 0;
  };

  Share& refilled(const AccessKey& key, Clock::time_point now);
  static int waitOf(const AccessKey& key, const Share& share);

  std::shared_ptr<std::mutex> mutex_ = std::make_shared<std::mutex>(); ///< places may outlive this
  std::map<std::string, std::shared_ptr<Share>> shares_; ///< by the key's name, so that it outlives a reload
};

} // namespace gnomon
