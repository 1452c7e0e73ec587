#pragma once

#include <cstddef>
#include <cstdint>
#include <exception>
#include <string>

#include "renderer/image/codec_table.h"

namespace gnomon::codec {

// The calls of the table, in terms of OpenImageIO. They throw nothing.

bool encodeExr(const FloatPart* parts, std::size_t partCount, Compression compression, const Caller& caller,
               const Sink& encoded, const Sink& message);

bool decode(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height, std::uint8_t* rgba,
            const Sink& message);

bool decodeAlpha(Format format, const std::uint8_t* encoded, std::size_t size, int width, int height,
                 std::uint8_t* rgba, const Sink& message);

inline bool fail(const Sink& message, const std::string& text) {
  message.accept(message.target, reinterpret_cast<const std::uint8_t*>(text.data()), text.size());
  return false;
}

/// Runs `work`, turning what it throws into a message.
template <class Work>
bool guarded(const Sink& message, Work work) noexcept {
  static constexpr char kUnknown[] = "unknown exception";
  try {
    return work();
  } catch (const std::exception& error) {
    const char* text = error.what();
    message.accept(message.target, reinterpret_cast<const std::uint8_t*>(text), std::char_traits<char>::length(text));
  } catch (...) {
    message.accept(message.target, reinterpret_cast<const std::uint8_t*>(kUnknown), sizeof(kUnknown) - 1);
  }
  return false;
}

} // namespace gnomon::codec
