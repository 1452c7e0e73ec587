#pragma once

#include <cstddef>
#include <cstdint>

/// The boundary between gnomon_image and the module that calls OpenImageIO: plain data and function pointers only.
/// No exception and no ownership crosses it; the caller's memory outlives each call.
namespace gnomon::codec {

/// Rises whenever anything in this header changes, so that a stale module is refused and not called.
inline constexpr std::uint32_t kTableVersion = 4;

inline constexpr const char* kTableFunction = "gnomonImageCodec";

/// Takes bytes in order. `accept` gives false where it could not keep them.
struct Sink {
  void* target = nullptr;
  bool (*accept)(void* target, const std::uint8_t* bytes, std::size_t size) = nullptr;
};

/// Asked every few rows whether the caller still wants the file.
struct Caller {
  void* task = nullptr;
  bool (*wants)(void* task) = nullptr;
};

enum class Format : std::uint32_t { png, jpeg, webp };
enum class Compression : std::uint32_t { none, rle, zip, piz };

/// One part of an EXR.
struct FloatPart {
  const char* name = nullptr;
  int width = 0;
  int height = 0;
  int channelCount = 0;
  const char* const* channelNames = nullptr;
  const bool* channelIsHalf = nullptr; ///< otherwise float
  const float* pixels = nullptr;       ///< interleaved rows, first row on top
};

/// Each call gives true when done; otherwise a sentence has gone to `message`. Safe from any thread.
struct Table {
  std::uint32_t version = 0;

  /// Several parts need names that differ. Fails where the caller wants the file no more.
  bool (*encodeExr)(const FloatPart* parts, std::size_t partCount, Compression compression, const Caller& caller,
                    const Sink& encoded, const Sink& message) = nullptr;

  /// Fills width * height * 4 bytes with RGBA, straight alpha, no colour conversion. Fails where the encoded picture
  /// is not exactly width x height. A WebP must have no alpha.
  bool (*decode)(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height,
                 std::uint8_t* rgba, const Sink& message) = nullptr;

  /// Puts the alpha of a picture that has one into every fourth byte, and leaves the others as they are.
  bool (*decodeAlpha)(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height,
                      std::uint8_t* rgba, const Sink& message) = nullptr;
};

using TableFunction = const Table* (*)();

} // namespace gnomon::codec
