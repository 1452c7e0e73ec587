#include "renderer/scene/container/model_container.h"

#include <span>

#include "tests/renderer/scene/load.h"

namespace gnomon {
namespace {

Bytes bytesOf(std::string_view text) {
  return Bytes(text.begin(), text.end());
}

void write32(Bytes& bytes, std::size_t offset, std::uint32_t value) {
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::uint8_t>(value >> 8 * i);
}

Result<ModelContainer> open(const Bytes& model) {
  Findings findings;
  return openContainer(model, findings);
}

ProblemCode codeOf(const Bytes& model) {
  const auto container = open(model);
  EXPECT_FALSE(container);
  return container ? ProblemCode::internal : container.problems().front().code;
}

TEST(ModelContainer, SplitsGlb) {
  const Bytes glb = testing::makeGlb(R"({"a":1})", {1, 2, 3, 4});
  const auto container = open(glb);
  ASSERT_TRUE(container);
  EXPECT_EQ(container->json, R"({"a":1} )");
  ASSERT_TRUE(container->binary);
  EXPECT_EQ(Bytes(container->binary->begin(), container->binary->end()), (Bytes{1, 2, 3, 4}));
}

TEST(ModelContainer, TakesJsonWithByteOrderMarkAndSpace) {
  EXPECT_TRUE(open(bytesOf("\xEF\xBB\xBF \n{}")));
  EXPECT_FALSE(open(bytesOf("{}"))->binary);
}

TEST(ModelContainer, TellsWhatOtherFilesAre) {
  const auto detail = [](std::string_view text) { return open(bytesOf(text)).problems().front().detail; };
  EXPECT_THAT(detail(""), ::testing::HasSubstr("empty"));
  EXPECT_THAT(detail("version https://git-lfs.github.com/spec/v1\noid sha256:0"), ::testing::HasSubstr("git-lfs"));
  EXPECT_THAT(detail("<!DOCTYPE html><html>"), ::testing::HasSubstr("HTML"));
  EXPECT_THAT(detail("b3dm\x01\0\0\0"), ::testing::HasSubstr("b3dm"));
  EXPECT_THAT(detail("\x1F\x8B\x08"), ::testing::HasSubstr("gzip"));
  EXPECT_THAT(detail("PK\x03\x04"), ::testing::HasSubstr("ZIP"));
  const auto zip = [](const std::string& name) {
    return "PK\x03\x04" + std::string(22, '\0') + std::string(1, static_cast<char>(name.size())) +
           std::string(3, '\0') + name + "the file";
  };
  EXPECT_THAT(detail(zip("house/scene.gltf")), ::testing::HasSubstr("ZIP"));
  EXPECT_THAT(detail(zip("house.usdc")), ::testing::HasSubstr("USDZ"));
  EXPECT_THAT(detail("PXR-USDC"), ::testing::HasSubstr("USD"));
  EXPECT_THAT(detail("solid box"), ::testing::HasSubstr("neither"));
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
  for (const std::uint32_t lie : {0u, 1u, 11u, static_cast<std::uint32_t>(whole.size()) + 1, 0xFFFFFFFFu}) {
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

/// The file's warnings, and that it has the JSON and the binary.
std::vector<std::string> repairsOf(const Bytes& glb, std::string_view text, const Bytes& binary) {
  Findings findings;
  const auto container = openContainer(glb, findings);
  EXPECT_TRUE(container);
  if (!container) return {};
  EXPECT_EQ(container->json, text);
  EXPECT_EQ(Bytes(container->binary->begin(), container->binary->end()), binary);
  EXPECT_FALSE(findings.refused());
  return findings.takeWarnings();
}

/// A GLB as its writer meant it: chunks of any length, with or without the padding that their lengths do not count.
Bytes glbOf(std::string_view text, const Bytes& binary, bool padded) {
  Bytes glb = testing::makeGlb("{}");
  glb.resize(12);
  const auto append = [&](std::uint32_t kind, std::span<const std::uint8_t> content) {
    glb.resize(glb.size() + 8);
    write32(glb, glb.size() - 8, static_cast<std::uint32_t>(content.size()));
    write32(glb, glb.size() - 4, kind);
    glb.insert(glb.end(), content.begin(), content.end());
    if (padded) glb.resize((glb.size() + 3) / 4 * 4);
  };
  append(0x4E4F534A, bytesOf(text));
  append(0x004E4942, binary);
  write32(glb, 8, static_cast<std::uint32_t>(glb.size()));
  return glb;
}

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(ModelContainer, ReadsChunksThatAreNotPadded) {
  for (const bool padded : {false, true}) {
    EXPECT_THAT(repairsOf(glbOf("{    }", {1, 2, 3, 4, 5}, padded), "{    }", {1, 2, 3, 4, 5}),
                ElementsAre(HasSubstr("multiple of 4")));
    EXPECT_THAT(repairsOf(glbOf("{     }", {1, 2, 3, 4}, padded), "{     }", {1, 2, 3, 4}),
                ElementsAre(HasSubstr("Chunk 0 of the GLB")));
    EXPECT_THAT(repairsOf(glbOf("{      }", {1, 2, 3, 4}, padded), "{      }", {1, 2, 3, 4}), IsEmpty());
  }
}

TEST(ModelContainer, ReadsNothingAfterTheEnd) {
  const Bytes sound = testing::makeGlb("{  }", {1, 2, 3, 4});
  for (const std::size_t more : {1u, 4u, 7u, 100u}) {
    Bytes glb = sound;
    glb.resize(glb.size() + more, 'x');
    EXPECT_THAT(repairsOf(glb, "{  }", {1, 2, 3, 4}), ElementsAre(HasSubstr(std::to_string(more) + " bytes")));
  }
  Bytes glb = sound;
  write32(glb, 8, static_cast<std::uint32_t>(glb.size()) - 1);
  EXPECT_THAT(repairsOf(glb, "{  }", {1, 2, 3, 4}), ElementsAre(HasSubstr("less than that of its chunks")));
}

TEST(ModelContainer, ReadsTheFirstBinaryAndSkipsZerosAfterTheJson) {
  Bytes glb = glbOf(std::string_view("{ }\0", 4), {1, 2, 3, 4}, true);
  EXPECT_THAT(repairsOf(glb, "{ }", {1, 2, 3, 4}), ElementsAre(HasSubstr("zeros")));
  glb = testing::makeGlb("{  }", {1, 2, 3, 4});
  const Bytes again(glb.end() - 12, glb.end());
  glb.insert(glb.end(), again.begin(), again.end());
  glb.back() = 9;
  write32(glb, 8, static_cast<std::uint32_t>(glb.size()));
  EXPECT_THAT(repairsOf(glb, "{  }", {1, 2, 3, 4}), ElementsAre(HasSubstr("second BIN")));
  EXPECT_THAT(repairsOf(glbOf("{  }", {}, true), "{  }", {}), ElementsAre(HasSubstr("is empty")));
}

TEST(ModelContainer, IgnoresUnknownChunksAfterTheFirst) {
  Bytes glb = testing::makeGlb("{   }", {1, 2, 3, 4});
  write32(glb, 16 + 4 + 8 + 4, 0x12345678);
  const auto container = open(glb);
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
