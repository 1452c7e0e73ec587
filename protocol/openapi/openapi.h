#pragma once

#include "protocol/json/json_codec.h"

namespace gnomon {

/// The OpenAPI 3.1 document of every route. The schemas of requests and replies are computed from the field rows.
Json openApi();

} // namespace gnomon
