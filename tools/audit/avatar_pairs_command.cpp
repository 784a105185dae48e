#include "tools/audit/avatar_pairs_command.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/pair_rules.h"
#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/json_writer.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/audit/audits.h"
#include "tools/inputs/joint_map.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/own_pairs.h"
#include "tools/results_output.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

/// Shares from one pose in a thousand to all.
constexpr NumberRange kShareRange{1e-3, 1.0};
/// From the thickness of paint to that of a coat.
constexpr NumberRange kSkinRange{1e-6, 0.1, "metres", "m"};

/// The values of all options.
struct AskedPairs {
  std::string source, output;
  ClipRequest reading;  ///< How to read the clips; `motionPath` is each of them in turn.
  std::vector<std::string> clips;
  BvhAvatarOptions making;
  PairRuleOptions rules;
  std::vector<std::string> leftOut;
  bool asJson = false;
};

bool isBvh(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".bvh";
}

Result<Motion> readNoted(const ClipRequest& request, const Skeleton& avatar) {
  FORETOUCH_TRY(auto motion, readMotion(motionRequestOf(request)));
  FORETOUCH_CHECK(followByParts(avatar, request.mapPath, request.motionPath, motion.clip));
  for (const std::string& note : motion.clip.notes) {
    printNote(request.motionPath + ": " + note);
  }
  return motion;
}

/// The avatar of the file, or the one that `avatar bvh` makes of a clip.
Result<Avatar> readAvatar(const AskedPairs& asked) {
  if (!isBvh(asked.source)) return readAvatarFile(asked.source);
  BvhOptions reading;
  reading.scale = asked.reading.motionScale.value_or(1.0);
  FORETOUCH_TRY(const auto clip, readBvhFile(asked.source, reading));
  return inFile(avatarFromClip(clip, asked.making), asked.source);
}

/// A robot's limits say which poses it takes, unless clips do.
bool isSampled(const AskedPairs& asked) {
  return asked.clips.empty() && !asked.reading.robotPath.empty();
}

/// The poses of all clips; if none is given, of the robot or of the clip that makes the avatar.
Result<std::vector<Pose>> usualPoses(const AskedPairs& asked, const Avatar& avatar) {
  std::vector<std::string> clips = asked.clips;
  if (clips.empty() && isBvh(asked.source)) clips.push_back(asked.source);
  std::vector<Pose> poses;
  if (isSampled(asked)) {
    FORETOUCH_CHECK(addSampledPoses(avatar, asked.reading, poses));
    return poses;
  }
  for (const std::string& path : clips) {
    ClipRequest request = asked.reading;
    request.motionPath = path;
    FORETOUCH_TRY(const auto motion, readNoted(request, avatar.skeleton()));
    const auto match = matchWithMap(avatar.skeleton(), motion.clip.skeleton, request.mapPath, path);
    if (!match.ok()) return match.error();
    FORETOUCH_CHECK(addUsualPoses(avatar, motion.clip, match.value(), path, poses));
  }
  return poses;
}

std::string named(const Avatar& avatar, LinkId link) {
  return avatar.skeleton().name(link);
}

/// ", touch in 9800 of 10000 poses", if any are known.
std::string touchesOf(const PairRules& rules, const LeftOutPair& left) {
  for (const PairTouches& pair : rules.touches()) {
    if (pair.a != left.a || pair.b != left.b) continue;
    return fmt::format(", touch in {} of {} poses", pair.touches, rules.numUsualPoses());
  }
  return "";
}

/// One line per pair that is left out.
std::string leftOutTable(const Avatar& avatar, const PairRules& rules) {
  if (rules.leftOut().empty()) return "";
  std::string text =
      "\nLeft out, so that no answer says whether the two touch: each is a hole in the proof.\n";
  for (const LeftOutPair& pair : rules.leftOut()) {
    text += fmt::format("  {:<25}{:<25}{}{}\n", named(avatar, pair.a), named(avatar, pair.b),
                        toString(pair.reason), touchesOf(rules, pair));
  }
  return text;
}

/// Asked pairs that touch in no usual pose. That proves nothing: no pose between them was looked
/// at.
std::int64_t neverTouching(const PairRules& rules) {
  return std::count_if(rules.touches().begin(), rules.touches().end(), [&](const auto& pair) {
    return pair.touches == 0 && rules.reasonOf(pair.a, pair.b) == PairReason::Asked;
  });
}

/// One line per two LSS with a radius of their own.
std::string radiiTable(const Avatar& avatar, const PairRules& rules) {
  if (rules.radii().empty()) return "";
  std::string text = "\nAsked with a smaller sum of radii, at link fidelity only:\n";
  for (const PairRadius& own : rules.radii()) {
    const double sum =
        avatar.lss(own.a)[slotOf(own.lssA)].radius + avatar.lss(own.b)[slotOf(own.lssB)].radius;
    text += fmt::format("  {:<25}{:<25}{:.4g} m instead of {:.4g} m\n",
                        fmt::format("{} [{}]", named(avatar, own.a), own.lssA),
                        fmt::format("{} [{}]", named(avatar, own.b), own.lssB), own.radius, sum);
  }
  return text;
}

std::string describe(const Avatar& avatar, const PairRules& rules, std::size_t poses) {
  const auto count = [](auto number) { return std::to_string(number); };
  std::string leftOut = count(rules.leftOut().size());
  if (!rules.leftOut().empty()) leftOut += ": " + reasonsOf(rules);
  return auditRow("pairs of links", count(rules.numPairs())) +
         auditRow("  asked", count(rules.numAsked())) + auditRow("  left out", leftOut) +
         (rules.numUsualPoses() == 0
              ? ""
              : auditRow("  asked, never touching", count(neverTouching(rules)))) +
         auditRow("pair radii", count(rules.radii().size())) +
         auditRow("usual poses", count(poses)) + leftOutTable(avatar, rules) +
         radiiTable(avatar, rules);
}

