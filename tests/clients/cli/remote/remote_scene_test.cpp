#include "clients/cli/remote/remote_scene.h"

#include <gtest/gtest.h>
#include <string_view>

#include "protocol/base/scene_bundle.h"

namespace gnomon::cli {
namespace {

Bytes bytesOf(std::string_view text) {
  return {text.begin(), text.end()};
}

TEST(UploadBody, AModelAloneIsItsBytesAndItsIdIsTheirHash) {
  const SceneBundle bundle{bytesOf("glTF..."), {}};
  EXPECT_EQ(uploadBody(bundle).contentType, "model/gltf-binary");
  EXPECT_EQ(uploadBody(bundle).bytes, "glTF...");
  EXPECT_EQ(uploadBody({bytesOf("{}"), {}}).contentType, "model/gltf+json");
  EXPECT_EQ(modelId(bytesOf("abc")), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"); // FIPS 180-2
}

TEST(SceneId, IsTheHashOfAModel) {
  const std::string id = modelId(bytesOf("abc"));
  EXPECT_TRUE(isSceneId(id));
  std::string inCapitals = id;
  inCapitals[0] = 'B';
  for (const std::string& text : {id.substr(1), id + "0", id.substr(1) + "/", inCapitals, std::string("scene.glb")}) {
    EXPECT_FALSE(isSceneId(text)) << text;
  }
}

TEST(UploadBody, FilesAreNamedParts) {
  const UploadBody upload = uploadBody({bytesOf("{}"), {{"textures/a \"b\".png", bytesOf("image")}}});
  EXPECT_EQ(upload.contentType, "multipart/form-data; boundary=gnomon-part-boundary");
  EXPECT_EQ(upload.bytes,
            "--gnomon-part-boundary\r\nContent-Disposition: form-data; name=\"scene\"; filename=\"scene\"\r\n\r\n{}\r\n"
            "--gnomon-part-boundary\r\nContent-Disposition: form-data; name=\"file\"; "
            "filename=\"textures/a %22b%22.png\"\r\n\r\nimage\r\n--gnomon-part-boundary--\r\n");
}

TEST(UploadBody, TheBoundaryOccursInNoPart) {
  const UploadBody upload =
      uploadBody({bytesOf("gnomon-part-boundary"), {{"a", bytesOf("x gnomon-part-boundary-0 y")}}});
  EXPECT_EQ(upload.contentType, "multipart/form-data; boundary=gnomon-part-boundary-1");
}

TEST(PauseAfter, IsWhatTheServerAsksForOrNothing) {
  using std::chrono::seconds;
  const auto replied = [](int status, int retryAfter) {
    return Result<HttpReply>(HttpReply{status, "", "", retryAfter});
  };
  EXPECT_EQ(pauseAfter(replied(429, 7), true), seconds(7));
  EXPECT_EQ(pauseAfter(replied(429, 0), true), seconds(1));
  EXPECT_EQ(pauseAfter(replied(503, 3), true), seconds(3));
  for (const int status : {200, 400, 404, 500, 503, 504}) EXPECT_EQ(pauseAfter(replied(status, 0), true), std::nullopt);
  const Result<HttpReply> away = Problem{ProblemCode::unavailable, "", "There was no reply.", "", ""};
  EXPECT_EQ(pauseAfter(away, true), seconds(1));
  EXPECT_EQ(pauseAfter(away, false), std::nullopt);
  const Result<HttpReply> wrong = Problem{ProblemCode::invalidValue, "", "This is not an address.", "", ""};
  EXPECT_EQ(pauseAfter(wrong, true), std::nullopt);
}

} // namespace
} // namespace gnomon::cli
