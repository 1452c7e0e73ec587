#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace gnomon {

/// Bytes that this process and its children may hold: what its container or its control group grants, and at most what
/// the machine has.
std::uint64_t memoryLimit();

/// The least limit of a control group and those above it (cgroups(7): memory.max of version 2, memory.limit_in_bytes of
/// version 1). `root`: where they are mounted. `ownGroups`: the text of /proc/self/cgroup. Nothing = none is set.
std::optional<std::uint64_t> memoryGranted(const std::filesystem::path& root, const std::string& ownGroups);

} // namespace gnomon
