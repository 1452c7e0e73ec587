// Pictures of cameras whose principal point is not in the middle: they are crops of larger pictures, and show points
// where the formula of calibration says.
#include <algorithm>
#include <cmath>

#include "protocol/spec/enum_rows.h"
#include "tests/renderer/frame_fixture.h"
#include "tests/renderer/made_grids.h"

namespace gnomon {
namespace {

using testing::floatsOf;
using testing::renderJson;

constexpr int kWidth = 160;
constexpr int kHeight = 96;
constexpr double kFocal = 260;

/// Rows of a matrix that takes a camera's space, as OpenCV has it, into the world.
Json poseFrom(const glm::dvec3& eye, const glm::dvec3& target) {
  const glm::dvec3 ahead = glm::normalize(target - eye);
  const glm::dvec3 right = glm::normalize(glm::cross(ahead, glm::dvec3(0, 1, 0)));
  const glm::dvec3 down = glm::cross(ahead, right);
  Json rows = Json::array();
  for (int i = 0; i < 3; ++i) rows.push_back({right[i], down[i], ahead[i], eye[i]});
  rows.push_back({0, 0, 0, 1});
  return {{"worldFromCamera", rows}, {"axes", "opencv"}};
}

/// Seen twice as wide and high, so that every quarter has a part of the box and of its shadow.
Json wholeSpec(const Json& patch = {}) {
  Json spec{{"width", 2 * kWidth},
            {"height", 2 * kHeight},
            {"camera",
             {{"pose", poseFrom({4, 4, 6.5}, {-0.6, 0.7, -0.4})}, {"intrinsics", {{"fx", kFocal}, {"fy", kFocal}}}}},
            {"lights", {{{"type", "directional"}, {"sun", {{"azimuthDegrees", 60}, {"elevationDegrees", 40}}}}}},
            {"shadow", {{"technique", "rayTraced"}}},
            {"antialiasing", "none"},
            {"output", {{"format", "exr"}, {"exrPixelType", "float"}}}};
  if (!patch.is_null()) spec.merge_patch(patch);
  return spec;
}

/// A rectangle of a picture, from its upper left corner.
struct Crop {
  int left = 0, top = 0, width = 0, height = 0;
};

/// The same camera, with no more than the crop.
Json cropped(Json spec, const Crop& crop) {
  Json& lens = spec["camera"]["intrinsics"];
  const auto middleOf = [&](const char* side) { return (spec[side].get<double>() - 1) / 2; };
  const double cx = lens.value("cx", middleOf("width"));
  const double cy = lens.value("cy", middleOf("height"));
  lens["cx"] = cx - crop.left;
  lens["cy"] = cy - crop.top;
  spec["width"] = crop.width;
  spec["height"] = crop.height;
  return spec;
}

/// Of a view's pixels, those that differ between a picture and the crop of a larger one by more than `tolerance` of
/// what they hold; and those that show a surface.
struct Compared {
  double differ = 0, shown = 0; ///< shares
};

Compared compare(const Image& whole, const Image& part, const Crop& crop, double tolerance) {
  const auto& a = std::get<std::vector<float>>(whole.pixels);
  const auto& b = std::get<std::vector<float>>(part.pixels);
  const std::size_t channels = part.channels.size();
  EXPECT_EQ(whole.channels, part.channels);
  Compared compared;
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const auto at = [&](const Image& image, int column, int row) {
        return (static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                static_cast<std::size_t>(column)) *
               channels;
      };
      const float* of = a.data() + at(whole, crop.left + x, crop.top + y);
      const float* in = b.data() + at(part, x, y);
      const bool same = std::equal(of, of + channels, in, [&](float one, float other) {
        return one == other || std::abs(one - other) <= tolerance * (1 + std::abs(one));
      });
      compared.differ += same ? 0 : 1;
      compared.shown += std::any_of(in, in + channels, [](float v) { return v != 0 && std::isfinite(v); }) ? 1 : 0;
    }
  }
  const double count = static_cast<double>(crop.width) * crop.height;
  return {compared.differ / count, compared.shown / count};
}

