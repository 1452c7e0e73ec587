#pragma once

#include "protocol/json/problem_rows.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/enum_rows.h"
#include "server/wire/messages.h"

/// The rows of the messages; see fields.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<Backend>{
    spelling(Backend::auto_, "auto"),
    spelling(Backend::egl, "egl"),
    spelling(Backend::osmesa, "osmesa"),
};
static_assert(spellsAll<Backend>());

template <>
inline constexpr std::array kSpellings<OrderKind>{
    spelling(OrderKind::load, "load"),   spelling(OrderKind::frame, "frame"),
    spelling(OrderKind::plan, "plan"),   spelling(OrderKind::evaluation, "evaluation"),
    spelling(OrderKind::bake, "bake"),   spelling(OrderKind::bakeFile, "bakeFile"),
    spelling(OrderKind::nodes, "nodes"), spelling(OrderKind::sequenceFrame, "sequenceFrame"),
};
static_assert(spellsAll<OrderKind>());

template <>
inline constexpr auto kRows<WorkerOptions> =
    rows("WorkerOptions", "How a worker draws and what it may keep.",
         field("device", &WorkerOptions::device, {.says = "What draws."}),
         field("backend", &WorkerOptions::backend, {.says = "Graphics context."}),
         field("requireGpu", &WorkerOptions::requireGpu, {.says = "Refuse to start without a GPU."}),
         field("gpuSceneBytes", &WorkerOptions::gpuSceneBytes, {.says = "Scenes on the device.", .unit = "bytes"}),
         field("tileCacheBytes", &WorkerOptions::tileCacheBytes, {.says = "Shadow atlases.", .unit = "bytes"}),
         field("tracedSceneBytes", &WorkerOptions::tracedSceneBytes, {.says = "Scenes for rays.", .unit = "bytes"}),
         field("lightMapBytes", &WorkerOptions::lightMapBytes, {.says = "Baked light maps.", .unit = "bytes"}),
         field("volumeBytes", &WorkerOptions::volumeBytes, {.says = "Grids and light of volumes.", .unit = "bytes"}),
         field("sceneMemoryBytes", &WorkerOptions::sceneMemoryBytes, {.says = "Loaded scenes.", .unit = "bytes"}),
         field("frameMemoryBytes", &WorkerOptions::frameMemoryBytes, {.says = "Pictures.", .unit = "bytes"}),
         field("maxSceneBytes", &WorkerOptions::maxSceneBytes, {.says = "The largest bundle.", .unit = "bytes"}),
         field("memoryBytes", &WorkerOptions::memoryBytes, {.says = "The whole process.", .unit = "bytes"}),
         field("keepsLightMaps", &WorkerOptions::keepsLightMaps, {.says = "The front stores light maps."}));
static_assert(kRowsAreComplete<WorkerOptions>);

template <>
inline constexpr auto kRows<SensorRange> = rows("SensorRange", "What a depth sensor can measure.",
                                                field("min", &SensorRange::min, {.says = "The nearest.", .unit = "m"}),
                                                field("max", &SensorRange::max,
                                                      {.says = "The farthest.", .unit = "m"}));

template <>
inline constexpr auto kRows<Order> =
    rows("Order", "Work for a worker.", field("number", &Order::number, {.says = "Names it."}),
         field("kind", &Order::kind, {.says = "What is wanted."}),
         field("scene", &Order::scene, {.says = "The scene's id."}),
         field("isStored", &Order::isStored, {.says = "The bundle comes from a disk."}),
         field("strict", &Order::strict, {.says = "What violates glTF is refused."}),
         field("milliseconds", &Order::milliseconds, {.says = "Until its deadline.", .unit = "milliseconds"}),
         field("queuedMilliseconds", &Order::queuedMilliseconds, {.says = "That it waited.", .unit = "milliseconds"}),
         field("mediaType", &Order::mediaType, {.says = "Of the result."}),
         field("boundary", &Order::boundary, {.says = "Between the parts of a multipart result."}),
         field("light", &Order::light, {.says = "Index of the light of a bakeFile."}),
         field("traceId", &Order::traceId, {.says = "Of the request, for the log."}),
         field("depthRange", &Order::depthRange, {.says = "Of a sensor that sees depths."}),
         field("labels", &Order::labels, {.says = "Colors of materials are wanted."}));
static_assert(kRowsAreComplete<Order>);

