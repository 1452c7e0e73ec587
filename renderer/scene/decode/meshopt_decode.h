#pragma once

#include <cstdint>
#include <span>

#include "protocol/base/bytes.h"
#include "renderer/scene/decode/decode_budget.h"
#include "renderer/scene/decode/meshopt_view.h"

namespace gnomon {

/// The elements of a compressed buffer view, decoded and filtered. Nothing is allocated before the claims fit the
/// compressed bytes and the budget. Empty, with a problem, where they do not or the bytes can't be decoded.
Bytes decodeMeshopt(const MeshoptView& view, std::span<const std::uint8_t> compressed, DecodeBudget& budget,
                    Findings& findings);

} // namespace gnomon