/// Devices find depths and points in floats, relative to pixels that the two pictures number differently: values differ
/// in their last digits. Where an edge passes through the middle of a pixel within those digits, the pixel may show
/// either side.
void expectCrop(const ScenePtr& scene, const Json& spec, const Crop& crop, double tolerance = 1e-4,
                double most = 1e-3) {
  const Frame whole = renderJson(scene, spec.dump());
  const Frame part = renderJson(scene, cropped(spec, crop).dump());
  ASSERT_EQ(whole.images.size(), part.images.size());
  for (std::size_t i = 0; i < part.images.size(); ++i) {
    const Compared compared = compare(whole.images[i].image, part.images[i].image, crop, tolerance);
    EXPECT_LE(compared.differ, most) << spell(part.images[i].view) << ' ' << crop.left << ' ' << crop.top;
    EXPECT_GT(compared.shown, 0.02) << spell(part.images[i].view) << ' ' << crop.left << ' ' << crop.top;
  }
}

const std::vector<Crop> kQuarters{{0, 0, kWidth, kHeight},
                                  {kWidth, 0, kWidth, kHeight},
                                  {0, kHeight, kWidth, kHeight},
                                  {kWidth, kHeight, kWidth, kHeight}};

TEST(CalibratedCameras, AnOffCentrePictureIsTheCropOfALargerOne) {
  const Json spec = wholeSpec({{"views", {"color", "depth", "position", "normal", "shadow", "reference", "ids"}}});
  for (const Crop& quarter : kQuarters) expectCrop(testing::generatedScene("box_on_plane"), spec, quarter);
}

TEST(CalibratedCameras, APictureWhollyBesideTheAxisIsTheCropOfAVeryWideOne) {
  // The box is 79 degrees to the right of the view axis.
  const double turn = glm::radians(79.0);
  const glm::dvec3 eye(0, 1.2, 7);
  Json spec = wholeSpec({{"width", 1340}, {"height", 100}, {"views", {"color", "depth", "position", "shadow"}}});
  spec["camera"]["pose"] = poseFrom(eye, eye + glm::dvec3(-std::sin(turn), 0, -std::cos(turn)));
  spec["camera"]["intrinsics"] = {{"fx", 100}, {"fy", 100}, {"cy", -20}};
  const Crop right{1020, 0, 320, 100};
  ASSERT_EQ(cropped(spec, right)["camera"]["intrinsics"]["cx"], 669.5 - 1020);
  expectCrop(testing::generatedScene("box_on_plane"), spec, right, 1e-3);
}

/// Where the picture shows a point, by the formula of calibration; pixels, the first one's centre at 0.
glm::dvec2 openCvPixel(const Json& camera, const glm::dvec3& point) {
  const Json& rows = camera["pose"]["worldFromCamera"];
  glm::dvec3 seen(0); // X, Y, Z in the camera's space
  for (int axis = 0; axis < 3; ++axis) {
    for (int i = 0; i < 3; ++i) seen[axis] += rows[i][axis].get<double>() * (point[i] - rows[i][3].get<double>());
  }
  const Json& lens = camera["intrinsics"];
  return {lens["fx"].get<double>() * seen.x / seen.z + lens["cx"].get<double>(),
          lens["fy"].get<double>() * seen.y / seen.z + lens["cy"].get<double>()};
}

TEST(CalibratedCameras, PointsShowWhereTheFormulaOfCalibrationSays) {
  const glm::dvec3 eye(4, 4, 6.5);
  const double turn = glm::radians(70.0);
  const auto aside = [&](double fx, double fy, double cx, double cy) {
    return Json{{"pose", poseFrom(eye, eye + glm::dvec3(-std::sin(0.6 + turn), -0.3, -std::cos(0.6 + turn)))},
                {"intrinsics", {{"fx", fx}, {"fy", fy}, {"cx", cx}, {"cy", cy}}}};
  };
  const auto ahead = [&](double fx, double fy, double cx, double cy) {
    Json camera = aside(fx, fy, cx, cy);
    camera["pose"] = poseFrom(eye, {0, 0, 0});
    return camera;
  };
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  for (const Json& camera : {ahead(kFocal, kFocal, 40, 70), ahead(kFocal, 2.5 * kFocal, 200, -30),
                             ahead(0.3 * kFocal, kFocal, 79.5, 47.5), aside(1820, 1820, -5000, -1400)}) {
    Json spec = wholeSpec({{"width", kWidth}, {"height", kHeight}, {"views", {"position"}}});
    spec["camera"] = camera;
    const Frame frame = renderJson(scene, spec.dump());
    const std::vector<float>& points = floatsOf(frame);
    int found = 0;
    for (int row = 0; row < kHeight; ++row) {
      for (int column = 0; column < kWidth; ++column) {
        const float* p =
            points.data() + 3 * (static_cast<std::size_t>(row) * kWidth + static_cast<std::size_t>(column));
        if (!std::isfinite(p[0])) continue;
        ++found;
        const glm::dvec2 at = openCvPixel(camera, {p[0], p[1], p[2]});
        ASSERT_NEAR(at.x, column, 0.02) << camera.dump();
        ASSERT_NEAR(at.y, row, 0.02) << camera.dump();
      }
    }
    EXPECT_GT(found, kWidth * kHeight / 4) << camera.dump();
  }
}

