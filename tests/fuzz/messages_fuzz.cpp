// A message between the front and a worker, as either of them reads it: what can be read has one text.
#include "server/wire/messages.h"
#include "tests/fuzz/require.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace gnomon;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto message = readToWorker(text)) {
    const std::string written = textOf(*message);
    const auto again = readToWorker(written);
    fuzz::require(again && textOf(*again) == written, "a message to a worker is read as it was written");
  }
  if (const auto message = readToFront(text)) {
    const std::string written = textOf(*message);
    const auto again = readToFront(written);
    fuzz::require(again && textOf(*again) == written, "a message to the front is read as it was written");
  }
  return 0;
}