template <>
inline constexpr auto kRows<Cancel> = rows("Cancel", "Cancels an order.",
                                           field("number", &Cancel::number, {.says = "The order."}));

template <>
inline constexpr auto kRows<Forget> = rows("Forget", "A scene was deleted.",
                                           field("scene", &Forget::scene, {.says = "Its id."}));

template <>
inline constexpr auto kRows<LightMapFound> = rows("LightMapFound", "Answers a request.",
                                                  field("number", &LightMapFound::number, {.says = "The request."}));

template <>
inline constexpr auto kRows<ToWorker> = rows("ToWorker", "A message to a worker.",
                                             field("start", &ToWorker::start, {.says = "The first."}),
                                             field("order", &ToWorker::order, {.says = "Work."}),
                                             field("cancel", &ToWorker::cancel, {.says = "Work that is cancelled."}),
                                             field("forget", &ToWorker::forget, {.says = "A deleted scene."}),
                                             field("lightMap", &ToWorker::lightMap, {.says = "An answered request."}));
static_assert(kRowsAreComplete<ToWorker>);

template <>
inline constexpr auto kRows<Outcome> =
    rows("Outcome", "The result of an order.", field("number", &Outcome::number, {.says = "The order."}),
         field("problems", &Outcome::problems, {.says = "Why there is no result."}),
         field("retryAfterSeconds", &Outcome::retryAfterSeconds, {.says = "When to ask again.", .unit = "seconds"}),
         field("damaged", &Outcome::damaged, {.says = "The bundle is not the one that the id names."}),
         field("contentType", &Outcome::contentType, {.says = "Of the result."}),
         field("stages", &Outcome::stages, {.says = "What took how long.", .unit = "milliseconds"}),
         field("warnings", &Outcome::warnings, {.says = "Of a frame's report."}),
         field("note", &Outcome::note, {.says = "For the log alone."}));
static_assert(kRowsAreComplete<Outcome>);

template <>
inline constexpr auto kRows<OrderEvent> = rows("OrderEvent", "A server-sent event of an order.",
                                               field("number", &OrderEvent::number, {.says = "The order."}),
                                               field("name", &OrderEvent::name, {.says = "Of the event."}),
                                               field("data", &OrderEvent::data, {.says = "JSON."}));
static_assert(kRowsAreComplete<OrderEvent>);

template <>
inline constexpr auto kRows<Beat> = rows("Beat", "A sign of life.",
                                         field("scenes", &Beat::scenes, {.says = "Loaded scenes."}),
                                         field("sceneBytes", &Beat::sceneBytes, {.says = "Of them.", .unit = "bytes"}),
                                         field("reusedMeshes", &Beat::reusedMeshes, {.says = "Found in other scenes."}),
                                         field("reusedImages", &Beat::reusedImages, {.says = "The same of images."}),
                                         field("costFactors", &Beat::costFactors,
                                               {.says = "Of each part of a frame.", .unit = "milliseconds"}));
static_assert(kRowsAreComplete<Beat>);

template <>
inline constexpr auto kRows<Refusal> = rows("Refusal", "A worker that can't start.",
                                            field("problems", &Refusal::problems, {.says = "Why not."}));

template <>
inline constexpr auto kRows<LightMapRequest> = rows("LightMapRequest", "Asks for a stored light map.",
                                                    field("number", &LightMapRequest::number, {.says = "Names it."}),
                                                    field("key", &LightMapRequest::key, {.says = "Of the light map."}));
static_assert(kRowsAreComplete<LightMapRequest>);

template <>
inline constexpr auto kRows<LightMapMade> = rows("LightMapMade", "A light map to be stored.",
                                                 field("key", &LightMapMade::key, {.says = "Of the light map."}));

template <>
inline constexpr auto kRows<ToFront> = rows("ToFront", "A message to the front.",
                                            field("ready", &ToFront::ready, {.says = "What draws."}),
                                            field("refusal", &ToFront::refusal, {.says = "Why nothing draws."}),
                                            field("outcome", &ToFront::outcome, {.says = "The result of an order."}),
                                            field("event", &ToFront::event, {.says = "An order's progress."}),
                                            field("beat", &ToFront::beat, {.says = "A sign of life."}),
                                            field("request", &ToFront::request,
                                                  {.says = "A light map that is wanted."}),
                                            field("made", &ToFront::made, {.says = "A light map that was made."}));
static_assert(kRowsAreComplete<ToFront>);

} // namespace gnomon
