#include "server/worker/front_light_maps.h"

#include <array>
#include <limits>

#include "server/wire/messages.h"

namespace gnomon {

std::optional<Bytes> FrontLightMaps::read(const std::string& key) {
  constexpr std::chrono::seconds kPatience{10}; ///< a map that takes longer is baked again
  LightMapRequest request{0, key};
  std::future<std::optional<Bytes>> answer;
  {
    const std::lock_guard lock(mutex_);
    request.number = ++requests_;
    answer = waiting_[request.number].get_future();
  }
  const bool asked = channel_.send(textOf(ToFront{.request = request}));
  if (asked && answer.wait_for(kPatience) == std::future_status::ready) return answer.get();
  const std::lock_guard lock(mutex_);
  waiting_.erase(request.number);
  return std::nullopt;
}

void FrontLightMaps::write(const std::string& key, const Bytes& lightMap) {
  const auto file = memoryFile(lightMap);
  if (!file) return;
  channel_.send(textOf(ToFront{.made = LightMapMade{key}}), std::array{file->get()});
}

void FrontLightMaps::found(std::uint64_t number, const FileDescriptor* file) {
  std::optional<Bytes> bytes;
  if (file != nullptr) bytes = readFile(*file, std::numeric_limits<std::size_t>::max()); // the front bounds its store
  const std::lock_guard lock(mutex_);
  const auto waiting = waiting_.find(number);
  if (waiting == waiting_.end()) return;
  waiting->second.set_value(std::move(bytes));
  waiting_.erase(waiting);
}

} // namespace gnomon
