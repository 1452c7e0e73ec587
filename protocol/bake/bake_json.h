#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "protocol/bake/bake_report.h"
#include "protocol/json/json_codec.h"
#include "protocol/spec/frame_spec.h"

namespace gnomon {

/// The parts of a frame's spec that decide what is baked for it; the rest has its defaults. A target stays, since no
/// settings can be chosen without a camera, and the bake refuses it.
FrameSpec bakedParts(const FrameSpec& spec);

/// Names a bake: SHA-256 of a scene's id and of those parts, as 64 lower-case hexadecimal digits.
std::string bakeKey(std::string_view sceneId, const FrameSpec& spec);

Json toJson(const BakeReport& report);
Json toJson(const BakeStep& step);

/// The report that a server wrote as JSON; what it says beyond our rows is passed over. Nothing = it is no report.
std::optional<BakeReport> readBakeReport(std::string_view json);

} // namespace gnomon
