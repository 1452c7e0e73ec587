#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/access/access_key.h"

namespace gnomon {

/// The keys of a file, as they were when it was last read whole. Any thread.
class KeyRing {
 public:
  /// Reads the file. Its problems say which lines are wrong.
  static Result<std::shared_ptr<KeyRing>> open(std::string file);

  explicit KeyRing(std::vector<AccessKey> keys) : keys_(std::make_shared<const Keys>(std::move(keys))) {}

  /// Reads the file again. Where it can't be read or is wrong, the keys stay, and the log says why.
  void reload();

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

} // namespace gnomon
