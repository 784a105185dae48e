#include "tests/fuzz/clip_inputs.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "assets/clip/acclaim.h"
#include "assets/clip/webxr_session.h"
#include "lss/index.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

bool checkClip(const Result<Clip>& read) {
  if (!read.ok()) {
    checkReason(read.error());
    require(!read.error().file.empty(), "an error names its file");
    return false;
  }
  const Clip& clip = read.value();
  require(!clip.frames.empty(), "a clip has frames");
  require(std::isfinite(clip.frameTimeS) && clip.frameTimeS > 0.0, "time goes on");
  const std::size_t joints = countOf(clip.skeleton.numJoints());
  require(clip.hasRotation.size() == joints && clip.hasTranslation.size() == joints &&
              clip.endSites.size() == joints,
          "every joint is described");
  for (const Pose& frame : clip.frames) {
    require(validatedPose(clip.skeleton, frame).ok(), "every frame is a pose");
  }
  return true;
}

}  // namespace

bool feedAcclaim(const std::uint8_t* data, std::size_t size) {
  const std::string_view text = textOf(data, size);
  const std::size_t end = std::min(text.find('\0'), text.size());
  const std::string_view amc = text.substr(std::min(end + 1, text.size()));
  return checkClip(parseAcclaim(text.substr(0, end), "input", amc, "input"));
}

bool feedWebXr(const std::uint8_t* data, std::size_t size) {
  return checkClip(parseWebXrSession(textOf(data, size), "input"));
}

}  // namespace foretouch::fuzz
