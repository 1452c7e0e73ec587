#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Bytes that this process and its children may hold: what its container or its control group grants, and at most what
/// the machine has.
std::uint64_t memoryLimit();

/// The least limit of these control groups (renderer/core/control_groups.h): memory.max of version 2,
/// memory.limit_in_bytes of version 1. Nothing = none is set.
std::optional<std::uint64_t> memoryGranted(const std::vector<std::filesystem::path>& groups);

/// The most data (RLIMIT_DATA of setrlimit(2), which counts what is reserved, too) with which this process stays within
/// so many bytes of memory, so that an allocation fails before the process is killed for more. What it has reserved and
/// never touched, as stacks of threads, comes on top; pages of files come off, and a sixteenth for what is touched of
/// both later. `status`: the text of /proc/self/status.
std::uint64_t dataWithin(std::uint64_t memoryBytes, const std::string& status);

/// Large blocks come from the system and go back to it at once. A heap keeps what a frame takes free at its end: pages
/// that go and come with every frame cost an eighth of a small one. Threads share a few heaps, so
/// that what all of them keep is bounded. By default (mallopt(3)) the allocator makes eight for each core and
/// raises the sizes as it sees larger blocks, and a server never returns memory. Its own variables have the last word.
void boundHeaps(int heaps);

/// GLIBC_TUNABLES, as "NAME=VALUE", for a process whose heaps ask for huge pages: what is touched for the first time
/// then costs one fault for 2 MiB instead of 512, which in some virtual machines is half of a first frame, for some MiB
/// more memory. The allocator reads this only as a process starts. `own`: the variable's value so far, which has the
/// last word. A system that is set to never use huge pages passes over it.
std::string hugePagesVariable(std::string_view own);

} // namespace gnomon
