#pragma once

#include <cstddef>
#include <cstdint>

/// Rows of the fields: report/reply_rows.h.
namespace gnomon {

/// Every bound that a request or a scene meets. A problem that quotes a limit quotes one of these.
struct Limits {
  // Frames
  int maxFrameSide = 16384;
  std::int64_t maxFramePixels = 33'554'432;
  int maxAtlasSide = 8192;
  std::int64_t maxAtlasBytes = 536'870'912;
  int maxLights = 256;
  int maxCascades = 8;
  int maxLightMapSide = 8192;
  int maxRaySamples = 1024;
  std::int64_t maxVisibilityBytes = 536'870'912;
  int maxLayers = 16;
  int maxNodeOptions = 4096;
  int maxReceiverGroups = 32;

  std::size_t maxVolumes = 16;
  std::size_t maxTransferStops = 256;
  int maxVolumeLights = 16;
  std::int64_t maxVolumeSide = 2048;
  std::int64_t maxVolumeVoxels = 134'217'728;

  int minEnvironmentWidth = 8;
  int maxEnvironmentWidth = 8192;
  double maxRadiance = 1e9;

  // Evaluations
  std::size_t maxVariants = 128;
  std::size_t maxPathFrames = 600;

  // Sequences
  std::size_t maxSequenceFrames = 10'000;
  std::size_t maxSequenceKeys = 1'000;
  std::size_t maxSequenceSpecBytes = 64u << 20;

  // Requests
  std::size_t maxSpecBytes = 1 << 20;
  std::size_t maxSceneBytes = 256u << 20;
  std::size_t maxBundleFiles = 256;
  int maxJsonDepth = 64;
  std::size_t maxJsonValues = 2'000'000;

  // Scenes
  std::size_t maxNodes = 100'000;
  std::size_t maxInstances = 1'000'000;
  std::size_t maxTriangles = 8'000'000;
  std::size_t maxVertices = 16'000'000;
  std::size_t maxDecodedBytes = 512u << 20;
  std::size_t maxJoints = 65'536;
  std::size_t maxMorphTargets = 1'024;
  std::size_t maxMorphedVertices = 16'000'000;
  std::size_t maxAnimations = 4'096;
  std::size_t maxKeyframes = 16'000'000;
  std::size_t maxMaterials = 4'096;
  std::size_t maxImages = 1'024;
  int maxImageSide = 8192;
  std::int64_t maxImagePixels = 134'217'728;
};

inline constexpr Limits kLimits{};

} // namespace gnomon
