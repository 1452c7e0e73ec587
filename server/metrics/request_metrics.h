#pragma once

#include <algorithm>
#include <array>
#include <memory>
#include <prometheus/metric_family.h>
#include <string>
#include <string_view>
#include <vector>

#include "server/dispatch/task.h"
#include "server/http/connection.h"
#include "server/metrics/readings.h"

namespace gnomon::metrics {

// The values that labels may have: no client can make the server count ever more series.
inline constexpr std::string_view kOther = "other";

inline constexpr std::array<std::string_view, 7> kMethods{"GET", "HEAD", "POST", "PUT", "DELETE", "OPTIONS", "PATCH"};

/// Every status that the server sends, and 499, which its log gives to clients that left.
inline constexpr std::array<std::string_view, 23> kStatuses{"200", "201", "204", "304", "400", "401", "403", "404",
                                                            "405", "406", "408", "411", "413", "415", "421", "422",
                                                            "429", "431", "499", "500", "503", "504", "507"};

/// Those of frame_report.h.
inline constexpr std::array<std::string_view, 15> kStages{"queue",   "load",      "upload",   "bake",     "environment",
                                                          "volume",  "survey",    "plan",     "shadow",   "shade",
                                                          "predict", "reference", "sunHours", "readback", "encode"};

/// `value` where it is one of `known`, else "other".
template <std::size_t N>
constexpr std::string_view oneOf(const std::array<std::string_view, N>& known, std::string_view value) {
  const auto found = std::find(known.begin(), known.end(), value);
  return found == known.end() ? kOther : *found;
}

/// A route's name, which is one of the router's; "none" for requests that have none.
inline std::string_view routeLabel(std::string_view route) {
  return route.empty() ? "none" : route;
}

/// What is counted when something happens: requests as they end, tasks as they reach a worker. Any thread.
class RequestMetrics : public RequestObserver {
 public:
  RequestMetrics();
  ~RequestMetrics() override;

  /// Costs some microseconds.
  void ended(const RequestRecord& record, const HttpReply& reply) noexcept override;

  /// A task waited so long for its worker.
  void waited(Lane lane, double seconds) noexcept;

  std::vector<prometheus::MetricFamily> collect() const;

 private:
  struct Families;
  std::unique_ptr<Families> families_;
};

/// The Content-Type of metricsText().
inline constexpr const char* kTextFormat = "text/plain; version=0.0.4; charset=utf-8";

/// Everything in Prometheus' text format.
std::string metricsText(const RequestMetrics& counted, const Snapshot& snapshot);

} // namespace gnomon::metrics
