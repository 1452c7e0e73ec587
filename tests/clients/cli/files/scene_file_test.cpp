#include "clients/cli/files/scene_file.h"

#include <fstream>
#include <gmock/gmock.h>

#include "clients/cli/files/file_io.h"

namespace gnomon::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
namespace fs = std::filesystem;

/// A folder with model/ in it and secret.bin beside that, gone with the test.
class SceneFile : public testing::Test {
 protected:
  SceneFile() {
    std::string pattern = (fs::temp_directory_path() / "gnomon-scene-file-XXXXXX").string();
    root_ = ::mkdtemp(pattern.data());
    fs::create_directories(root_ / "model" / "textures");
    write("secret.bin", "secret");
  }
  ~SceneFile() override { fs::remove_all(root_); }

  void write(const fs::path& name, const std::string& text) { std::ofstream(root_ / name, std::ios::binary) << text; }

  Result<SceneBundle> readWithUri(const std::string& uri, const SceneFileOptions& options = {}) {
    write("model/a.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"uri": ")" + uri + R"("}]})");
    return readSceneFile(root_ / "model" / "a.gltf", options);
  }

  fs::path root_;
};

Bytes bytesOf(const std::string& text) {
  return {text.begin(), text.end()};
}

TEST_F(SceneFile, ReadsTheFilesThatTheModelNames) {
  write("model/a b.bin", "buffer");
  write("model/textures/c.png", "image");
  write("model/other.bin", "not named");
  write("model/a.gltf", R"({"buffers": [{"uri": "a%20b.bin"}, {"uri": "data:,x"}], "images": [{"uri": "textures/c.png"},
                            {"uri": "textures/c.png"}], "extras": {"uri": "other.bin"}})");
  const auto bundle = readSceneFile(root_ / "model" / "a.gltf");
  ASSERT_TRUE(bundle);
  EXPECT_EQ(bundle->files,
            (std::map<std::string, Bytes>{{"a b.bin", bytesOf("buffer")}, {"textures/c.png", bytesOf("image")}}));
}

TEST_F(SceneFile, RefusesNamesThatLeadOutOfTheFolderAndSaysWhichFlagAllowsThem) {
  for (const std::string uri : {"../secret.bin", "textures/../../secret.bin", "%2e%2e/secret.bin", "..%2fsecret.bin",
                                "/etc/passwd", "file:///etc/passwd", "..\\\\secret.bin"}) {
    const auto bundle = readWithUri(uri);
    ASSERT_FALSE(bundle) << uri;
    EXPECT_EQ(bundle.problems().front().code, ProblemCode::invalidScene) << uri;
    EXPECT_NE(bundle.problems().front().limit.find("--allow-outside-files"), std::string::npos) << uri;
    const auto allowed = readWithUri(uri, {.allowOutsideFiles = true});
    ASSERT_TRUE(allowed) << uri;
    ASSERT_EQ(allowed->files.size(), 1u) << uri;
    EXPECT_TRUE(allowed->files.begin()->first.starts_with(uri.find("passwd") == std::string::npos ? "_up/" : "_root/"));
  }
}

TEST_F(SceneFile, ReadsNamesWithBackslashesAndDetoursInTheFolder) {
  write("model/textures/c.png", "image");
  for (const std::string uri : {"textures\\\\c.png", ".\\\\textures/c.png", "textures/../textures//c.png"}) {
    const auto bundle = readWithUri(uri);
    ASSERT_TRUE(bundle) << uri;
    EXPECT_EQ(bundle->files, (std::map<std::string, Bytes>{{"textures/c.png", bytesOf("image")}})) << uri;
  }
}

TEST_F(SceneFile, LeavesWhatIsNoFileAndWhatIsMissingToTheLoader) {
  for (const std::string uri : {"gone.bin", "../gone.bin", "/gone/x.bin", "textures", "http://127.0.0.1/x", "", "a%zz",
                                "a%00b", "c:\\\\x.bin"}) {
    const auto bundle = readWithUri(uri);
    ASSERT_TRUE(bundle) << uri;
    EXPECT_THAT(bundle->files, IsEmpty()) << uri;
  }
}

TEST_F(SceneFile, AModelThatHasToConformSaysSo) {
  EXPECT_FALSE(readWithUri("gone.bin")->strict);
  EXPECT_TRUE(readWithUri("gone.bin", {.strict = true})->strict);
}

TEST_F(SceneFile, RefusesLinksThatLeadOutOfTheFolder) {
  fs::create_symlink(root_ / "secret.bin", root_ / "model" / "link.bin");
  fs::create_directory_symlink(root_, root_ / "model" / "up");
  EXPECT_FALSE(readWithUri("link.bin"));
  EXPECT_FALSE(readWithUri("up/secret.bin"));
  write("model/inside.bin", "inside");
  fs::create_symlink("inside.bin", root_ / "model" / "to_inside.bin");
  EXPECT_TRUE(readWithUri("to_inside.bin"));
}

TEST_F(SceneFile, HoldsEveryFileAgainstTheLimitTogether) {
  write("model/a.bin", std::string(60, 'a'));
  write("model/b.bin", std::string(60, 'b'));
  const std::string text = R"({"buffers": [{"uri": "a.bin"}, {"uri": "b.bin"}]})";
  write("model/a.gltf", text);
  Limits limits;
  limits.maxSceneBytes = text.size() + 120;
  EXPECT_TRUE(readSceneFile(root_ / "model" / "a.gltf", {}, {}, limits));
  limits.maxSceneBytes -= 1;
  const auto bundle = readSceneFile(root_ / "model" / "a.gltf", {}, {}, limits);
  ASSERT_FALSE(bundle);
  EXPECT_EQ(bundle.problems().front().code, ProblemCode::tooLarge);
  limits = Limits{};
  limits.maxBundleFiles = 1;
  EXPECT_FALSE(readSceneFile(root_ / "model" / "a.gltf", {}, {}, limits));
}

