#include "middleware/scene/embree_device.h"

#include <string>

namespace foretouch::internal {

namespace {

// Embree and its TBB are not built with ThreadSanitizer, so it cannot see how they synchronise and
// takes their parallel build for races. One thread builds the same tree; our own threads stay in
// view.
#if defined(__SANITIZE_THREAD__)
constexpr const char* kConfiguration = "threads=1,user_threads=1";
#else
constexpr const char* kConfiguration = nullptr;
#endif

}  // namespace

Result<EmbreeDevice> newEmbreeDevice() {
  EmbreeDevice device(rtcNewDevice(kConfiguration));
  if (device == nullptr) {
    return Error::of(ErrorCode::DeviceFailed, "Embree could not be started, error " +
                                                  std::to_string(rtcGetDeviceError(nullptr)));
  }
  return device;
}

Result<Done> embreeStatus(RTCDevice device, const char* what) {
  const RTCError status = rtcGetDeviceError(device);
  if (status == RTC_ERROR_NONE) return Done{};
  return Error::of(ErrorCode::DeviceFailed, std::string("Embree failed while ") + what +
                                                ", error " + std::to_string(status));
}

}  // namespace foretouch::internal
