#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/base/result.h"
#include "protocol/json/json_codec.h"
#include "protocol/sequence/sequence.h"

namespace gnomon {

/// A sequence that passed every check that needs no scene.
struct Sequence {
  Json spec{};                 ///< as it was written
  std::vector<Json> patches{}; ///< frames, or keys
  bool isKeyed = false;
  int count = 0; ///< frames, those before `first` included
  bool stable = true;
  double framesPerSecond = 30;
  int videoQuality = 75;
  int first = 0;
  Carried carried{}; ///< for frame `first`
};

/// A SequenceRequest from untrusted JSON, as strictly as decodeFrameSpec. Every frame must give a good spec; its
/// problems point into /frames/i, or into the key before it. The work is bounded by kLimits.maxSequenceSpecBytes.
/// `each` is called with every frame from `first` on, in order, without what is carried.
Result<Sequence> decodeSequence(std::string_view json, const std::function<void(const FrameSpec&)>& each = {});

/// Frame `index` as it is drawn after one that left `before`: it depends on nothing else. Any thread.
/// REQUIRES: 0 <= index < sequence.count.
FrameSpec frameSpec(const Sequence& sequence, int index, const Carried& before);

/// Pointer to frame `index` in the request: "/frames/17", "/keys/2".
std::string framePlace(const Sequence& sequence, int index);

/// What is carried, from untrusted JSON.
Result<Carried> decodeCarried(std::string_view json);

Json toJson(const Carried& carried);
Json toJson(const SequenceFrame& frame);
Json toJson(const SequenceReport& report);

} // namespace gnomon
