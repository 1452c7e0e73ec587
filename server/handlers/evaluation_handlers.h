#pragma once

#include "server/handlers/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply postEvaluation(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/evaluations

} // namespace gnomon
