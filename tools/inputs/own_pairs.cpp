#include "tools/inputs/own_pairs.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/clip/clip_file.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/name_pattern.h"
#include "tools/settings/setting.h"

namespace foretouch::tools {
namespace {

/// Links with LSS that match the two halves of a text, one list each.
struct LeftOutReading {
  std::vector<LinkId> a, b;
};

/// Reads the pairs to leave out. No pair with a link without LSS is asked.
class LeftOutReader {
 public:
  LeftOutReader(const std::string& option, const Avatar& avatar) : option_(option) {
    for (LinkId link = 0; link < avatar.numLinks(); ++link) {
      if (avatar.lss(link).empty()) continue;
      links_.push_back(link);
      names_.push_back(avatar.skeleton().name(link));
    }
  }

  [[nodiscard]] Result<LeftOutReading> read(std::string_view text) const {
    std::vector<LeftOutReading> readings;
    std::string_view unknown;
    for (std::size_t colon = text.find(':'); colon != std::string_view::npos;
         colon = text.find(':', colon + 1)) {
      const std::string_view first = text.substr(0, colon), second = text.substr(colon + 1);
      LeftOutReading reading{linksOf(first), linksOf(second)};
      if (reading.a.empty() || reading.b.empty()) {
        unknown = reading.a.empty() ? first : second;
      } else {
        readings.push_back(std::move(reading));
      }
    }
    if (readings.size() == 1) return std::move(readings.front());
    if (!readings.empty()) {
      return Error::in(option_, ErrorCode::Mismatch,
                       inQuotes(text) +
                           " can be read in more than one way, as names contain "
                           "colons; expected one reading");
    }
    if (unknown.data() == nullptr) {
      return Error::in(option_, ErrorCode::Syntax,
                       "expected two links, `a:b`, found " + inQuotes(text));
    }
    return Error::in(option_, ErrorCode::UnknownName,
                     inQuotes(unknown) + " of " + inQuotes(text) +
                         " is no link with LSS of the avatar" + didYouMean(unknown, names_));
  }

 private:
  [[nodiscard]] std::vector<LinkId> linksOf(std::string_view pattern) const {
    std::vector<LinkId> links;
    for (const std::int32_t i : matching(pattern, names_)) links.push_back(links_[slotOf(i)]);
    return links;
  }

  const std::string& option_;
  std::vector<LinkId> links_;
  std::vector<std::string> names_;  // of these links
};

Result<Done> addPoses(const Avatar& avatar, const Clip& clip, const JointMatch& match,
                      const std::string& path, std::size_t most, std::vector<Pose>& poses) {
  const std::size_t frames = clip.frames.size();
  const std::size_t count = std::min(frames, most);
  poses.reserve(poses.size() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t frame = i * frames / count;
    auto pose =
        validatedPose(avatar.skeleton(), poseOfAvatar(avatar.skeleton(), clip, match, frame));
    if (!pose.ok()) {
      Error error = inFile(pose.error(), path);
      error.message = fmt::format("frame {}: {}", frame, error.message);
      return error;
    }
    poses.push_back(std::move(pose).value());
  }
  return Done{};
}

}  // namespace

Result<Done> addUsualPoses(const Avatar& avatar, const Clip& clip, const JointMatch& match,
                           const std::string& path, std::vector<Pose>& poses) {
  return addPoses(avatar, clip, match, path, kMostUsualPoses, poses);
}

Result<std::vector<LinkPair>> parseLeftOut(const std::string& option,
                                           const std::vector<std::string>& texts,
                                           const Avatar& avatar) {
  const LeftOutReader reader(option, avatar);
  std::vector<LinkPair> pairs;
  for (const std::string& text : texts) {
    for (const std::string& part : splitAtCommas(text)) {
      FORETOUCH_TRY(const auto reading, reader.read(part));
      const std::size_t before = pairs.size();
      for (const LinkId a : reading.a) {
        for (const LinkId b : reading.b) {
          if (a != b) pairs.push_back({a, b});
        }
      }
      if (pairs.size() > before) continue;
      return Error::in(option, ErrorCode::Mismatch,
                       "expected two different links, found " + inQuotes(part));
    }
  }
  return pairs;
}

Result<Done> addSampledPoses(const Avatar& avatar, const ClipRequest& motion,
                             std::vector<Pose>& poses) {
  const RobotPairOptions usual;
  ClipFileOptions options;
  options.robot = motion.robotPath;
  options.packagePaths = motion.packagePaths;
  options.import.scale = motion.motionScale;
  FORETOUCH_TRY(const auto clip, sampleRobotFile(options, usual.samples, usual.seed));
  FORETOUCH_TRY(const auto match,
                matchWithMap(avatar.skeleton(), clip.skeleton, motion.mapPath, motion.robotPath));
  return addPoses(avatar, clip, match, motion.robotPath, clip.frames.size(), poses);
}

Result<PairRules> pairRulesFor(const WorldRequest& request, const ClipRequest& motion,
                               const Avatar& avatar, const Clip& clip, const JointMatch& match) {
  if (!request.pairsPath.empty()) return readPairsFile(request.pairsPath, avatar);
  std::vector<Pose> poses;
  PairRuleOptions options;
  options.isRestTaken = motion.robotPath.empty();
  FORETOUCH_CHECK(options.isRestTaken ? addUsualPoses(avatar, clip, match, motion.motionPath, poses)
                                      : addSampledPoses(avatar, motion, poses));
  options.usualPoses = &poses;
  auto rules = PairRules::derive(avatar, options);
  if (rules.ok()) return rules;
  Error error = rules.error();
  error.file = "--self";
  return error;
}

std::string reasonsOf(const PairRules& rules) {
  std::array<std::int64_t, kNumPairReasons> counts{};
  for (const LeftOutPair& pair : rules.leftOut()) ++counts[static_cast<std::size_t>(pair.reason)];
  std::string text;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    if (counts[i] == 0) continue;
    text += fmt::format("{}{} {}", text.empty() ? "" : ", ", counts[i],
                        toString(static_cast<PairReason>(i)));
  }
  return text;
}

}  // namespace foretouch::tools
