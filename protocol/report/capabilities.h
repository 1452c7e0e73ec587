#pragma once

#include <string>

namespace gnomon {

enum class Backend { automatic, egl, osmesa };

/// Which graphics context to make.
struct BackendOptions {
  Backend backend = Backend::automatic; ///< automatic = EGL, then OSMesa
  bool requireGpu = false;              ///< refuse software renderers
};

/// What the chosen graphics context is and can do.
struct RendererInfo {
  std::string backend{};  ///< "egl" | "osmesa"
  std::string platform{}; ///< "device" | "surfaceless" | "osmesa"
  std::string vendor{};   ///< GL_VENDOR
  std::string renderer{}; ///< GL_RENDERER
  std::string version{};  ///< GL_VERSION
  bool software = false;  ///< true = no GPU
  int maxTextureSize = 0; ///< texels
  int maxSamples = 0;
  std::string fingerprint{}; ///< changes whenever the same request could give other bytes
};

} // namespace gnomon
