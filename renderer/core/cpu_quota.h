#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gnomon {

/// How many cores' time a control group may use, from its settings; empty = no limit, or not readable.
/// `cpuMax`: the text of cgroup v2's cpu.max, "150000 100000" or "max 100000", in microseconds.
std::optional<double> coresOfCpuMax(std::string_view cpuMax);

/// The tightest limit on this process: its control group's and every ancestor's.
/// `root`: where control groups are mounted; `membership`: the text of /proc/self/cgroup. Knows versions 1 and 2.
std::optional<double> coresGranted(const std::filesystem::path& root, std::string_view membership);

/// Cores to keep busy: the machine's, or as many as this process is granted where that is fewer; at least 1.
int coresToUse();

} // namespace gnomon
