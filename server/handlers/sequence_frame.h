#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "protocol/cost/frame_cost.h"
#include "protocol/sequence/sequence_json.h"
#include "server/handlers/handlers.h"
#include "server/handlers/work.h"
#include "server/system/byte_budget.h"
#include "server/wire/sequence_news.h"

namespace gnomon {

/// A frame of a sequence, or why there is none.
struct DoneFrame {
  int index = 0;
  Problems problems{}; ///< with places in the request
  TaskResult result{}; ///< where there are problems: what refused
  std::vector<PictureNews> pictures{};
  Bytes bytes{};                     ///< of the pictures, one after the other
  std::unique_ptr<ByteLease> room{}; ///< for the bytes, beside all replies that clients are taking
  Carried own{};                     ///< of this frame alone
  Carried carried{};                 ///< for the next frame
  std::vector<std::string> warnings{};
  double milliseconds = 0; ///< since its beginning
};

/// A frame that is to be drawn.
struct FrameToDraw {
  const Sequence& sequence;
  int index = 0;
  Carried before{}; ///< what it takes from the frame before it
  SceneCounts counts{};
  Task task{};            ///< all but the frame's own; its deadline is that of all frames
  bool isPatient = false; ///< asks again where too many tasks wait
  std::function<bool()> gone;
  std::function<void(const DoneFrame&)> drawn{}; ///< called with what it carries, once the next one can begin

  // Room for its bytes; absent = they need none
  std::function<bool()> awaitRoom{};                 ///< before it is drawn; false = there will be none
  std::function<bool(std::size_t bytes)> takeRoom{}; ///< before its bytes are read; false = it is drawn again
};

/// Problems of a frame's own spec, seen from the request.
Problems placed(Problems problems, const std::string& place);

std::size_t bytesOf(const std::vector<PictureNews>& pictures);

/// Has a worker draw it, on the calling thread's behalf.
DoneFrame drawSequenceFrame(Services& services, FrameToDraw call);

} // namespace gnomon
