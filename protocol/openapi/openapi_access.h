#pragma once

#include "protocol/base/json.h"

namespace gnomon::openapi {

/// The two ways to show who asks: components/securitySchemes.
Json securitySchemes();

/// The paths with what each operation needs where the server has keys, and with the replies that refuse a request
/// because of who asks, or from where.
Json withAccess(Json paths);

} // namespace gnomon::openapi
