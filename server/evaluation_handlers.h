#pragma once

#include "server/router.h"
#include "server/services.h"

namespace gnomon {

HttpReply postEvaluation(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/evaluations

} // namespace gnomon
