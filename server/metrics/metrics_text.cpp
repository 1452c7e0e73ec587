#include "server/metrics/metrics_text.h"

#include <iterator>
#include <prometheus/text_serializer.h>
#include <sstream>
#include <utility>

namespace gnomon::metrics {

std::string metricsText(const RequestMetrics& counted, const Snapshot& snapshot) {
  auto families = readingsOf(snapshot);
  auto more = counted.collect();
  families.insert(families.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  std::ostringstream text;
  prometheus::TextSerializer().Serialize(text, families);
  return text.str();
}

} // namespace gnomon::metrics
