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
  std::vector<std::string_view> options; ///< that it is about: "store-bytes"; several contradict each other
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

/// The addresses among them; adds what is wrong to the faults. No fault repeats the address of a Redis, which may hold
/// a password.
ServeInputs readAddresses(const ServeOptions& options, std::vector<OptionFault>& faults);

/// Adds what is in the files that options name, and what is wrong with it to the faults. Starts no thread.
void readFiles(const ServeOptions& options, ServeInputs& inputs, std::vector<OptionFault>& faults);

} // namespace gnomon
