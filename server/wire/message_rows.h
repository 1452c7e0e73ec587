#pragma once

#include "protocol/json/problem_rows.h"
#include "protocol/report/reply_rows.h"
#include "protocol/spec/enum_rows.h"
#include "server/wire/messages.h"

/// The rows of the messages; see fields.h.
namespace gnomon {

template <>
inline constexpr std::array kSpellings<Backend>{
    spelling<Backend::auto_>(),
    spelling<Backend::egl>(),
    spelling<Backend::osmesa>(),
};

template <>
inline constexpr std::array kSpellings<OrderKind>{
    spelling<OrderKind::load>(),       spelling<OrderKind::frame>(),         spelling<OrderKind::plan>(),
    spelling<OrderKind::evaluation>(), spelling<OrderKind::bake>(),          spelling<OrderKind::bakeFile>(),
    spelling<OrderKind::nodes>(),      spelling<OrderKind::sequenceFrame>(),
};

template <>
inline constexpr auto kRows<WorkerOptions> =
    rows("WorkerOptions", "How a worker draws and what it may keep.", field<&WorkerOptions::device>("What draws."),
         field<&WorkerOptions::backend>("Graphics context."),
         field<&WorkerOptions::requireGpu>("Refuse to start without a GPU."),
         field<&WorkerOptions::gpuSceneBytes>("Scenes on the device.", {.unit = "bytes"}),
         field<&WorkerOptions::tileCacheBytes>("Shadow atlases.", {.unit = "bytes"}),
         field<&WorkerOptions::tracedSceneBytes>("Scenes for rays.", {.unit = "bytes"}),
         field<&WorkerOptions::lightMapBytes>("Baked light maps.", {.unit = "bytes"}),
         field<&WorkerOptions::volumeBytes>("Grids and light of volumes.", {.unit = "bytes"}),
         field<&WorkerOptions::environmentBytes>("Environments prepared for shading.", {.unit = "bytes"}),
         field<&WorkerOptions::sceneMemoryBytes>("Loaded scenes.", {.unit = "bytes"}),
         field<&WorkerOptions::frameMemoryBytes>("Drawing and encoding frames.", {.unit = "bytes"}),
         field<&WorkerOptions::maxSceneBytes>("The largest bundle.", {.unit = "bytes"}),
         field<&WorkerOptions::memoryBytes>("The whole process.", {.unit = "bytes"}),
         field<&WorkerOptions::vdbBytes>("The process that reads a VDB file for it.", {.unit = "bytes"}),
         field<&WorkerOptions::keepsLightMaps>("The front stores light maps."));

template <>
inline constexpr auto kRows<SensorRange> = rows("SensorRange", "What a depth sensor can measure.",
                                                field<&SensorRange::min>("The nearest.", {.unit = "m"}),
                                                field<&SensorRange::max>("The farthest.", {.unit = "m"}));

template <>
inline constexpr auto kRows<Order> = rows(
    "Order", "Work for a worker.", field<&Order::number>("Names it."), field<&Order::kind>("What is wanted."),
    field<&Order::scene>("The scene's id."), field<&Order::isStored>("The bundle comes from a disk."),
    field<&Order::strict>("What violates glTF is refused."),
    field<&Order::milliseconds>("Until its deadline.", {.unit = "milliseconds"}),
    field<&Order::queuedMilliseconds>("That it waited.", {.unit = "milliseconds"}),
    field<&Order::mediaType>("Of the result."), field<&Order::boundary>("Between the parts of a multipart result."),
    field<&Order::light>("Index of the light of a bakeFile."), field<&Order::traceId>("Of the request, for the log."),
    field<&Order::depthRange>("Of a sensor that sees depths."),
    field<&Order::labels>("Colors of materials are wanted."));

template <>
inline constexpr auto kRows<Cancel> = rows("Cancel", "Cancels an order.", field<&Cancel::number>("The order."));

template <>
inline constexpr auto kRows<Forget> = rows("Forget", "A scene was deleted.", field<&Forget::scene>("Its id."));

template <>
inline constexpr auto kRows<LightMapFound> = rows("LightMapFound", "Answers a request.",
                                                  field<&LightMapFound::number>("The request."));

template <>
inline constexpr auto kRows<ToWorker> = rows("ToWorker", "A message to a worker.",
                                             field<&ToWorker::start>("The first."), field<&ToWorker::order>("Work."),
                                             field<&ToWorker::cancel>("Work that is cancelled."),
                                             field<&ToWorker::forget>("A deleted scene."),
                                             field<&ToWorker::lightMap>("An answered request."));

template <>
inline constexpr auto kRows<Outcome> = rows("Outcome", "The result of an order.", field<&Outcome::number>("The order."),
                                            field<&Outcome::problems>("Why there is no result."),
                                            field<&Outcome::retryAfterSeconds>("When to ask again.",
                                                                               {.unit = "seconds"}),
                                            field<&Outcome::damaged>("The bundle is not the one that the id names."),
                                            field<&Outcome::contentType>("Of the result."),
                                            field<&Outcome::stages>("What took how long.", {.unit = "milliseconds"}),
                                            field<&Outcome::warnings>("Of a frame's report."),
                                            field<&Outcome::note>("For the log alone."));

template <>
inline constexpr auto kRows<OrderEvent> = rows("OrderEvent", "A server-sent event of an order.",
                                               field<&OrderEvent::number>("The order."),
                                               field<&OrderEvent::name>("Of the event."),
                                               field<&OrderEvent::data>("JSON."));

template <>
inline constexpr auto kRows<Beat> = rows("Beat", "A sign of life.", field<&Beat::scenes>("Loaded scenes."),
                                         field<&Beat::sceneBytes>("Of them.", {.unit = "bytes"}),
                                         field<&Beat::reusedMeshes>("Found in other scenes."),
                                         field<&Beat::reusedImages>("The same of images."),
                                         field<&Beat::costFactors>("Of each part of a frame.",
                                                                   {.unit = "milliseconds"}));

template <>
inline constexpr auto kRows<Refusal> = rows("Refusal", "A worker that can't start.",
                                            field<&Refusal::problems>("Why not."));

template <>
inline constexpr auto kRows<LightMapRequest> = rows("LightMapRequest", "Asks for a stored light map.",
                                                    field<&LightMapRequest::number>("Names it."),
                                                    field<&LightMapRequest::key>("Of the light map."));

template <>
inline constexpr auto kRows<LightMapMade> = rows("LightMapMade", "A light map to be stored.",
                                                 field<&LightMapMade::key>("Of the light map."));

template <>
inline constexpr auto kRows<ToFront> = rows("ToFront", "A message to the front.", field<&ToFront::ready>("What draws."),
                                            field<&ToFront::refusal>("Why nothing draws."),
                                            field<&ToFront::outcome>("The result of an order."),
                                            field<&ToFront::event>("An order's progress."),
                                            field<&ToFront::beat>("A sign of life."),
                                            field<&ToFront::request>("A light map that is wanted."),
                                            field<&ToFront::made>("A light map that was made."));

} // namespace gnomon
