#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon {

/// Folders of the control groups (cgroups(7), versions 1 and 2) that bound a process by `controller`, "cpu" or
/// "memory": its own group's and those above it, as far up as they are mounted. Which of them has a file of a limit,
/// and of which version, is for the caller to see. `membership`: the text of /proc/self/cgroup; `mounts`: that of
/// /proc/self/mountinfo (proc(5)). A container may be in groups that are named from the machine's root while what is
/// mounted begins at its own: the part of the name above the mount is left out. Of a mount that shows another branch
/// than the process's own, its top alone counts.
std::vector<std::filesystem::path> controlGroups(std::string_view controller, const std::string& membership,
                                                 const std::string& mounts);

/// Those of this process.
std::vector<std::filesystem::path> controlGroups(std::string_view controller);

} // namespace gnomon
