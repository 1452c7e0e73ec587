#pragma once

#include <functional>

#include "protocol/bake/bake_report.h"

/// Part of the door: see render.h.
namespace gnomon {

/// Told how far a bake has come, its key left empty, by one thread at a time; false asks it to stop. Empty = nobody
/// listens.
using BakeListener = std::function<bool(const BakeStep&)>;

} // namespace gnomon
