#include "server/wire/messages.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "protocol/base/scene_bundle.h"
#include "protocol/cost/frame_cost.h"
#include "protocol/fields/type_tables.h"
#include "server/wire/message_rows.h"
#include "server/wire/read_value.h"

namespace gnomon {

template const ValueType& typeOf<ToFront>();
template const ValueType& typeOf<ToWorker>();

namespace {

/// The message, where its text is that of exactly one of its kinds.
template <class Message>
std::optional<Message> readMessage(std::string_view text) {
  auto message = readValue<Message>(text);
  int kinds = 0;
  forEachField<Message>([&](const auto& row) { kinds += message && ((*message).*row.member).has_value() ? 1 : 0; });
  return kinds == 1 ? std::move(message) : std::nullopt;
}

bool isTime(double milliseconds) {
  return milliseconds >= 0 && milliseconds <= kMostMilliseconds;
}

bool isStageName(std::string_view name) {
  constexpr std::size_t kMostLetters = 32;
  const auto isLetter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= kMostLetters && std::all_of(name.begin(), name.end(), isLetter);
}

bool isSound(const Outcome& outcome) {
  constexpr int kMostSeconds = 86'400;
  return areStages(outcome.stages) && outcome.retryAfterSeconds >= 0 && outcome.retryAfterSeconds <= kMostSeconds;
}

/// JSON without line ends is one line of a stream.
bool isSound(const OrderEvent& event) {
  const bool isOneLine =
      std::none_of(event.data.begin(), event.data.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20; });
  return isOneLine && Json::accept(event.data);
}

bool isSound(const Beat& beat) {
  constexpr std::uint64_t kMostCount = std::uint64_t{1} << 52;
  constexpr double kMostFactor = 1'000; // usual is a millionth
  const auto isCount = [](std::uint64_t count) { return count <= kMostCount; };
  return isCount(beat.scenes) && isCount(beat.sceneBytes) && isCount(beat.reusedMeshes) && isCount(beat.reusedImages) &&
         beat.costFactors.size() == kFrameParts &&
         std::all_of(beat.costFactors.begin(), beat.costFactors.end(),
                     [](double factor) { return factor >= 0 && factor <= kMostFactor; });
}

bool isSound(const ToFront& message) {
  return (!message.outcome || isSound(*message.outcome)) && (!message.event || isSound(*message.event)) &&
         (!message.beat || isSound(*message.beat)) && (!message.refusal || !message.refusal->problems.empty()) &&
         (!message.request || isLightMapKey(message.request->key)) &&
         (!message.made || isLightMapKey(message.made->key));
}

} // namespace

bool isLightMapKey(std::string_view key) {
  const std::size_t dash = key.find('-');
  return dash != std::string_view::npos && isSceneId(key.substr(0, dash)) && isSceneId(key.substr(dash + 1));
}

bool areStages(const std::vector<StageTime>& stages) {
  constexpr std::size_t kMost = 64;
  return stages.size() <= kMost && std::all_of(stages.begin(), stages.end(), [](const StageTime& stage) {
           return isStageName(stage.stage) && isTime(stage.milliseconds);
         });
}

std::string textOf(const ToWorker& message) {
  return jsonText(toJson(message));
}
std::string textOf(const ToFront& message) {
  return jsonText(toJson(message));
}

std::optional<ToWorker> readToWorker(std::string_view text) {
  return readMessage<ToWorker>(text);
}
std::optional<ToFront> readToFront(std::string_view text) {
  auto message = readMessage<ToFront>(text);
  return message && isSound(*message) ? std::move(message) : std::nullopt;
}

} // namespace gnomon
