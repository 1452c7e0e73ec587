#pragma once

#include "server/handlers/handlers.h"
#include "server/http/connection.h"
#include "server/metrics/readings.h"
#include "server/process/serve.h"

namespace gnomon {

/// What the server is like now. Reads the store's directory, if there is one.
metrics::Snapshot snapshotOf(const ServeOptions& options, Services& services, const ConnectionContext& context);

} // namespace gnomon
