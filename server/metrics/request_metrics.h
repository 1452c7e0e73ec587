#pragma once

#include <memory>
#include <prometheus/metric_family.h>
#include <string>
#include <vector>

#include "server/dispatch/task.h"
#include "server/http/connection.h"
#include "server/metrics/readings.h"

namespace gnomon::metrics {

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
