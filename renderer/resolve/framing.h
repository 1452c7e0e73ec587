#pragma once

#include <optional>

#include "renderer/core/camera_view.h"
#include "renderer/resolve/seen_extent.h"

/// Position of a camera with a given direction, so that everything is in its picture, and nothing more.
namespace gnomon {

/// What is to be seen. `center` is any point amid it, from which lengths are measured; `radius` is about its size, more
/// than 0, metres.
struct FramedSubject {
  Farthest farthest;
  glm::dvec3 center{0};
  double radius = 1;
};

/// Of what lies in these bounds; without `farthest` all of their box is to be seen. Where there is nothing, a metre
/// around the origin is.
FramedSubject subjectOf(const Aabb& bounds, Farthest farthest = {});

/// The eye from which the picture shows all of the subject as large as it may be, in the middle: of two sides that face
/// each other both keep the same margin, and of one of the two pairs this is kFramingMargin of the picture's shorter
/// side. For a perspective view each side is a plane that the subject's convex hull touches, which makes the eye's
/// depth the solution of a linear program (as Lengyel does in "Fitting a camera to points"); the eye's place across is
/// where both margins are equal. An orthographic view has the subject in the middle, and is well before it. Nothing
/// where the axis does not lie in the picture. `view`: its axes and its lens count.
std::optional<glm::dvec3> framingEye(const CameraView& view, const FramedSubject& subject);

/// The least distance from a target at which the picture shows all of the subject, of each side's
/// way from the axis twice kFramingMargin left; an orthographic view is well before the subject. Nothing where the
/// axis does not lie in the picture, so that no distance does.
std::optional<double> framingDistance(const CameraView& view, const glm::dvec3& target, const FramedSubject& subject);

inline constexpr double kFramingMargin = 0.025; ///< of the picture's shorter side, at each side

} // namespace gnomon
