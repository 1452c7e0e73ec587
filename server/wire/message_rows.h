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
    plainRows<&WorkerOptions::device, &WorkerOptions::backend, &WorkerOptions::requireGpu,
              &WorkerOptions::gpuSceneBytes, &WorkerOptions::tileCacheBytes, &WorkerOptions::tracedSceneBytes,
              &WorkerOptions::lightMapBytes, &WorkerOptions::volumeBytes, &WorkerOptions::environmentBytes,
              &WorkerOptions::sceneMemoryBytes, &WorkerOptions::frameMemoryBytes, &WorkerOptions::maxSceneBytes,
              &WorkerOptions::memoryBytes, &WorkerOptions::vdbBytes, &WorkerOptions::keepsLightMaps>("WorkerOptions");

template <>
inline constexpr auto kRows<SensorRange> = plainRows<&SensorRange::min, &SensorRange::max>("SensorRange");

template <>
inline constexpr auto kRows<Order> =
    plainRows<&Order::number, &Order::kind, &Order::scene, &Order::isStored, &Order::strict, &Order::milliseconds,
              &Order::queuedMilliseconds, &Order::mediaType, &Order::boundary, &Order::light, &Order::traceId,
              &Order::depthRange, &Order::labels>("Order");

template <>
inline constexpr auto kRows<Cancel> = plainRows<&Cancel::number>("Cancel");

template <>
inline constexpr auto kRows<Forget> = plainRows<&Forget::scene>("Forget");

template <>
inline constexpr auto kRows<LightMapFound> = plainRows<&LightMapFound::number>("LightMapFound");

template <>
inline constexpr auto kRows<ToWorker> = plainRows<&ToWorker::start, &ToWorker::order, &ToWorker::cancel,
                                                  &ToWorker::forget, &ToWorker::lightMap>("ToWorker");

template <>
inline constexpr auto kRows<Outcome> =
    plainRows<&Outcome::number, &Outcome::problems, &Outcome::retryAfterSeconds, &Outcome::damaged,
              &Outcome::contentType, &Outcome::stages, &Outcome::warnings, &Outcome::note>("Outcome");

template <>
inline constexpr auto kRows<OrderEvent> =
    plainRows<&OrderEvent::number, &OrderEvent::name, &OrderEvent::data>("OrderEvent");

template <>
inline constexpr auto kRows<Beat> =
    plainRows<&Beat::scenes, &Beat::sceneBytes, &Beat::reusedMeshes, &Beat::reusedImages, &Beat::costFactors>("Beat");

template <>
inline constexpr auto kRows<Refusal> = plainRows<&Refusal::problems>("Refusal");

template <>
inline constexpr auto kRows<LightMapRequest> =
    plainRows<&LightMapRequest::number, &LightMapRequest::key>("LightMapRequest");

template <>
inline constexpr auto kRows<LightMapMade> = plainRows<&LightMapMade::key>("LightMapMade");

template <>
inline constexpr auto kRows<ToFront> = plainRows<&ToFront::ready, &ToFront::refusal, &ToFront::outcome, &ToFront::event,
                                                 &ToFront::beat, &ToFront::request, &ToFront::made>("ToFront");

} // namespace gnomon
