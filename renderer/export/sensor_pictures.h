#pragma once

#include "protocol/base/result.h"
#include "protocol/report/sensor_range.h"
#include "renderer/core/stop.h"
#include "renderer/frame/frame.h"

/// Frames as the files that simulated sensors deliver. `goOn`: false ends the encoding with a problem of code
/// unavailable.
namespace gnomon {

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
