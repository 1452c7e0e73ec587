#pragma once

#include "renderer/rays/ray_packet.h"
#include "renderer/rays/tree.h"

/// Embree's rtcIntersect16 and rtcOccluded16 for any processor. Where its vectors hold fewer than sixteen numbers,
/// Embree 3.13 traces all lanes of such a packet, whichever are active, and ends the program over the numbers of the
/// others; so a packet is traced there in parts that are as wide as the vectors.
namespace gnomon {

/// The packets of rays that a device traces lane by lane: 16, 8 or 4 wide.
unsigned widestPackets(RTCDevice device);

/// Of each active lane: what it first meets, into packet.hit and packet.ray.tfar. A ray that is not finite, or begins
/// more than 1e18 units of the tree away, meets nothing.
void intersect(const TracedScene::Tree& tree, const Lanes& lanes, RTCIntersectContext& context, RTCRayHit16& packet);

/// Of each active lane: whether it meets anything; then its tfar is below zero.
void occlude(const TracedScene::Tree& tree, const Lanes& lanes, RTCIntersectContext& context, RTCRay16& rays);

} // namespace gnomon
