#include <array>
#include <utility>
#include <vector>

#include "gl_fixture.h"
#include "renderer/gl/buffer.h"
#include "renderer/gl/draw.h"
#include "renderer/gl/framebuffer.h"
#include "renderer/gl/pipeline_state.h"
#include "renderer/gl/texture.h"

namespace gnomon::gl {
namespace {

using ::testing::ElementsAre;

/// Moves an owner every way there is and checks what is left behind.
template <class Owner>
void expectMoves(Owner first, Owner second, GLboolean (*exists)(GLuint)) {
  static_assert(!std::is_copy_constructible_v<Owner> && !std::is_copy_assignable_v<Owner>);
  static_assert(std::is_nothrow_move_constructible_v<Owner> && std::is_nothrow_move_assignable_v<Owner>);
  EXPECT_EQ(Owner().id(), 0u);
  const GLuint firstId = first.id();
  const GLuint secondId = second.id();
  ASSERT_NE(firstId, 0u);
  ASSERT_NE(firstId, secondId);

  Owner moved(std::move(first));
  EXPECT_EQ(moved.id(), firstId);
  EXPECT_EQ(first.id(), 0u);
  EXPECT_TRUE(exists(firstId));

  second = std::move(moved);
  EXPECT_EQ(second.id(), firstId);
  EXPECT_EQ(moved.id(), 0u);
  EXPECT_TRUE(exists(firstId));
  EXPECT_FALSE(exists(secondId)) << "what was assigned over is deleted";

  { const Owner last(std::move(second)); }
  EXPECT_FALSE(exists(firstId)) << "deleted with its last owner";
}

class Owners : public GlTest {
 protected:
  static std::string labelOf(GLenum kind, GLuint id) {
    std::array<char, 256> label{};
    GLsizei length = 0;
    glGetObjectLabel(kind, id, label.size(), &length, label.data());
    return {label.data(), static_cast<std::size_t>(length)};
  }
};

TEST_F(Owners, move) {
  const std::vector<int> values{1, 2, 3};
  expectMoves(Buffer(bytesOf(values), "a"), Buffer(8, "b"), glIsBuffer);
  expectMoves(Texture({}, "a"), Texture({.samples = 4}, "b"), glIsTexture);
  expectMoves(Sampler({}, "a"), Sampler({}, "b"), glIsSampler);
  expectMoves(VertexArray({}, {}, nullptr, "a"), VertexArray({}, {}, nullptr, "b"), glIsVertexArray);
  const Texture color({}, "color");
  Attachments attachments;
  attachments.color = {{.texture = &color}};
  expectMoves(*Framebuffer::create(attachments, "a"), *Framebuffer::create(attachments, "b"), glIsFramebuffer);
}

TEST_F(Owners, areLabelled) {
  const Buffer buffer(16, "some buffer");
  EXPECT_EQ(labelOf(GL_BUFFER, buffer.id()), "some buffer");
  const Texture texture({}, std::string(1000, 'x'));
  EXPECT_EQ(labelOf(GL_TEXTURE, texture.id()), std::string(255, 'x')) << "a long label is cut, not an error";
}

TEST_F(Owners, bufferKeepsItsBytes) {
  const std::vector<std::uint8_t> values{1, 2, 3, 4};
  const Buffer fixed(bytesOf(values), "fixed");
  std::vector<std::uint8_t> read(2);
  fixed.read(1, std::as_writable_bytes(std::span(read)));
  EXPECT_THAT(read, ElementsAre(2, 3));

  Buffer changing(4, "changing");
  changing.update(2, bytesOf(std::vector<std::uint8_t>{8, 9}));
  read.resize(4);
  changing.read(0, std::as_writable_bytes(std::span(read)));
  EXPECT_THAT(read, ElementsAre(0, 0, 8, 9));
}

TEST_F(Owners, emptyBufferMayBeBound) {
  const Buffer empty(std::span<const std::byte>{}, "empty");
  EXPECT_EQ(empty.bytes(), 0u);
  empty.bindStorage(0);
  Buffer(std::size_t{0}, "empty").bindUniform(0);
}

TEST_F(Owners, textureKeepsItsTexels) {
  constexpr TexelLayout kLayout{GL_RED, GL_UNSIGNED_BYTE};
  Texture texture({.format = GL_R8, .width = 3, .height = 2, .levels = 2}, "odd width");
  texture.write(0, kLayout, bytesOf(std::vector<std::uint8_t>{10, 20, 30, 40, 50, 60}));
  texture.write(1, kLayout, bytesOf(std::vector<std::uint8_t>{99}));
  std::vector<std::uint8_t> read(4);
  texture.read(0, {1, 0, 2, 2}, kLayout, std::as_writable_bytes(std::span(read)));
  EXPECT_THAT(read, ElementsAre(20, 30, 50, 60));
  texture.clear(1, kLayout, bytesOfValue(std::uint8_t{7}));
  texture.read(1, {0, 0, 1, 1}, kLayout, std::as_writable_bytes(std::span(read)));
  EXPECT_EQ(read[0], 7);
}

TEST_F(Owners, levelsAreAveragesDownToOneTexel) {
  EXPECT_EQ(fullLevels(1, 1), 1);
  EXPECT_EQ(fullLevels(2, 1), 2);
  EXPECT_EQ(fullLevels(640, 480), 10);
  constexpr TexelLayout kLayout{GL_RED, GL_FLOAT};
  Texture texture({.format = GL_R32F, .width = 2, .height = 2, .levels = fullLevels(2, 2)}, "levels");
  texture.write(0, kLayout, bytesOf(std::vector<float>{0, 1, 2, 5}));
  texture.generateLevels();
  float average = 0;
  texture.read(1, {0, 0, 1, 1}, kLayout, std::as_writable_bytes(std::span(&average, 1)));
  EXPECT_FLOAT_EQ(average, 2);
}

TEST_F(Owners, incompleteFramebufferIsAProblem) {
  const Texture depth({.format = GL_DEPTH_COMPONENT32F}, "depth");
  Attachments attachments;
  attachments.color = {{.texture = &depth}};
  const auto framebuffer = Framebuffer::create(attachments, "depth for color");
  ASSERT_FALSE(framebuffer);
  EXPECT_EQ(framebuffer.problems().front().code, ProblemCode::backend);
  EXPECT_THAT(framebuffer.problems().front().detail, testing::HasSubstr("\"depth for color\" is incomplete"));
}

TEST_F(Owners, depthIsClearedAndRead) {
  constexpr Rect kAll{0, 0, 2, 1};
  const Texture depth({.format = GL_DEPTH_COMPONENT32F, .width = 2, .height = 1}, "depth");
  Attachments attachments;
  attachments.depth = {.texture = &depth};
  Framebuffer framebuffer = *Framebuffer::create(attachments, "depth");
  PipelineState state;
  state.viewport = kAll;
  state.depth.write = true;
  apply(state);
  framebuffer.clearDepth(0.25f);
  std::array<float, 2> depths{};
  depth.read(0, kAll, {GL_DEPTH_COMPONENT, GL_FLOAT}, std::as_writable_bytes(std::span(depths)));
  EXPECT_THAT(depths, ElementsAre(0.25f, 0.25f));
}

TEST_F(Owners, samplesLieApartWithinTheirPixel) {
  const Texture color({.samples = 4}, "samples");
  Attachments attachments;
  attachments.color = {{.texture = &color}};
  const Framebuffer framebuffer = *Framebuffer::create(attachments, "samples");
  for (int i = 0; i < 4; ++i) {
    const glm::vec2 position = framebuffer.samplePosition(i);
    EXPECT_TRUE(position.x >= 0 && position.x <= 1 && position.y >= 0 && position.y <= 1) << i;
    for (int k = 0; k < i; ++k) EXPECT_NE(framebuffer.samplePosition(k), position) << i << ' ' << k;
  }
}

} // namespace
} // namespace gnomon::gl
