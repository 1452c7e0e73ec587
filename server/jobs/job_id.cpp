#include "server/jobs/job_id.h"

#include <array>
#include <cstdint>
#include <stdexcept>
#include <sys/random.h>

#include "protocol/base/bytes.h"

namespace gnomon {

std::string newJobId() {
  std::array<std::uint8_t, 16> bytes;
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) {
    throw std::runtime_error("The system gives no random bytes.");
  }
  return hexText(bytes);
}

} // namespace gnomon
