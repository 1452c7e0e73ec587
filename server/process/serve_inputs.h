#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/spec/frame_spec.h"
#include "server/access/key_ring.h"
#include "server/http/client_address.h"
#include "server/process/serve.h"
#include "server/redis/address.h"

/// What options mean together, and what the files hold that they name.
namespace gnomon {

/// Why a server with such options can't start, whatever the system's state.
struct OptionFault {
  std::vector<std::string_view> options; ///< that it is about: "store-bytes"
  std::string detail;                    ///< a sentence that names them
};

/// Options that contradict each other.
std::vector<OptionFault> conflictsOf(const ServeOptions& options);

/// What the options name.
struct ServeInputs {
  std::shared_ptr<KeyRing> keys{}; ///< nullptr = any client may do anything
  FrameSpec drakeColors{};
  std::vector<IpNetwork> trustedProxies{};
  std::optional<redis::Address> store{}; ///< nothing = a directory, or memory
  std::optional<redis::Address> jobs{};  ///< nothing = where the store is
};

/// Reads them; adds what is wrong to the faults. Starts no thread.
ServeInputs readInputs(const ServeOptions& options, std::vector<OptionFault>& faults);

} // namespace gnomon
