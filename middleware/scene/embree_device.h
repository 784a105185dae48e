// middleware/scene/embree_device.h: Embree's device, owned. Not installed. Re-checked against
// Debian's Embree 3.13.5: the library never resets an error by itself, so every use reads it once
// after its calls.
#pragma once

#include <memory>

#include <embree3/rtcore.h>

#include "articulated/result.h"

namespace foretouch::internal {

struct ReleaseDevice {
  void operator()(RTCDevice device) const { rtcReleaseDevice(device); }
};
using EmbreeDevice = std::unique_ptr<std::remove_pointer_t<RTCDevice>, ReleaseDevice>;

/// A new device, or DeviceFailed.
[[nodiscard]] Result<EmbreeDevice> newEmbreeDevice();

/// The device's pending error as DeviceFailed, with `what` failed, or success.
[[nodiscard]] Result<Done> embreeStatus(RTCDevice device, const char* what);

}  // namespace foretouch::internal
