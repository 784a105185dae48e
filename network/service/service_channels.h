// network/service/service_channels.h: the names of a service's channels. Not installed.
#pragma once

#include <string>

#include "network/wire/wire.h"

namespace foretouch::internal {

/// Of everything but the world that moves (world_desk.h).
struct ServiceChannels {
  explicit ServiceChannels(const std::string& suffix)
      : skeleton(kSkeletonChannel + suffix),
        pose(kPoseChannel + suffix),
        contacts(kContactsChannel + suffix),
        solid(kSolidChannel + suffix),
        status(kStatusChannel + suffix),
        speaker(kSpeakerChannel + suffix) {}
  std::string skeleton, pose, contacts, solid, status, speaker;
};

}  // namespace foretouch::internal
