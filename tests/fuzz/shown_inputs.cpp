#include "tests/fuzz/shown_inputs.h"

#include <cmath>
#include <optional>
#include <vector>

#include "articulated/skeleton.h"
#include "tests/fuzz/memory_file.h"
#include "tests/fuzz/promise.h"
#include "tools/solid/solid_reader.h"

namespace foretouch::fuzz {
namespace {

using tools::SolidHeader;
using tools::SolidReader;
using tools::SolidRecord;

void checkPose(const Pose& pose, std::size_t joints) {
  require(pose.rotations.size() == joints && pose.translations.size() == joints,
          "a pose has a joint per link");
  for (const Quaternion& rotation : pose.rotations) {
    require(rotation.coeffs().allFinite(), "rotations are finite");
  }
  for (const Eigen::Vector3d& translation : pose.translations) {
    require(translation.allFinite(), "translations are finite");
  }
}

void checkHeader(const SolidHeader& header) {
  require(!header.links.empty() && header.links.size() <= std::size_t{kMaxJoints}, "links");
  require(std::isfinite(header.sceneScale) && header.sceneScale > 0.0, "the scene has a size");
  require(std::isfinite(header.tolerance), "the tolerance is finite");
}

void checkRecord(const SolidRecord& record, std::size_t joints) {
  require(record.times.size() == record.way.size(), "every piece of a way has its time");
  for (const Pose& pose : record.way) checkPose(pose, joints);
  for (const double time : record.times) require(std::isfinite(time), "times are finite");
  for (const double off : record.deviations) require(std::isfinite(off), "deviations are finite");
  for (const double value : {record.timeS, record.deviation, record.lift, record.clearance}) {
    require(std::isfinite(value), "numbers are finite");
  }
  if (record.start) checkPose(*record.start, joints);
  if (record.tracked) checkPose(*record.tracked, joints);
}

}  // namespace

bool feedShownPoses(const std::uint8_t* data, std::size_t size) {
  const MemoryFile file(data, size);
  auto reader = SolidReader::open(file.path());
  if (!reader.ok()) {
    checkReason(reader.error());
    return false;
  }
  checkHeader(reader.value().header());
  std::int64_t line = 1;
  for (;;) {
    const auto record = reader.value().next();
    if (!record.ok()) {
      checkReason(record.error());
      require(!reader.value().isComplete(), "what is broken is not complete");
      return false;
    }
    if (!record.value()) return true;
    require(record.value()->line == ++line, "every line is a tick");
    checkRecord(*record.value(), reader.value().header().links.size());
  }
}

}  // namespace foretouch::fuzz
