#include "tests/fuzz/fuzz_inputs.h"

#include <cmath>
#include <string>
#include <string_view>

#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "tests/fuzz/promise.h"

namespace foretouch::fuzz {
namespace {

std::string_view textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

void checkError(const Error& error) {
  require(!error.message.empty(), "an error says what is wrong");
  require(error.file == "input", "an error names its file");
  require(error.line == -1 || error.line >= 1, "lines count from 1");
}

void checkRoundTrip(const Avatar& avatar) {
  const std::string text = formatAvatar(avatar);
  if (text.size() > kMaxAvatarFileBytes) return;
  const auto again = parseAvatar(text, "written");
  require(again.ok(), "a written avatar is read");
  require(formatAvatar(again.value()) == text, "a written avatar is read as it was");
}

void checkClip(const Clip& clip) {
  const auto joints = static_cast<std::size_t>(clip.skeleton.numJoints());
  require(joints >= 1 && joints <= static_cast<std::size_t>(kMaxJoints), "joints are bounded");
  require(clip.hasRotation.size() == joints && clip.hasTranslation.size() == joints &&
              clip.endSites.size() == joints,
          "per-joint lists have one entry a joint");
  require(clip.frames.size() >= 1, "a clip has a frame");
  require(clip.frameTimeS >= kMinFrameTimeS && clip.frameTimeS <= kMaxFrameTimeS,
          "the frame time is in its range");
  require(std::isfinite(clip.durationS()), "the duration is finite");
  require(clip.notes.size() <= kMaxClipNotes, "notes are bounded");
  for (const Pose& frame : clip.frames) {
    const auto pose = validatedPose(clip.skeleton, frame);
    require(pose.ok(), "every frame is a valid pose");
    for (std::size_t j = 0; j < joints; ++j) {
      require(pose.value().rotations[j].coeffs() == frame.rotations[j].coeffs(),
              "rotations of frames are unit");
    }
  }
  for (const auto& sites : clip.endSites) {
    for (const auto& site : sites) require(site.allFinite(), "End Sites are finite");
  }
}

}  // namespace

bool feedBvh(const std::uint8_t* data, std::size_t size) {
  const auto clip = parseBvh(textOf(data, size), "input");
  if (!clip.ok()) {
    checkError(clip.error());
    return false;
  }
  checkClip(clip.value());
  const auto avatar = avatarFromClip(clip.value());
  if (avatar.ok()) {
    checkRoundTrip(avatar.value());
  } else {
    require(!avatar.error().message.empty(), "an error says what is wrong");
  }
  return true;
}

bool feedAvatar(const std::uint8_t* data, std::size_t size) {
  const auto avatar = parseAvatar(textOf(data, size), "input");
  if (!avatar.ok()) {
    checkError(avatar.error());
    return false;
  }
  require(avatar.value().numLss() >= 1, "an avatar has an LSS");
  checkRoundTrip(avatar.value());
  return true;
}

bool feedPairs(const std::uint8_t* data, std::size_t size) {
  static const Avatar avatar = parseAvatar(R"({"format":"foretouch-avatar","version":1,"links":[
{"name":"a","parent":null,"offset":[0,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"b","parent":"a","offset":[1,0,0],"lss":[{"a":[0,0,0],"b":[1,0,0],"radius":0.1}]},
{"name":"c","parent":"b","offset":[-0.85,0,0],"lss":[{"a":[0,0,0],"b":[0,0,0],"radius":0.1}]},
{"name":"d","parent":"c","offset":[0,1,0],"lss":[]}]})",
                                           "avatar")
                                   .value();
  const auto rules = parsePairs(textOf(data, size), "input", avatar);
  if (!rules.ok()) {
    checkError(rules.error());
    return false;
  }
  require(rules.value().numAsked() >= 1, "something is asked");
  const std::string text = formatPairs(rules.value(), avatar);
  const auto again = parsePairs(text, "written", avatar);
  require(again.ok(), "written rules are read");
  require(formatPairs(again.value(), avatar) == text, "written rules are read as they were");
  require(again.value().numAsked() == rules.value().numAsked(), "they ask the same");
  return true;
}

}  // namespace foretouch::fuzz
