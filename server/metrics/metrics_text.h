#pragma once

#include <string>

#include "server/metrics/readings.h"
#include "server/metrics/request_metrics.h"

namespace gnomon::metrics {

/// The Content-Type of metricsText().
inline constexpr const char* kTextFormat = "text/plain; version=0.0.4; charset=utf-8";

/// Everything in Prometheus' text format.
std::string metricsText(const RequestMetrics& counted, const Snapshot& snapshot);

} // namespace gnomon::metrics
