// The structs that C++ writes and GLSL reads lie where the driver says that the shaders look for their members.
#include <cstddef>
#include <string>
#include <vector>

#include "gl_fixture.h"
#include "renderer/gl/program.h"
#include "renderer/shaders/shared/frame_types.h"

namespace gnomon::gl {
namespace {

struct Member {
  std::string name; ///< in GLSL; of an array its first element
  std::size_t offset = 0;
};

#define MEMBER(type, name) \
  { #name, offsetof(shared::type, name) }
#define ARRAY(type, name) \
  { #name "[0]", offsetof(shared::type, name) }

const std::vector<Member> kFrame{
    MEMBER(FrameData, clipFromRelative),
    MEMBER(FrameData, forward),
    MEMBER(FrameData, perspective),
    MEMBER(FrameData, middle),
    MEMBER(FrameData, nearest),
    MEMBER(FrameData, right),
    MEMBER(FrameData, farthest),
    MEMBER(FrameData, up),
    MEMBER(FrameData, pixelHeight),
    MEMBER(FrameData, depthTerms),
    MEMBER(FrameData, pixelStep),
    MEMBER(FrameData, background),
    MEMBER(FrameData, ambient),
    MEMBER(FrameData, exposureScale),
    MEMBER(FrameData, ahead),
    MEMBER(FrameData, environmentIntensity),
    MEMBER(FrameData, environmentTurn),
    MEMBER(FrameData, shownRoughness),
    MEMBER(FrameData, padding1),
    MEMBER(FrameData, padding2),
    MEMBER(FrameData, studioLamps),
};
const std::vector<Member> kMaterial{
    MEMBER(MaterialData, baseColorFactor),   MEMBER(MaterialData, emissiveFactor),
    MEMBER(MaterialData, alphaCutoff),       MEMBER(MaterialData, metallicFactor),
    MEMBER(MaterialData, roughnessFactor),   MEMBER(MaterialData, normalScale),
    MEMBER(MaterialData, occlusionStrength), MEMBER(MaterialData, specularFactor),
    MEMBER(MaterialData, glossinessFactor),  MEMBER(MaterialData, transmission),
    MEMBER(MaterialData, coverageRow),       MEMBER(MaterialData, coverageLastRow),
    MEMBER(MaterialData, mixesLevels),       ARRAY(MaterialData, uvAxes),
    ARRAY(MaterialData, uvOffsets),
};
const std::vector<Member> kLight{
    MEMBER(LightData, direction),          MEMBER(LightData, type),
    MEMBER(LightData, position),           MEMBER(LightData, range),
    MEMBER(LightData, radiance),           MEMBER(LightData, strength),
    MEMBER(LightData, coneScale),          MEMBER(LightData, coneOffset),
    MEMBER(LightData, filterRadius),       MEMBER(LightData, fadesOut),
    MEMBER(LightData, firstTile),          MEMBER(LightData, tileCount),
    MEMBER(LightData, filterKind),         MEMBER(LightData, filterSize),
    MEMBER(LightData, visibilityLayer),    MEMBER(LightData, layerOmitsTurnedFaces),
    MEMBER(LightData, litGroups),          MEMBER(LightData, shadowedGroups),
    MEMBER(LightData, manualDepthBias),    MEMBER(LightData, manualSlopeBias),
    MEMBER(LightData, manualNormalOffset), MEMBER(LightData, hasManualBias),
    MEMBER(LightData, shadowColor),        MEMBER(LightData, hasShadowColor),
    MEMBER(LightData, smoothTerminator),   MEMBER(LightData, padding1),
    MEMBER(LightData, padding2),           MEMBER(LightData, padding3),
};
const std::vector<Member> kTile{
    ARRAY(TileData, atlasFromRelative),
    MEMBER(TileData, lowest),
    MEMBER(TileData, highest),
    MEMBER(TileData, near),
    MEMBER(TileData, blendNear),
    MEMBER(TileData, far),
    MEMBER(TileData, normalOffset),
    MEMBER(TileData, depthBias),
    MEMBER(TileData, depthBiasNear),
    MEMBER(TileData, atlasPerMetre),
    MEMBER(TileData, axis),
    MEMBER(TileData, texelDepth),
    MEMBER(TileData, right),
    MEMBER(TileData, filterReach),
    MEMBER(TileData, up),
    MEMBER(TileData, perspective),
};
const std::vector<Member> kProbe{MEMBER(ProbeData, relative), MEMBER(ProbeData, normal)};

#undef MEMBER
#undef ARRAY

class SharedStructs : public GlTest {
 protected:
  void make(const ProgramSource& source) {
    auto program = Program::create(source, "shared structs");
    ASSERT_TRUE(program) << detailsOf(program.problems());
    program_ = *std::move(program);
  }

  GLint property(GLenum interface, const std::string& name, GLenum property) const {
    const GLuint index = glGetProgramResourceIndex(program_.id(), interface, name.c_str());
    if (index == GL_INVALID_INDEX) return -1;
    GLint value = -1;
    glGetProgramResourceiv(program_.id(), interface, index, 1, &property, 1, nullptr, &value);
    return value;
  }

  /// How many variables of an interface have names that begin so.
  std::size_t countOf(GLenum interface, const std::string& prefix) const {
    GLint resources = 0;
    glGetProgramInterfaceiv(program_.id(), interface, GL_ACTIVE_RESOURCES, &resources);
    std::size_t count = 0;
    for (GLint i = 0; i < resources; ++i) {
      std::string name(256, '\0');
      glGetProgramResourceName(program_.id(), interface, static_cast<GLuint>(i), 256, nullptr, name.data());
      count += name.starts_with(prefix) ? 1 : 0;
    }
    return count;
  }

  void expectLayout(GLenum interface, const std::string& prefix, const std::vector<Member>& members) const {
    EXPECT_EQ(countOf(interface, prefix), members.size()) << prefix << " has members that no row of this test names";
    for (const Member& member : members) {
      EXPECT_EQ(property(interface, prefix + member.name, GL_OFFSET), static_cast<GLint>(member.offset))
          << prefix << member.name;
    }
  }

  /// Of a storage buffer that is an array of structs.
  void expectArray(const std::string& array, std::size_t size, const std::vector<Member>& members) const {
    expectLayout(GL_BUFFER_VARIABLE, array + "[0].", members);
    EXPECT_EQ(property(GL_BUFFER_VARIABLE, array + "[0]." + members.front().name, GL_TOP_LEVEL_ARRAY_STRIDE),
              static_cast<GLint>(size))
        << array;
  }

 private:
  Program program_;
};

TEST_F(SharedStructs, LightsTilesProbesAndTheFrameLieWhereShadersReadThem) {
  make({.vertex = "fullscreen.vert", .fragment = "probe.frag", .defines = {"FILTER_SIZE 5", "PUNCTUAL"}});
  expectLayout(GL_UNIFORM, "frame.", kFrame);
  EXPECT_EQ(property(GL_UNIFORM_BLOCK, "FrameBuffer", GL_BUFFER_DATA_SIZE), GLint{sizeof(shared::FrameData)});
  expectArray("lights", sizeof(shared::LightData), kLight);
  expectArray("tiles", sizeof(shared::TileData), kTile);
  expectArray("probes", sizeof(shared::ProbeData), kProbe);
}

TEST_F(SharedStructs, MaterialsLieWhereShadersReadThem) {
  make({.vertex = "surface.vert", .fragment = "surface.frag", .defines = {"EMISSION"}});
  expectArray("materials", sizeof(shared::MaterialData), kMaterial);
  EXPECT_EQ(property(GL_BUFFER_VARIABLE, "materials[0].uvAxes[0]", GL_ARRAY_STRIDE), GLint{sizeof(glm::vec4)});
}

TEST_F(SharedStructs, InstancesAreRowsOneAnAttribute) {
  make({.vertex = "surface.vert", .fragment = "surface.frag", .defines = {"RECEIVER_GROUPS", "EMISSION"}});
  const auto row = [](std::size_t offset) {
    return GNOMON_INSTANCE_ROWS + static_cast<GLint>(offset / sizeof(glm::vec4));
  };
  const auto rows = [&](const char* name) { return property(GL_PROGRAM_INPUT, name, GL_ARRAY_SIZE); };
  EXPECT_EQ(property(GL_PROGRAM_INPUT, "instanceRows[0]", GL_LOCATION),
            row(offsetof(shared::InstanceData, relativeFromLocal)));
  EXPECT_EQ(property(GL_PROGRAM_INPUT, "normalRows[0]", GL_LOCATION),
            row(offsetof(shared::InstanceData, normalFromLocal)));
  EXPECT_EQ(rows("instanceRows[0]"), 3);
  EXPECT_EQ(rows("normalRows[0]"), 3);
  EXPECT_EQ(sizeof(shared::InstanceData), 6 * sizeof(glm::vec4));
}

} // namespace
} // namespace gnomon::gl
