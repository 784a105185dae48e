// bench/soak_trouble.h: what befalls a service in the long run, beside its load: viewers, floods, a
// sender that is killed and started again, a log that is rolled over, and a disk that fills and
// empties.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "articulated/result.h"
#include "bench/inputs.h"
#include "network/wire/wire.h"

namespace foretouch::tools {

struct TroubleRequest {
  BenchFiles files;
  UdpmUrl url;
  int avatar = 1;         ///< The one whose sender is restarted; nothing else sends its poses.
  std::string logFolder;  ///< Where the service logs to. What is on the same disk may find it full.
  bool fillsDisk = false;
};

struct TroubleCounts {
  std::int64_t floods = 0, floodDatagrams = 0, restarts = 0, timesFull = 0;
  std::int64_t viewersLetGo = 0;
};

class SoakTrouble {
 public:
  /// What the service has to be started with, beside its scene and avatars.
  static std::vector<std::string> arguments(const std::string& logFolder);
  /// Errors: the service refuses a viewer.
  static Result<SoakTrouble> start(const TroubleRequest& request);
  SoakTrouble(SoakTrouble&&) noexcept;
  SoakTrouble& operator=(SoakTrouble&&) = delete;
  ~SoakTrouble();

  /// Call once a second; waits for nothing.
  void everySecond();
  /// Ends it all, and empties the disk.
  [[nodiscard]] TroubleCounts stop();

 private:
  struct Impl;
  explicit SoakTrouble(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace foretouch::tools
