#pragma once

#include "server/router.h"
#include "server/services.h"

namespace gnomon {

HttpReply postPlan(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/plan

} // namespace gnomon
