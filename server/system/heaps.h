#pragma once

namespace gnomon {

/// Large blocks come from the system and go back to it at once. A heap keeps what a frame takes free at its end: pages
/// that go and come with every frame cost an eighth of a small one. Threads share a few heaps, so
/// that what all of them keep is bounded. By default (mallopt(3)) the allocator makes eight for each core and
/// raises the sizes as it sees larger blocks, and a server never returns memory. Its own variables have the last word.
void boundHeaps(int heaps);

} // namespace gnomon
