#pragma once

#include "server/frames/services.h"
#include "server/http/router.h"

namespace gnomon {

HttpReply postPlan(Services& services, RouteCall call); ///< POST /v1/scenes/{id}/plan

} // namespace gnomon
