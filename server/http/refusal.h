#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace gnomon {

/// Why a server that works did not do what a well-formed request asked, for logs and metrics. A problem's sentence is
/// for the client.
enum class RefusalReason {
  none,
  queue,    ///< as many tasks wait as may
  threads,  ///< every thread serves a request
  address,  ///< this client's address has its share of the threads
  permits,  ///< as many evaluations or bakes run as may
  cost,     ///< the frame is more work than its time allows
  size,     ///< larger than a limit
  rate,     ///< this key has as many requests as it may have
  deadline, ///< it came too slowly, or was not done in time
  memory,   ///< bodies, replies or pictures use what there is
  storage,  ///< the store's disk is full
  keys,     ///< no key, or one that does not allow it
  origin    ///< an unknown Host, or a page of an unknown Origin
};

/// Every refusal by its name.
inline constexpr std::array<std::pair<RefusalReason, std::string_view>, 12> kRefusalNames{
    {{RefusalReason::queue, "queue"},
     {RefusalReason::threads, "threads"},
     {RefusalReason::address, "address"},
     {RefusalReason::permits, "permits"},
     {RefusalReason::cost, "cost"},
     {RefusalReason::size, "size"},
     {RefusalReason::rate, "rate"},
     {RefusalReason::deadline, "deadline"},
     {RefusalReason::memory, "memory"},
     {RefusalReason::storage, "storage"},
     {RefusalReason::keys, "keys"},
     {RefusalReason::origin, "origin"}}};

/// What a status alone means, where nothing else was noted.
inline constexpr std::array<std::pair<int, RefusalReason>, 5> kRefusalOfStatus{{{408, RefusalReason::deadline},
                                                                                {413, RefusalReason::size},
                                                                                {431, RefusalReason::size},
                                                                                {504, RefusalReason::deadline},
                                                                                {507, RefusalReason::storage}}};

constexpr RefusalReason refusalOfStatus(int status) {
  for (const auto& [known, refusal] : kRefusalOfStatus) {
    if (known == status) return refusal;
  }
  return RefusalReason::none;
}

} // namespace gnomon
