#pragma once

#include <span>
#include <vector>

#include "renderer/environment/environment.h"
#include "renderer/prepare/frame_geometry.h"
#include "renderer/prepare/lit_light.h"
#include "renderer/resolve/resolve_frame.h"
#include "renderer/scene/scene.h"
#include "renderer/shaders/shared/frame_types.h"

/// What a device computes a pixel from, as floats: packed at the last moment, and the same for every device.
namespace gnomon {

/// How a map is read: GNOMON_FILTER_...
int filterKind(const FilterKernel& filter);

/// GNOMON_TONE_... Numbers that are not `encoded` stay linear, whatever the tone mapping.
int toneOf(ToneMapping toneMapping, bool encoded);

std::vector<shared::LightData> lightData(std::span<const LitLight> lights);

/// The plan's tiles, in its order.
std::vector<shared::TileData> tileData(const ShadowPlan& plan);

/// What all pixels of a frame share; the depths of the surfaces are left at 0.
shared::FrameData frameData(const ResolvedFrame& frame);

/// Puts an environment's turn and intensity into the data of a frame.
void setEnvironment(const FrameEnvironment& environment, shared::FrameData& data);

shared::MaterialData materialData(const Material& material);

/// The number of a draw's first triangle is left at 0.
shared::InstanceData instanceData(const PlacedInstance& instance);

/// Relative to the geometry's eye.
std::vector<shared::InstanceData> instanceData(const FrameGeometry& geometry);

} // namespace gnomon
