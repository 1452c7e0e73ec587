#pragma once

#include <cstddef>
#include <cstdint>

namespace gnomon {

/// Every bound that a request or a scene meets. A problem that quotes a limit quotes one of these.
struct Limits {
  // Frames
  int maxFrameSide = 16384;                      ///< pixels; the device may allow less
  std::int64_t maxFramePixels = 33'554'432;      ///< width x height
  int maxAtlasSide = 8192;                       ///< texels; the device may allow less
  std::int64_t maxAtlasBytes = 536'870'912;      ///< of the shadow atlas, with all its samples and moments
  int maxLights = 256;                           ///< lights in one frame
  int maxCascades = 8;                           ///< cascades of one light
  int maxLightMapSide = 8192;                    ///< texels
  int maxRaySamples = 1024;                      ///< rays a pixel and light
  std::int64_t maxVisibilityBytes = 536'870'912; ///< of what rays and volumes say of every pixel and light
  int maxLayers = 16;                            ///< layers of nodes
  int maxNodeOptions = 4096;                     ///< entries of a frame's `nodes`
  int maxReceiverGroups = 32;                    ///< different pairs of layers and receiveShadow in one frame

  std::size_t maxVolumes = 16;                ///< entries of a frame's `volumes`
  std::size_t maxTransferStops = 256;         ///< entries of a transfer function
  int maxVolumeLights = 16;                   ///< lights of a frame with volumes
  std::int64_t maxVolumeSide = 2048;          ///< voxels of a grid along an axis
  std::int64_t maxVolumeVoxels = 134'217'728; ///< of a grid

  // Evaluations
  std::size_t maxVariants = 128;   ///< variants of one evaluation
  std::size_t maxPathFrames = 600; ///< cameras along a path

  // Sequences
  std::size_t maxSequenceFrames = 10'000;
  std::size_t maxSequenceKeys = 1'000;
  std::size_t maxSequenceSpecBytes = 64u << 20; ///< the specs of all frames of one together, as JSON

  // Requests
  std::size_t maxSpecBytes = 1 << 20;     ///< a FrameSpec's JSON
  std::size_t maxSceneBytes = 256u << 20; ///< a bundle: the model and every file that it names
  std::size_t maxBundleFiles = 256;       ///< files in a multipart upload
  int maxJsonDepth = 64;                  ///< nested objects and arrays
  std::size_t maxJsonValues = 2'000'000;  ///< values in a glTF's JSON

  // Scenes
  std::size_t maxNodes = 100'000;
  std::size_t maxInstances = 1'000'000;        ///< nodes and primitives placed, over all scenes of a file
  std::size_t maxTriangles = 8'000'000;        ///< with node reuse counted
  std::size_t maxVertices = 16'000'000;        ///< over all meshes
  std::size_t maxDecodedBytes = 512u << 20;    ///< what a file's Draco and meshopt data comes to
  std::size_t maxJoints = 65'536;              ///< over all skins
  std::size_t maxMorphTargets = 1'024;         ///< of one mesh
  std::size_t maxMorphedVertices = 16'000'000; ///< vertices times morph targets, over all meshes
  std::size_t maxAnimations = 4'096;
  std::size_t maxKeyframes = 16'000'000; ///< over all animations: numbers that their samplers read
  std::size_t maxMaterials = 4'096;
  std::size_t maxImages = 1'024;
  int maxImageSide = 8192;                   ///< pixels of one image
  std::int64_t maxImagePixels = 134'217'728; ///< of all images together
};

inline constexpr Limits kLimits{};

} // namespace gnomon