FrameSpec litBy(const std::string& file) {
  FrameSpec spec;
  spec.environment.file = file;
  return spec;
}

TEST_F(SceneFile, AnEnvironmentOfAFlagComesFromAnywhereAndOneOfARequestFromTheModelsFolder) {
  write("model/a.glb", "glTF");
  write("sky.hdr", "elsewhere");
  const fs::path model = root_ / "model" / "a.glb", elsewhere = root_ / "sky.hdr";
  const auto bundle = readSceneFile(model, {}, requestFiles(litBy("sky.hdr"), elsewhere.string()));
  ASSERT_TRUE(bundle);
  EXPECT_EQ(bundle->files, (std::map<std::string, Bytes>{{"sky.hdr", bytesOf("elsewhere")}}));
  const auto missing = readSceneFile(model, {}, requestFiles(litBy("sky.hdr"), std::nullopt));
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.problems().front().pointer, (root_ / "model/sky.hdr").string());
  write("model/sky.hdr", "beside");
  EXPECT_EQ(readSceneFile(model, {}, requestFiles(litBy("sky.hdr"), std::nullopt))->files.at("sky.hdr"),
            bytesOf("beside"));
  const auto outside = readSceneFile(model, {}, requestFiles(litBy("../sky.hdr"), std::nullopt));
  ASSERT_FALSE(outside);
  EXPECT_EQ(outside.problems().front().pointer, "/environment/file");
  EXPECT_EQ(placesOf(requestFiles(litBy("sky.hdr"), elsewhere.string()), "x"), std::vector<fs::path>{elsewhere});
  EXPECT_EQ(placesOf(requestFiles(litBy("sky.hdr"), "sky"), "x"), std::vector<fs::path>{"x/sky.hdr"});
}

TEST_F(SceneFile, AnEnvironmentThatHasTheNameOfAnotherFileOfTheModelIsRefused) {
  write("model/a.gltf", R"({"images": [{"uri": "sky.exr"}]})");
  write("model/sky.exr", "the model's");
  write("sky.exr", "another");
  const fs::path model = root_ / "model" / "a.gltf";
  const auto read = [&](const fs::path& file) {
    return readSceneFile(model, {}, requestFiles(litBy("sky.exr"), file.string()));
  };
  EXPECT_EQ(read(root_ / "model/sky.exr")->files.at("sky.exr"), bytesOf("the model's"));
  const auto refused = read(root_ / "sky.exr");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.problems().front().pointer, "/environment/file");
}

TEST_F(SceneFile, AModelWithoutFilesIsItsBytes) {
  write("model/a.glb", "glTF and whatever comes");
  const auto bundle = readSceneFile(root_ / "model" / "a.glb");
  ASSERT_TRUE(bundle);
  EXPECT_EQ(bundle->model, bytesOf("glTF and whatever comes"));
  EXPECT_THAT(bundle->files, IsEmpty());
}

TEST_F(SceneFile, WritesInOneStepAndLeavesNothingBehind) {
  const fs::path target = root_ / "frame.png";
  ASSERT_TRUE(writeFile(target.string(), bytesOf("first")));
  ASSERT_TRUE(writeFile(target.string(), bytesOf("second")));
  EXPECT_EQ(*readFile(target, 100), bytesOf("second"));
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 3); // model, secret.bin, frame.png
  EXPECT_FALSE(writeFile((target / "frame.png").string(), bytesOf("x"))) << "a file is no folder";
  EXPECT_FALSE(writeFile((root_ / "model").string(), bytesOf("x")));
  EXPECT_EQ(std::distance(fs::directory_iterator(root_), {}), 3);
}

std::vector<std::string> urisOf(const std::string& model) {
  return externalUris(bytesOf(model));
}

std::string glb(const std::string& json, std::uint32_t claimedLength) {
  std::string bytes = "glTF";
  const auto add = [&](std::uint32_t number) {
    for (int i = 0; i < 4; ++i) bytes += static_cast<char>(number >> 8 * i & 0xff);
  };
  add(2);
  add(static_cast<std::uint32_t>(20 + json.size()));
  add(claimedLength);
  return bytes + "JSON" + json;
}

TEST(ExternalUris, AreThoseOfBuffersAndImagesOnly) {
  const std::string json = R"({"images": [{"name": "x", "extras": {"uri": "no"}, "uri": "i.png"}, {"uri": 3}],
      "uri": "no", "nodes": [{"uri": "no"}], "buffers": [{"byteLength": 1, "uri": "b.bin"}, {"uri": "data:,"}]})";
  EXPECT_THAT(urisOf(json), ElementsAre("i.png", "b.bin"));
  EXPECT_THAT(urisOf(glb(json, static_cast<std::uint32_t>(json.size()))), ElementsAre("i.png", "b.bin"));
}

TEST(ExternalUris, AreNoneOfWhatCantBeRead) {
  const std::string json = R"({"buffers": [{"uri": "b.bin"}]})";
  EXPECT_THAT(urisOf(""), IsEmpty());
  EXPECT_THAT(urisOf("glT"), IsEmpty());
  EXPECT_THAT(urisOf("glTF"), IsEmpty());
  EXPECT_THAT(urisOf(glb(json, 0xffffffff)), IsEmpty());
  EXPECT_THAT(urisOf(json.substr(0, json.size() - 1)), IsEmpty());
  EXPECT_THAT(urisOf(std::string(20'000, '[')), IsEmpty());
  EXPECT_THAT(urisOf(R"({"a": )" + std::string(20'000, '[')), IsEmpty());
}

} // namespace
} // namespace gnomon::cli
