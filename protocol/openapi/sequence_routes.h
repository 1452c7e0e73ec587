#pragma once

#include "protocol/json/json_source.h"

/// The routes of sequences, drawn while the client waits or as jobs.
namespace gnomon::openapi {

Json sequencesRoute(); ///< /v1/scenes/{id}/sequences
Json jobsRoute();      ///< /v1/jobs
Json jobRoute();       ///< /v1/jobs/{id}
Json jobResultRoute(); ///< /v1/jobs/{id}/result
Json jobFrameRoute();  ///< /v1/jobs/{id}/frames/{index}

} // namespace gnomon::openapi
