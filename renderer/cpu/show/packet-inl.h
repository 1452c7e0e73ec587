// Sixteen fragments of a square at a time.
#if defined(GNOMON_CPU_PACKET_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef GNOMON_CPU_PACKET_INL_H
#undef GNOMON_CPU_PACKET_INL_H
#else
#define GNOMON_CPU_PACKET_INL_H
#endif

#include "renderer/cpu/lanes/gather-inl.h"
#include "renderer/cpu/raster/raster.h"
#include "renderer/cpu/show/show_view.h"
#include "renderer/cpu/surface/receivers-inl.h"
#include "renderer/cpu/surface/surface-inl.h"

HWY_BEFORE_NAMESPACE();
namespace gnomon::cpu::HWY_NAMESPACE {

static_assert(FragmentList::kPacket == kLanes);

using cpu::columnOf;
using cpu::rowOf;

/// As show_view.h has it for one pixel.
HWY_INLINE Int columnOf(const Int& pixel) {
  return (shiftRight<2>(pixel) & Int(12)) | (pixel & Int(3));
}
HWY_INLINE Int rowOf(const Int& pixel) {
  return (shiftRight<4>(pixel) & Int(12)) | (shiftRight<2>(pixel) & Int(3));
}

struct Packet {
  Fragments fragments;
  Int samples;
  bool whole; ///< each of its pixels shows it in all samples
};

/// Places within a pixel: the mean of each set of its samples, a bit each.
struct SampleMeans {
  alignas(64) float x[16] = {}, y[16] = {};
  std::int32_t all = 1; ///< the set of all samples
};

HWY_INLINE SampleMeans sampleMeans(int samples) {
  SampleMeans means;
  means.all = (1 << samples) - 1;
  const std::span<const glm::ivec2> places = samplePlaces(samples);
  for (std::size_t set = 1; set < std::size_t{1} << samples; ++set) {
    glm::vec2 sum(0);
    int count = 0;
    for (std::size_t s = 0; s < places.size(); ++s) {
      if ((set >> s & 1u) == 0) continue;
      sum += glm::vec2(places[s]);
      ++count;
    }
    means.x[set] = sum.x / (256.0f * static_cast<float>(count));
    means.y[set] = sum.y / (256.0f * static_cast<float>(count));
  }
  return means;
}

HWY_INLINE Packet packetAt(const FragmentList& list, std::size_t first, int squareX, int squareY,
                           const SampleMeans& means) {
  const std::size_t left = list.count - first;
  const Int pixel = load(&list.pixel[first]);
  Packet packet;
  packet.samples = load(&list.samples[first]);
  packet.fragments.shown = left >= kLanes ? maskOf(0xffffu) : firstLanes(left);
  packet.fragments.triangle = load(&list.triangle[first]);
  packet.fragments.x = Int(squareX) + columnOf(pixel);
  packet.fragments.y = Int(squareY) + rowOf(pixel);
  packet.fragments.center = {toFloat(packet.fragments.x) + 0.5f, toFloat(packet.fragments.y) + 0.5f};
  packet.whole = all(packet.samples == Int(means.all));
  const Float withinX = packet.whole ? Float(means.x[means.all]) : gather(means.x, packet.samples);
  const Float withinY = packet.whole ? Float(means.y[means.all]) : gather(means.y, packet.samples);
  packet.fragments.place = {toFloat(packet.fragments.x) + withinX, toFloat(packet.fragments.y) + withinY};
  return packet;
}

HWY_INLINE Surface surfaceOf(const ShowJob& job, const Packet& packet) {
  Surface surface = surfaceOf(job.scene, job.textures, packet.fragments);
  surface.receiver.samples = packet.samples;
  return surface;
}

/// The same without what surfaces are made of.
HWY_INLINE Receiver receiversOf(const ShowJob& job, const Packet& packet) {
  Receiver receiver = receiversOf(job.scene, packet.fragments);
  receiver.samples = packet.samples;
  return receiver;
}

} // namespace gnomon::cpu::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();
#endif
