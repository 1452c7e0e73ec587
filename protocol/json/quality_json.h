#pragma once

#include <optional>
#include <string_view>

#include "protocol/json/json_codec.h"
#include "protocol/report/frame_report.h"

namespace gnomon {

Json toJson(const QualityReport& report);

/// The report as toJson writes it, whose `chosen` is one of those tried; nothing = it is no such report.
std::optional<QualityReport> readQualityReport(std::string_view json);

} // namespace gnomon
