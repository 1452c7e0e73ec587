#pragma once

namespace gnomon {

/// The vectors that rays are traced with. Rays that graze an edge are met or missed by one or the other.
enum class RayVectors { widest, avx2, sse4 };

/// For trees that are built from now on, in the whole process. Any thread. Wider ones than the processor knows: as
/// `widest`, which is what all begin with.
void useRayVectors(RayVectors vectors);

/// Embree's configuration for them (rtcNewDevice).
const char* rayDeviceOptions();

} // namespace gnomon
