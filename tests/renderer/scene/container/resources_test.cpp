#include "renderer/scene/container/resources.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

using ::testing::ElementsAre;

Bytes contentOf(std::string_view uri, const SceneBundle& bundle = {}) {
  const auto bytes = resolveUri(uri, bundle, "/x");
  EXPECT_TRUE(bytes) << uri;
  return bytes ? Bytes(bytes->view().begin(), bytes->view().end()) : Bytes{};
}

TEST(ResourceBytes, ReadsDataUris) {
  EXPECT_EQ(contentOf("data:application/octet-stream;base64,AQID"), (Bytes{1, 2, 3}));
  EXPECT_EQ(contentOf("data:,a%20b"), (Bytes{'a', ' ', 'b'}));
  EXPECT_FALSE(resolveUri("data:;base64,!!!!", {}, "/x"));
  EXPECT_FALSE(resolveUri("data:application/octet-stream", {}, "/x"));
  EXPECT_FALSE(resolveUri("data:,%4", {}, "/x"));
}

TEST(ResourceBytes, KeepsDecodedBytesWhenMoved) {
  ResourceBytes first(Bytes{1, 2, 3});
  const ResourceBytes second = std::move(first);
  EXPECT_THAT(second.view(), ElementsAre(1, 2, 3));
}

TEST(ResourceBytes, FindsFilesOfTheBundle) {
  const SceneBundle bundle{{}, {{"a b.bin", {7}}, {"textures/c.png", {8}}}};
  EXPECT_EQ(contentOf("a%20b.bin", bundle), Bytes{7});
  EXPECT_EQ(contentOf("./a%20b.bin", bundle), Bytes{7});
  EXPECT_EQ(contentOf("textures/c.png", bundle), Bytes{8});
  EXPECT_EQ(contentOf("textures\\c.png", bundle), Bytes{8});
  EXPECT_EQ(contentOf(".\\textures%5Cc.png", bundle), Bytes{8});
  EXPECT_EQ(contentOf("textures/../textures//./c.png", bundle), Bytes{8});
}

TEST(ResourceBytes, OpensNothingElse) {
  // Files by these very names are in the bundle: the refusal does not hang on what exists.
  SceneBundle bundle;
  for (const char* name : {"../x", "a/../../x", "..", "/etc/passwd", "\\\\host\\x", "a\\x", "file:///etc/passwd",
                           "http://localhost/x", "//host/x"}) {
    bundle.files[name] = {1};
  }
  for (const char* uri : {"file:///etc/passwd", "http://localhost/x", "https://a/x", "FILE:x", "c:x"}) {
    EXPECT_THAT(resolveUri(uri, bundle, "/x").problems(), ElementsAre(ProblemAt(ProblemCode::unsupportedFeature, "/x")))
        << uri;
  }
  for (const char* uri : {"../x", "a/../../x", "..", "%2e%2e/x", "..%2Fx", "/etc/passwd", "%2Fetc/passwd", "//host/x",
                          "\\\\host\\x", "a%5Cx", "a%00b", "", "a%0Ab"}) {
    EXPECT_THAT(resolveUri(uri, bundle, "/x").problems(), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/x")))
        << uri;
  }
}

TEST(ResourceBytes, TakesFilesOfOtherFoldersWhereTheBundleBringsThem) {
  const SceneBundle bundle{{}, {{"_up/x.bin", {1}}, {"_up/_up/x.bin", {2}}, {"_root/a/x.bin", {3}}}};
  EXPECT_EQ(contentOf("../x.bin", bundle), Bytes{1});
  EXPECT_EQ(contentOf("a/../../../x.bin", bundle), Bytes{2});
  EXPECT_EQ(contentOf("/a/x.bin", bundle), Bytes{3});
  EXPECT_EQ(contentOf("file:///a/b/../x.bin", bundle), Bytes{3});
}

TEST(ResourceBytes, TellsOfBackslashes) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "data\\cube.bin"}}};
  SceneBundle bundle = bundleOf(builder.json.dump());
  bundle.files["data/cube.bin"] = builder.binary;
  EXPECT_THAT(load(bundle).summary.warnings, ElementsAre(::testing::HasSubstr("backslash")));
  bundle.strict = true;
  EXPECT_THAT(problemsOf(bundle), ElementsAre(ProblemAt(ProblemCode::invalidScene, "/buffers/0/uri")));
}

TEST(ResourceBytes, UrisOfBuffersAndImagesAreToldWithTheirPlace) {
  testing::GlbBuilder builder;
  builder.add("buffers", {{"byteLength", 4}, {"uri", "../../etc/passwd"}});
  builder.add("buffers", {{"byteLength", 4}, {"uri", "missing.bin"}});
  builder.add("images", {{"uri", "http://127.0.0.1/x.png"}});
  for (const char* place : {"/buffers/0/uri", "/buffers/1/uri: \"missing.bin\"", "/images/0/uri"}) {
    EXPECT_THAT(findingsOf(builder), ::testing::HasSubstr(place));
  }
}

TEST(ResourceBytes, LoadsAGltfWithABufferBesideIt) {
  testing::GlbBuilder builder = testing::cube();
  builder.json["buffers"] = {{{"byteLength", builder.binary.size()}, {"uri", "my%20cube.bin"}}};
  SceneBundle bundle = bundleOf(builder.json.dump());
  bundle.files["my cube.bin"] = builder.binary;
  EXPECT_EQ(load(bundle).summary.triangles, 12u);
  bundle.files["my cube.bin"].pop_back();
  EXPECT_THAT(problemsOf(bundle), ::testing::Contains(ProblemAt(ProblemCode::invalidScene, "/buffers/0/byteLength")));
}

} // namespace
} // namespace gnomon
