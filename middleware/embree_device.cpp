#include "middleware/embree_device.h"

#include <string>

namespace foretouch::internal {

Result<EmbreeDevice> newEmbreeDevice() {
  EmbreeDevice device(rtcNewDevice(nullptr));
  if (device == nullptr) {
    return Error{
        ErrorCode::DeviceFailed, "", -1, -1,
        "Embree could not be started, error " + std::to_string(rtcGetDeviceError(nullptr))};
  }
  return device;
}

Result<Done> embreeStatus(RTCDevice device, const char* what) {
  const RTCError status = rtcGetDeviceError(device);
  if (status == RTC_ERROR_NONE) return Done{};
  return Error{ErrorCode::DeviceFailed, "", -1, -1,
               std::string("Embree failed while ") + what + ", error " + std::to_string(status)};
}

}  // namespace foretouch::internal
