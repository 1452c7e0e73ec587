#include "server/metrics/request_metrics.h"

#include <chrono>
#include <iterator>
#include <map>
#include <prometheus/counter.h>
#include <prometheus/family.h>
#include <prometheus/histogram.h>
#include <prometheus/registry.h>
#include <prometheus/text_serializer.h>
#include <sstream>

namespace gnomon::metrics {
namespace {

using prometheus::Counter;
using prometheus::Family;
using prometheus::Histogram;

/// Seconds: from a picture in memory to an evaluation.
const Histogram::BucketBoundaries kSeconds{0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25,
                                           0.5,   1,      2.5,   5,    10,    30,   60,  300};

struct EventMetric {
  const char* name;
  const char* help;
};

constexpr EventMetric kRequests{"gnomon_http_requests_total", "Requests by route, method and status."};
constexpr EventMetric kDuration{"gnomon_http_request_duration_seconds",
                                "Time from a request's first byte to the end of its reply."};
constexpr EventMetric kRequestBytes{"gnomon_http_request_bytes_total",
                                    "Bytes of requests' bodies that were read whole."};
constexpr EventMetric kReplyBytes{"gnomon_http_reply_bytes_total", "Bytes of replies' bodies that were sent."};
constexpr EventMetric kRefusals{"gnomon_refusals_total", "Requests that were refused, by reason."};
constexpr EventMetric kStage{"gnomon_stage_duration_seconds", "Time that frames spent in each stage."};
constexpr EventMetric kWait{"gnomon_queue_wait_seconds", "Time that tasks waited for a worker, by lane."};

Family<Counter>& counters(prometheus::Registry& registry, const EventMetric& row) {
  return prometheus::BuildCounter().Name(row.name).Help(row.help).Register(registry);
}

Family<Histogram>& histograms(prometheus::Registry& registry, const EventMetric& row) {
  return prometheus::BuildHistogram().Name(row.name).Help(row.help).Register(registry);
}

/// A member of the family for each label that there is, so that all of them are exposed from the start.
template <class Metric, class Names, class... More>
std::map<std::string, Metric*, std::less<>> membersOf(Family<Metric>& family, const char* label, const Names& names,
                                                      const More&... more) {
  std::map<std::string, Metric*, std::less<>> members;
  for (const std::string_view name : names) {
    members.emplace(name, &family.Add({{label, std::string(name)}}, more...));
  }
  return members;
}

std::array<std::string_view, kRefusalNames.size()> refusalNames() {
  std::array<std::string_view, kRefusalNames.size()> names;
  std::transform(kRefusalNames.begin(), kRefusalNames.end(), names.begin(), [](const auto& row) { return row.second; });
  return names;
}

auto stageNames() {
  std::array<std::string_view, kStages.size() + 1> names{};
  std::copy(kStages.begin(), kStages.end(), names.begin());
  names.back() = kOther;
  return names;
}

std::string_view nameOf(RefusalReason refusal) {
  const auto found =
      std::find_if(kRefusalNames.begin(), kRefusalNames.end(), [&](const auto& row) { return row.first == refusal; });
  return found == kRefusalNames.end() ? kOther : found->second;
}

} // namespace

struct RequestMetrics::Families {
  prometheus::Registry registry;
  Family<Counter>& requests = counters(registry, kRequests);
  Family<Histogram>& duration = histograms(registry, kDuration);
  Counter& requestBytes = counters(registry, kRequestBytes).Add({});
  Counter& replyBytes = counters(registry, kReplyBytes).Add({});
  std::map<std::string, Counter*, std::less<>> refusals =
      membersOf(counters(registry, kRefusals), "reason", refusalNames());
  std::map<std::string, Histogram*, std::less<>> stages =
      membersOf(histograms(registry, kStage), "stage", stageNames(), kSeconds);
  std::map<std::string, Histogram*, std::less<>> waits =
      membersOf(histograms(registry, kWait), "lane", kLaneNames, kSeconds);
};

RequestMetrics::RequestMetrics() : families_(std::make_unique<Families>()) {}
RequestMetrics::~RequestMetrics() = default;

void RequestMetrics::ended(const RequestRecord& record, const HttpReply& reply) noexcept {
  try {
    const std::string route(routeLabel(record.route));
    const std::string method(oneOf(kMethods, record.method));
    const std::string status(oneOf(kStatuses, std::to_string(reply.status)));
    families_->requests.Add({{"route", route}, {"method", method}, {"status", status}}).Increment();
    const std::chrono::duration<double> took = Clock::now() - record.start;
    families_->duration.Add({{"route", route}}, kSeconds).Observe(took.count());
    families_->requestBytes.Increment(static_cast<double>(record.requestBytes));
    families_->replyBytes.Increment(static_cast<double>(record.replyBytes));
    const RefusalReason refusal = reply.refusal == RefusalReason::none ? refusalOfStatus(reply.status) : reply.refusal;
    if (refusal != RefusalReason::none) families_->refusals.find(nameOf(refusal))->second->Increment();
    for (const StageTime& stage : reply.stages) {
      families_->stages.find(oneOf(kStages, stage.stage))->second->Observe(stage.milliseconds / 1000);
    }
  } catch (...) {
    // Without memory for a new series it is not counted; the reply matters more.
  }
}

void RequestMetrics::waited(Lane lane, double seconds) noexcept {
  families_->waits.find(kLaneNames[static_cast<std::size_t>(lane)])->second->Observe(seconds);
}

std::vector<prometheus::MetricFamily> RequestMetrics::collect() const {
  return families_->registry.Collect();
}

std::string metricsText(const RequestMetrics& counted, const Snapshot& snapshot) {
  auto families = readingsOf(snapshot);
  auto more = counted.collect();
  families.insert(families.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, families);
  return text.str();
}

} // namespace gnomon::metrics
