#pragma once

namespace gnomon {

/// Whether this process may put settings of its own in place of its control group's: it needs the right to mount.
bool canGrantCores();

/// From here on this process reads, where its control groups are, that it may use `cores` cores. For a process that
/// does nothing else: call it within EXPECT_EXIT, with the death test style "threadsafe".
void grantCores(int cores);

/// How many threads this process has.
int threadCount();

} // namespace gnomon