/// Share of a crop's pixels where a map's shadow is on the wrong side of one half.
double wrongShare(const Frame& frame, const Crop& crop) {
  const Image& image = frame.images[0].image;
  double wrong = 0;
  for (int y = 0; y < crop.height; ++y) {
    for (int x = 0; x < crop.width; ++x) {
      const auto at = static_cast<std::size_t>(crop.top + y) * static_cast<std::size_t>(image.width) +
                      static_cast<std::size_t>(crop.left + x);
      wrong += std::abs(floatsOf(frame)[at]) > 0.5f ? 1 : 0;
    }
  }
  return wrong / (static_cast<double>(crop.width) * crop.height);
}

TEST(CalibratedCameras, ShadowMapsAreNoWorseOffCentreThanInTheWholePicture) {
  const ScenePtr scene = testing::generatedScene("box_on_plane");
  for (const char* stabilization : {"none", "projectionSnapping", "viewSnapping"}) {
    const Json spec =
        wholeSpec({{"views", {"error"}}, {"shadow", {{"technique", "shadowMap"}, {"stabilization", stabilization}}}});
    const Frame whole = renderJson(scene, spec.dump());
    for (const Crop& quarter : kQuarters) {
      const Frame part = renderJson(scene, cropped(spec, quarter).dump());
      EXPECT_LE(wrongShare(part, {0, 0, kWidth, kHeight}), 1.1 * wrongShare(whole, quarter) + 1e-3)
          << stabilization << ' ' << quarter.left << ' ' << quarter.top;
    }
  }
}

TEST(CalibratedCameras, ListsOfLightsHoldOffCentre) {
  Json lamps = Json::array();
  for (int i = 0; i < 40; ++i) {
    const double angle = i * 2.39996, away = 1.5 + 0.15 * i;
    lamps.push_back({{"type", "point"},
                     {"position", {away * std::cos(angle), 0.5 + i % 3, away * std::sin(angle)}},
                     {"range", 2.0 + i % 3},
                     {"intensity", 5}});
  }
  const Json spec = wholeSpec({{"lights", lamps}, {"shadow", {{"enabled", false}}}, {"ambient", {{"intensity", 0}}}});
  for (const Crop& quarter : kQuarters) expectCrop(testing::generatedScene("box_on_plane"), spec, quarter, 1e-3);
}

TEST(CalibratedCameras, VolumesAreWhereTheCropHasThem) {
  testing::GlbBuilder builder = testing::plane();
  builder.json["nodes"][0]["scale"] = {50, 1, 50};
  SceneBundle bundle = builder.bundle();
  bundle.files["hill.npy"] = testing::byteGrid(6, 5, 4, [](int x, int y, int z) { return 40 * x + 8 * y + 5 * z; });
  const Json volume{
      {"file", "hill.npy"},
      {"box", {{"min", {-2, 0.5, -2}}, {"max", {2, 3, 2}}}},
      {"transferFunction",
       {{{"value", 0}, {"extinction", 0}}, {{"value", 255}, {"color", {1, 0.5, 0.25}}, {"extinction", 0.6}}}}};
  const Json spec = wholeSpec(
      {{"volumes", Json::array({volume})}, {"shadow", {{"technique", "shadowMap"}}}, {"views", {"color", "shadow"}}});
  for (const Crop& quarter : kQuarters) expectCrop(testing::sceneOf(bundle), spec, quarter, 2e-3, 2e-3);
}

} // namespace
} // namespace gnomon