std::string pairsJson(const AskedPairs& asked, const Avatar& avatar, const PairRules& rules,
                      std::size_t poses) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("avatar", asked.source);
  out.field("pairs", rules.numPairs());
  out.field("asked", rules.numAsked());
  out.list("left_out", rules.leftOut(), [&](const LeftOutPair& pair) {
    out.beginObject();
    out.field("a", named(avatar, pair.a));
    out.field("b", named(avatar, pair.b));
    out.field("reason", toString(pair.reason));
    out.endObject();
  });
  out.list("radii", rules.radii(), [&](const PairRadius& own) {
    out.beginObject();
    out.field("a", named(avatar, own.a));
    out.field("lss_a", own.lssA);
    out.field("b", named(avatar, own.b));
    out.field("lss_b", own.lssB);
    out.field("radius", own.radius);
    out.endObject();
  });
  out.field("usual_poses", poses);
  out.list("touches", rules.touches(), [&](const PairTouches& pair) {
    out.beginObject();
    out.field("a", named(avatar, pair.a));
    out.field("b", named(avatar, pair.b));
    out.field("touches", pair.touches);
    out.endObject();
  });
  if (!asked.output.empty()) out.field("output", asked.output);
  out.endObject();
  return text + "\n";
}

/// Where the rules themselves take standard output, the report on them goes to stderr.
void tellOfPairs(const AskedPairs& asked, const Avatar& avatar, const PairRules& rules,
                 std::size_t poses) {
  const std::string text =
      asked.asJson ? pairsJson(asked, avatar, rules, poses)
                   : asked.source + "\n" + describe(avatar, rules, poses) +
                         (asked.output.empty() ? "" : "\npairs: " + asked.output + "\n");
  isStandardOutput(asked.output) ? printAside(text) : printOut(text);
}

ExitCode run(AskedPairs asked) {
  std::vector<std::string> inputs = asked.clips;
  inputs.insert(inputs.end(), {asked.source, asked.reading.mapPath, asked.reading.robotPath});
  FORETOUCH_CHECK_OR(failed, checkIsNoInput(asked.output, inputs));
  FORETOUCH_TRY_OR(failed, const auto avatar, readAvatar(asked));
  FORETOUCH_TRY_OR(failed, const auto poses, usualPoses(asked, avatar));
  asked.rules.isRestTaken = !isSampled(asked);
  FORETOUCH_TRY_OR(failed, asked.rules.leftOut, parseLeftOut("--leave-out", asked.leftOut, avatar));
  asked.rules.usualPoses = &poses;
  auto derived = PairRules::derive(avatar, asked.rules);
  if (!derived.ok()) {
    Error error = derived.error();
    error.file = asked.source;
    return failed(error);
  }
  const PairRules& rules = derived.value();
  if (!asked.output.empty()) {
    FORETOUCH_CHECK_OR(failed, writePairsFile(rules, avatar, asked.output));
  }
  tellOfPairs(asked, avatar, rules, poses.size());
  return ExitCode::Done;
}

Settings pairsSettings(AskedPairs& asked) {
  Settings settings;
  settings
      .path("avatar", "AVATAR|CLIP", asked.source,
            "Avatar file, or a BVH clip: the avatar that foretouch avatar bvh makes of it")
      .files("json bvh")
      .required("an avatar file or a BVH clip");
  settings.output("-o,--output", "FILE", asked.output, "Pair rules to write, for replay --pairs");
  settings.asJson(asked.asJson);
  settings
      .list(
          "--clip", "CLIP", asked.clips,
          "Poses that the avatar usually takes: BVH, animated model, or csv; may be repeated. "
          "Not given: with --robot, poses drawn within its joints' limits; else those of the clip "
          "that the avatar is made of")
      .files(kClipEndings)
      .in(kInputGroup);
  settings.number("--always-share", "S", asked.rules.alwaysShare, kShareRange,
                  "Leave out links that touch in this share of the usual poses");
  settings.flag("--pair-radii", asked.rules.usePairRadii,
                "Ask LSS that overlap at rest with a smaller sum of radii, at link fidelity only");
  settings
      .number("--rest-skin", "M", asked.rules.restSkin, kSkinRange,
              "How far apart these are then at rest")
      .needing("--pair-radii");
  settings.list("--leave-out", "A:B", asked.leftOut,
                "Also leave out these pairs of links, separated by commas; may be repeated; "
                "a * stands for any beginning or ending");
  settings.number("--radius-scale", "S", asked.making.radiusScale, kAboveZero,
                  "Of an avatar made of a clip: multiplies every radius");
  addClipReadingSettings(settings, asked.reading);
  return settings;
}

}  // namespace

Command avatarPairsCommand() {
  const auto asked = std::make_shared<AskedPairs>();
  Command command{
      "pairs",
      "Find which of an avatar's own links a query asks whether they touch, and which not, and why",
      "Examples:\n"
      "  foretouch avatar pairs walker.avatar.json --clip walk.bvh --clip-scale 0.01 \\\n"
      "      -o walker.pairs.json\n"
      "  foretouch avatar pairs man.avatar.json --leave-out 'LeftHand*:LeftHand*'",
      pairsSettings(*asked)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
