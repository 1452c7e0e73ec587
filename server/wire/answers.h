#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/system/shared_bytes.h"
#include "server/wire/messages.h"

/// What a worker may say to an order: pure functions of both.
namespace gnomon {

/// What an order's events have announced so far.
struct Announced {
  std::optional<std::size_t> pictureBytes{}; ///< of a sequenceFrame, encoded
};

/// The whole Content-Type of the order's result.
std::string resultType(const Order& order);

/// Whether the order has such an event at this time; `announced` then holds what it announces.
bool maySend(const Order& order, const OrderEvent& event, Announced& announced);

/// Whether it can be the order's outcome: problems, or a result of the order's type that is what it says: a scene's
/// summary, JSON of one line, pictures of the bytes that were announced. `body`: what came with it.
bool mayEnd(const Order& order, const Outcome& outcome, const std::optional<SharedBytes>& body,
            const Announced& announced);

} // namespace gnomon
