#include "renderer/scene/container/model_container.h"

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

Bytes bytesOf(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

void write32(Bytes& bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

ProblemCode codeOf(const Bytes& model) {
  const auto container = openContainer(model);
  EXPECT_FALSE(container);
  return container ? ProblemCode::internal : container.problems().front().code;
}

TEST(ModelContainer, SplitsGlb) {
  const Bytes glb = testing::makeGlb(R"({"a":1})", {1, 2, 3, 4});
  const auto container = openContainer(glb);
  ASSERT_TRUE(container);
  EXPECT_EQ(container->json, R"({"a":1} )");
  ASSERT_TRUE(container->binary);
  EXPECT_EQ(Bytes(container->binary->begin(), container->binary->end()), (Bytes{1, 2, 3, 4}));
}

TEST(ModelContainer, TakesJsonWithByteOrderMarkAndSpace) {
  EXPECT_TRUE(openContainer(bytesOf("\xEF\xBB\xBF \n{}")));
  EXPECT_FALSE(openContainer(bytesOf("{}"))->binary);
}

TEST(ModelContainer, TellsWhatOtherFilesAre) {
  const auto detail = [](std::string_view text) { return openContainer(bytesOf(text)).problems().front().detail; };
  EXPECT_THAT(detail(""), ::testing::HasSubstr("empty"));
  EXPECT_THAT(detail("version https://git-lfs.github.com/spec/v1\noid sha256:0"), ::testing::HasSubstr("git-lfs"));
  EXPECT_THAT(detail("<!DOCTYPE html><html>"), ::testing::HasSubstr("HTML"));
  EXPECT_THAT(detail("PK\x03\x04"), ::testing::HasSubstr("neither"));
  EXPECT_THAT(detail("[]"), ::testing::HasSubstr("neither"));
  EXPECT_EQ(codeOf({}), ProblemCode::malformed);
}

TEST(ModelContainer, RefusesContainerVersion1) {
  Bytes glb = testing::makeGlb("{}");
  write32(glb, 4, 1);
  EXPECT_EQ(codeOf(glb), ProblemCode::unsupportedFeature);
}

TEST(ModelContainer, RefusesWrongLengths) {
  const Bytes whole = testing::makeGlb("{   }", {1, 2, 3, 4});
  for (const std::uint32_t lie : {0u, 1u, 11u, static_cast<std::uint32_t>(whole.size()) - 1,
                                  static_cast<std::uint32_t>(whole.size()) + 1, 0xFFFFFFFFu}) {
    Bytes glb = whole;
    write32(glb, 8, lie);
    EXPECT_EQ(codeOf(glb), ProblemCode::malformed) << "header length " << lie;
    if (lie == 0) continue;
    glb = whole;
    write32(glb, 12, lie);
    EXPECT_EQ(codeOf(glb), ProblemCode::malformed) << "chunk length " << lie;
  }
}

TEST(ModelContainer, RefusesWrongChunks) {
  Bytes glb = testing::makeGlb("{   }", {1, 2, 3, 4});
  write32(glb, 16, 0x004E4942);
  EXPECT_EQ(codeOf(glb), ProblemCode::malformed) << "BIN first";
  glb = testing::makeGlb("{   }", {1, 2, 3, 4});
  write32(glb, 16 + 4 + 8 + 4, 0x4E4F534A);
  EXPECT_EQ(codeOf(glb), ProblemCode::malformed) << "JSON twice";
}

TEST(ModelContainer, IgnoresUnknownChunksAfterTheFirst) {
  Bytes glb = testing::makeGlb("{   }", {1, 2, 3, 4});
  write32(glb, 16 + 4 + 8 + 4, 0x12345678);
  const auto container = openContainer(glb);
  ASSERT_TRUE(container);
  EXPECT_FALSE(container->binary);
}

TEST(ModelContainer, RefusesEveryTruncation) {
  const Bytes glb = testing::cube().glb();
  ASSERT_TRUE(loadGltf({glb, {}}));
  for (std::size_t length = 0; length < glb.size(); ++length) {
    const SceneBundle cut{Bytes(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(length)), {}};
    const Problems problems = problemsOf(cut);
    ASSERT_FALSE(problems.empty()) << length;
    EXPECT_EQ(problems.front().code, ProblemCode::malformed) << length;
    EXPECT_FALSE(problems.front().detail.empty()) << length;
  }
}

TEST(ModelContainer, SurvivesTruncationWithTheHeaderMended) {
  const Bytes glb = testing::cube().glb();
  for (std::size_t length = 12; length < glb.size(); ++length) {
    Bytes cut(glb.begin(), glb.begin() + static_cast<std::ptrdiff_t>(length));
    write32(cut, 8, static_cast<std::uint32_t>(length));
    EXPECT_FALSE(problemsOf(SceneBundle{cut, {}}).empty()) << length;
  }
}

} // namespace
} // namespace gnomon
