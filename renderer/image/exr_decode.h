#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "protocol/base/result.h"
#include "renderer/image/image.h"

namespace gnomon {

/// The channels of an EXR that belong together: "depth.Z" is channel Z of layer depth. Channels without a layer are
/// "main", or the layer of their part's name where no channel there has one.
struct ExrLayer {
  std::string name;
  Image image; ///< floats as they stand in the file, over its data window: linear, colour multiplied by its alpha
};

/// Whether the bytes begin as an EXR does.
bool isExr(std::span<const std::uint8_t> file);

/// Every layer of a file's parts, in scan lines or tiles (the full size of several), by the order of its channels.
/// Problems: what is no EXR, damaged or deep; channels of fewer pixels than their part; two layers of one name; a part
/// of more than `maxSide` pixels a side; more than `maxValues` numbers in all.
Result<std::vector<ExrLayer>> decodeExr(std::span<const std::uint8_t> file, int maxSide, std::int64_t maxValues);

} // namespace gnomon
