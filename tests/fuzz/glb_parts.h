#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace gnomon::fuzz {

/// Changes at most `capacity` bytes at `data`, of which `size` are in use; returns how many are then.
using Mutation = std::function<std::size_t(std::uint8_t* data, std::size_t size, std::size_t capacity)>;

/// Applies a mutation to one part of a GLB, its JSON or its binary, and writes lengths that fit; so the change gets
/// past the container. One time in eight, and where the bytes are no GLB, it meets the bytes as they are.
std::size_t mutatePart(std::uint8_t* data, std::size_t size, std::size_t capacity, unsigned seed,
                       const Mutation& mutate);

} // namespace gnomon::fuzz
