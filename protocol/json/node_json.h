#pragma once

#include <optional>
#include <string_view>

#include "protocol/json/json_codec.h"
#include "protocol/report/node_list.h"

namespace gnomon {

Json toJson(const NodeList& list);
Json toJson(const NodePage& page);

/// The page as toJson writes it; nothing = it is no page.
std::optional<NodePage> readNodePage(std::string_view json);

} // namespace gnomon
