#pragma once

#include "tests/bench/bench_scenes.h"

namespace gnomon::bench {

/// A court between two storeys of arcades, with curtains and plants: 270,000 triangles without instances, and 69
/// textures of 1024 x 1024. The eye goes along it. Writes the file, hall.glb, into a folder that is there.
BenchScene hallScene(const std::filesystem::path& folder);

} // namespace gnomon::bench
