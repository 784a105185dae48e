// network/service/service_channels.h: the names of a service's channels. Not installed.
#pragma once

#include <string>

#include "network/wire/wire.h"

namespace foretouch::internal {

/// The channels of everything but the moving world (world_desk.h).
struct ServiceChannels {
  explicit ServiceChannels(const std::string& suffix)
      : skeleton(kSkeletonChannel + suffix),
        pose(kPoseChannel + suffix),
        contacts(kContactsChannel + suffix),
        solid(kSolidChannel + suffix),
        person(kPersonChannel + suffix),
        status(kStatusChannel + suffix),
        speaker(kSpeakerChannel + suffix) {}
  std::string skeleton, pose, contacts, solid, person, status, speaker;
};

}  // namespace foretouch::internal
