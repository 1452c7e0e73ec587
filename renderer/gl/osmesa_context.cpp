#include <array>
#include <cassert>
#include <optional>
#include <thread>
#include <utility>

#include "renderer/gl/context_setup.h"
#include "renderer/gl/debug_log.h"

namespace gnomon::gl {
namespace {

// From Mesa's interface of off-screen rendering (GL/osmesa.h), whose header Debian does not need for a run-time load.
using OsmesaHandle = void*;
constexpr int kOsmesaFormat = 0x22;
constexpr int kOsmesaDepthBits = 0x30;
constexpr int kOsmesaProfile = 0x33;
constexpr int kOsmesaCoreProfile = 0x34;
constexpr int kOsmesaMajorVersion = 0x36;
constexpr int kOsmesaMinorVersion = 0x37;

struct OsmesaApi {
  OsmesaHandle (*createContext)(const int* attributes, OsmesaHandle shared) = nullptr;
  void (*destroyContext)(OsmesaHandle) = nullptr;
  GLboolean (*makeCurrent)(OsmesaHandle, void* buffer, GLenum type, GLsizei width, GLsizei height) = nullptr;
  GLADapiproc (*getProcAddress)(const char* name) = nullptr;
};

Result<OsmesaApi> openOsmesa() {
  constexpr const char* kName = "libOSMesa.so.8";
  const SharedLibrary library(kName);
  if (!library.isOpen()) return backendProblem(library.failure());
  OsmesaApi osmesa;
  library.load(osmesa.createContext, "OSMesaCreateContextAttribs");
  library.load(osmesa.destroyContext, "OSMesaDestroyContext");
  library.load(osmesa.makeCurrent, "OSMesaMakeCurrent");
  library.load(osmesa.getProcAddress, "OSMesaGetProcAddress");
  if (!osmesa.createContext || !osmesa.destroyContext || !osmesa.makeCurrent || !osmesa.getProcAddress) {
    return backendProblem(std::string(kName) + " lacks OSMesaCreateContextAttribs");
  }
  return osmesa;
}

const Result<OsmesaApi>& osmesaApi() {
  static const Result<OsmesaApi> api = openOsmesa();
  return api;
}

/// Current on this thread from `create` to its destruction, on a small buffer that nothing draws to.
class OsmesaContext final : public Context {
 public:
  static Result<std::unique_ptr<Context>> create(const OsmesaApi& osmesa);
  ~OsmesaContext() override;

 private:
  static constexpr int kBufferSize = 16; ///< pixels a side

  explicit OsmesaContext(const OsmesaApi& osmesa) : osmesa_(osmesa) {}

  const OsmesaApi& osmesa_;
  OsmesaHandle context_ = nullptr;
  std::array<GLubyte, kBufferSize * kBufferSize * 4> buffer_{};
  std::optional<FunctionTable> table_;
  std::thread::id thread_ = std::this_thread::get_id();
};

Result<std::unique_ptr<Context>> OsmesaContext::create(const OsmesaApi& osmesa) {
  std::unique_ptr<OsmesaContext> context(new OsmesaContext(osmesa));
  constexpr std::array<int, 11> kAttributes{kOsmesaFormat,
                                            GL_RGBA,
                                            kOsmesaDepthBits,
                                            0,
                                            kOsmesaProfile,
                                            kOsmesaCoreProfile,
                                            kOsmesaMajorVersion,
                                            4,
                                            kOsmesaMinorVersion,
                                            5,
                                            0};
  context->context_ = osmesa.createContext(kAttributes.data(), nullptr);
  if (!context->context_) return backendProblem("no OpenGL 4.5 core context");
  if (!osmesa.makeCurrent(context->context_, context->buffer_.data(), GL_UNSIGNED_BYTE, kBufferSize, kBufferSize)) {
    return backendProblem("OSMesaMakeCurrent failed");
  }
  Result<FunctionTable> table = FunctionTable::load("osmesa", osmesa.getProcAddress);
  if (!table) return std::move(table).problems();
  context->table_.emplace(*std::move(table));
  setUpContext();
  context->info_ = describeContext("osmesa", "osmesa");
  context->info_.software = true;
  return std::unique_ptr<Context>(std::move(context));
}

OsmesaContext::~OsmesaContext() {
  assert(std::this_thread::get_id() == thread_);
  if (!context_) return;
  osmesa_.makeCurrent(nullptr, nullptr, GL_UNSIGNED_BYTE, 0, 0);
  osmesa_.destroyContext(context_);
}

} // namespace

Attempt tryOsmesa(bool requireGpu) {
  const auto failed = [](std::string_view why) {
    return Attempt{.context = nullptr, .failures = {"OSMesa: " + std::string(why)}};
  };
  if (requireGpu) return failed("a GPU is required and OSMesa runs on the CPU");
  if (const std::string_view conflict = tableConflict("osmesa"); !conflict.empty()) return failed(conflict);
  const Result<OsmesaApi>& osmesa = osmesaApi();
  if (!osmesa) return failed(osmesa.problems().front().detail);
  Result<std::unique_ptr<Context>> context = OsmesaContext::create(*osmesa);
  if (!context) return failed(context.problems().front().detail);
  return {.context = *std::move(context), .failures = {}};
}

} // namespace gnomon::gl
