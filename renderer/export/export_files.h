#pragma once

#include <optional>

#include "protocol/bake/bake.h"
#include "protocol/base/bytes.h"
#include "protocol/base/result.h"
#include "protocol/spec/output_options.h"
#include "renderer/core/stop.h"
#include "renderer/frame/frame.h"

/// Part of the door: see render.h.
namespace gnomon {

struct BakedScene;

inline constexpr std::size_t kMostExportedBytes = 256u << 20; ///< of a GLB

/// A bake as a file. `light`: index of a baked light, or kEnvironmentLight; absent = the first for PNG, or the
/// environment where no light was baked, and all for the others. Problems: at /light; lights of one file with charts of
/// different sizes; broken pictures; tooLarge above kMostExportedBytes.
Result<Bytes> bakeFile(const BakedScene& baked, BakeFile kind, std::optional<int> light);

// Frames of simulated sensors. `goOn`: false ends the encoding with a problem of code unavailable.

/// Metres along the view axis as a TIFF of 32-bit floats: 0 below `range`, infinity above it and where nothing is.
/// REQUIRES: a frame whose first view is depth, in floats.
Result<Bytes> depthTiff(const Frame& frame, const SensorRange& range, const GoOn& goOn = {});

/// Whole millimetres as a 16-bit grey PNG: 0 below `range`, 65535 above it, from 65.535 m on, and where nothing is.
/// REQUIRES: as above.
Result<Bytes> depthPng(const Frame& frame, const SensorRange& range, const GoOn& goOn = {});

/// The base color of each seen material as in the file, 0..1 as 0..255, without light, texture or transfer
/// curve, as an RGB PNG; white where nothing is. REQUIRES: a frame of `scene` whose first view is materials, in floats.
Result<Bytes> labelPng(const Scene& scene, const Frame& frame, const GoOn& goOn = {});

} // namespace gnomon
