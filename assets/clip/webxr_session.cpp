#include "assets/clip/webxr_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using nlohmann::json;

constexpr std::size_t kPlaceNumbers = 7, kJointNumbers = 8;  // a joint also has its radius
constexpr double kMsPerS = 1000.0;
/// How far a quaternion's norm may be off: four components, each rounded to a thousandth.
constexpr double kMostNormError = 2e-3;
/// The ratio of a frame's time to the usual one beyond which frames were left out.
constexpr double kNotedGap = 2.5;
/// An instant at most this share of the way from a frame is that frame's: times are rounded.
constexpr double kAtFrame = 1e-6;

Error wrong(const std::string& message, ErrorCode code = ErrorCode::Syntax,
            std::int64_t frame = -1) {
  const std::string place = frame < 0 ? "" : "frame " + std::to_string(frame) + ": ";
  return {code, "", -1, frame, place + message};
}

RigidPose operator*(const RigidPose& outer, const RigidPose& inner) {
  return {outer.rotation * inner.rotation, outer.translation + outer.rotation * inner.translation};
}
RigidPose inverse(const RigidPose& pose) {
  const Quaternion back = pose.rotation.conjugate();
  return {back, -(back * pose.translation)};
}

/// Seven numbers of an array, from `at` on.
Result<RigidPose> placeIn(const json& numbers, std::size_t at, std::int64_t frame) {
  std::array<double, kPlaceNumbers> n{};
  for (std::size_t i = 0; i < kPlaceNumbers; ++i) {
    if (!numbers.is_array() || numbers.size() <= at + i || !numbers[at + i].is_number()) {
      return wrong("expected a place of seven numbers", ErrorCode::Syntax, frame);
    }
    n[i] = numbers[at + i].get<double>();
  }
  const Quaternion q(n[6], n[3], n[4], n[5]);
  if (!(std::abs(q.norm() - 1.0) <= kMostNormError)) {
    return wrong("expected a unit quaternion", ErrorCode::OutOfRange, frame);
  }
  return RigidPose{q.normalized(), {n[0], n[1], n[2]}};
}

/// What carries a joint of WebXR's hand; empty: the wrist, which nothing carries.
std::string carrierOf(const std::string& joint) {
  static const std::vector<std::string> kAlong{"metacarpal", "phalanx-proximal",
                                               "phalanx-intermediate", "phalanx-distal", "tip"};
  if (joint == "wrist") return "";
  for (std::size_t i = 1; i < kAlong.size(); ++i) {
    const std::size_t at = joint.size() - std::min(joint.size(), kAlong[i].size());
    if (joint.compare(at, std::string::npos, kAlong[i]) != 0) continue;
    const std::string finger = joint.substr(0, at);
    const bool isThumb = finger == "thumb-", skips = isThumb && kAlong[i] == "phalanx-distal";
    return finger + kAlong[i - (skips ? 2 : 1)];
  }
  return "wrist";
}

struct Input {
  std::string name;
  bool hasGrip = false, hasHand = false;
  std::vector<std::string> joints;  ///< A hand's, in the file's order.
  std::size_t first = 0;            ///< Its first joint in the clip.
};

/// Where everything is in a frame, in the world; absent inputs as before.
struct Instant {
  double timeS = 0.0;
  std::vector<RigidPose> places;  ///< Per joint of the clip.
  std::vector<bool> isSeen;       ///< The same: in this frame.
};

class SessionReader {
 public:
  /// Every part of the session as it is parsed: `depth` is that of what holds it. False: it has
  /// been read, and need not be kept. A session may have many more frames than fit into memory as
  /// JSON.
  bool take(int depth, json::parse_event_t event, const json& part) {
    using Event = json::parse_event_t;
    if (event == Event::key && depth == 1) key_ = part.get<std::string>();
    const bool isWhole =
        event == Event::array_end || event == Event::object_end || event == Event::value;
    if (!isWhole || !read_.ok()) return read_.ok();
    if (depth == 1 && key_ == "schema") {
      if (!names_.empty()) read_ = wrong("expected one 'schema', found two");
      if (read_.ok()) read_ = part.is_array() ? readSchema(part) : noSession();
    } else if (depth == 2 && key_ == "frames") {
      read_ = names_.empty() ? wrong("expected 'schema' before 'frames'") : readFrame(part);
      return false;
    }
    return true;
  }

  /// `rest`: what take() has left of it.
  Result<Done> finish(const json& rest) {
    FORETOUCH_CHECK(read_);
    const bool isSession = rest.is_object() && rest.contains("schema") && rest.contains("frames") &&
                           rest["frames"].is_array();
    if (!isSession) return noSession();
    if (instants_.size() < 2) return wrong("expected at least two frames", ErrorCode::Empty);
    return Done{};
  }

  Result<Clip> take(std::optional<double> rateHz) {
    for (std::size_t joint = 0; joint < names_.size(); ++joint) {
      if (isSeen_[joint]) continue;
      return wrong("joint " + inQuotes(names_[joint]) + " is in no frame", ErrorCode::Empty);
    }
    Clip clip;
    RawSkeleton raw;
    const std::vector<RigidPose> rest = localOf(firstSeen_);
    for (std::size_t j = 0; j < names_.size(); ++j) {
      raw.joints.push_back({names_[j], parents_[j], rest[j].translation, rest[j].rotation});
    }
    FORETOUCH_TRY(clip.skeleton, Skeleton::build(raw));
    const double length = instants_.back().timeS - instants_.front().timeS;
    const auto steps = static_cast<double>(instants_.size() - 1);
    clip.frameTimeS = rateHz ? 1.0 / *rateHz : length / steps;
    if (!(clip.frameTimeS >= kMinFrameTimeS && clip.frameTimeS <= kMaxFrameTimeS)) {
      return wrong("expected frames a microsecond to an hour apart", ErrorCode::OutOfRange);
    }
    findSpacing();
    FORETOUCH_CHECK(sample(length, clip));
    clip.hasRotation.assign(names_.size(), true);
    clip.hasTranslation.assign(names_.size(), true);
    clip.endSites.resize(names_.size());
    addNotes(clip);
    return clip;
  }

 private:
  static Error noSession() {
    return wrong("expected a session of iwer's recorder: 'schema' and 'frames'");
  }

  std::size_t addJoint(const std::string& name, JointId parent) {
    names_.push_back(name);
    parents_.push_back(parent);
    isSeen_.push_back(false);
    firstSeen_.emplace_back();
    seenFrom_.push_back(0);
    return names_.size() - 1;
  }

  Result<Done> readSchema(const json& schema) {
    addJoint("viewer", kNoParent);
    for (const json& entry : schema) {
      if (!entry.is_array() || entry.size() != 2 || !entry[0].is_number_unsigned() ||
          !entry[1].is_object()) {
        return wrong("schema: expected entries of a number and an object");
      }
      FORETOUCH_CHECK(readInput(entry[0].get<std::size_t>(), entry[1]));
    }
    return Done{};
  }

  Result<Done> readInput(std::size_t index, const json& schema) {
    const auto flag = [&](const char* key) {
      return schema.contains(key) && schema[key].is_boolean() && schema[key].get<bool>();
    };
    Input input;
    const bool isNamed = schema.contains("handedness") && schema["handedness"].is_string();
    input.name = isNamed ? schema["handedness"].get<std::string>() : "none";
    while (!inputNames_.insert(input.name).second) input.name += "'";
    input.hasGrip = flag("hasGrip");
    input.hasHand = flag("hasHand");
    if (!input.hasHand) {
      input.first = addJoint(input.name + (input.hasGrip ? " grip" : " ray"), kNoParent);
    } else {
      FORETOUCH_CHECK(readHand(schema, input));
    }
    if (!inputs_.emplace(index, std::move(input)).second) {
      return wrong("schema: two inputs have one number", ErrorCode::DuplicateName);
    }
    return Done{};
  }

  Result<Done> readHand(const json& schema, Input& input) {
    const json joints = schema.value("jointSequence", json());
    std::map<std::string, std::size_t> placeOf;
    for (const json& joint : joints) {
      if (!joint.is_string()) return wrong("schema: expected names in 'jointSequence'");
      input.joints.push_back(joint.get<std::string>());
    }
    if (input.joints.empty() || input.joints[0] != "wrist") {
      return wrong("schema: expected a 'jointSequence' that begins with 'wrist'");
    }
    input.first = names_.size();
    for (const std::string& joint : input.joints) {
      const auto carrier = placeOf.find(carrierOf(joint));
      const bool hangs = carrier != placeOf.end();
      if (!hangs && joint != "wrist") {
        return wrong("schema: joint " + inQuotes(joint) + " comes before what carries it",
                     ErrorCode::BadHierarchy);
      }
      const auto parent = hangs ? static_cast<JointId>(carrier->second) : kNoParent;
      placeOf[joint] = addJoint(input.name + " " + joint, parent);
    }
    return Done{};
  }

  Result<Done> readFrame(const json& frame) {
    const auto number = static_cast<std::int64_t>(instants_.size());
    constexpr std::size_t kChannels = 7;
    if ((instants_.size() + 1) * names_.size() * kChannels > kMaxBvhValues) {
      return wrong("expected at most 2^26 values", ErrorCode::LimitExceeded);
    }
    if (!frame.is_array() || frame.empty() || !frame[0].is_number()) {
      return wrong("expected a time and places", ErrorCode::Syntax, number);
    }
    Instant instant;
    instant.timeS = frame[0].get<double>() / kMsPerS;
    if (!instants_.empty() && !(instant.timeS > instants_.back().timeS)) {
      return wrong("expected a time after that of the frame before", ErrorCode::OutOfRange, number);
    }
    instant.places =
        instants_.empty() ? std::vector<RigidPose>(names_.size()) : instants_.back().places;
    instant.isSeen.assign(names_.size(), false);
    FORETOUCH_TRY(const auto viewer, placeIn(frame, 1, number));
    see(instant, 0, viewer);
    std::set<std::size_t> present;
    for (std::size_t i = 1 + kPlaceNumbers; i < frame.size(); ++i) {
      FORETOUCH_CHECK(readInputFrame(frame[i], number, instant, present));
    }
    for (const auto& [index, input] : inputs_)
      absent_[input.name] += present.count(index) == 0 ? 1 : 0;
    instants_.push_back(std::move(instant));
    return Done{};
  }

  Result<Done> readInputFrame(const json& said, std::int64_t number, Instant& instant,
                              std::set<std::size_t>& present) {
    const bool isNumbered = said.is_array() && !said.empty() && said[0].is_number_unsigned();
    const auto found = isNumbered ? inputs_.find(said[0].get<std::size_t>()) : inputs_.end();
    if (found == inputs_.end()) {
      return wrong("expected an input of the schema", ErrorCode::UnknownName, number);
    }
    const Input& input = found->second;
    present.insert(found->first);
    FORETOUCH_TRY(const auto ray, placeIn(said, 1, number));
    std::size_t at = 1 + kPlaceNumbers;
    const auto part = [&]() -> const json& { return at < said.size() ? said[at] : kNothing; };
    RigidPose held = ray;
    if (input.hasGrip) {
      FORETOUCH_TRY(held, placeIn(part(), 0, number));
      ++at;
    }
    if (!input.hasHand) {
      see(instant, input.first, held);
      return Done{};
    }
    const json& joints = part();
    if (!joints.is_array() || joints.size() != kJointNumbers * input.joints.size()) {
      return wrong("expected eight numbers for each joint of a hand", ErrorCode::Mismatch, number);
    }
    for (std::size_t j = 0; j < input.joints.size(); ++j) {
      FORETOUCH_TRY(const auto local, placeIn(joints, kJointNumbers * j, number));
      see(instant, input.first + j, ray * local);
    }
    return Done{};
  }

  void see(Instant& instant, std::size_t joint, const RigidPose& place) {
    instant.places[joint] = place;
    instant.isSeen[joint] = true;
    if (isSeen_[joint]) return;
    isSeen_[joint] = true;
    firstSeen_[joint] = place;
    seenFrom_[joint] = instants_.size();
  }

  [[nodiscard]] std::vector<RigidPose> localOf(const std::vector<RigidPose>& world) const {
    std::vector<RigidPose> local = world;
    for (std::size_t j = 0; j < world.size(); ++j) {
      if (parents_[j] != kNoParent) local[j] = inverse(world[slotOf(parents_[j])]) * world[j];
    }
    return local;
  }

  /// Before an input is seen, its place is where it is first seen.
  [[nodiscard]] const RigidPose& placeAt(std::size_t instant, std::size_t joint) const {
    return instant < seenFrom_[joint] ? firstSeen_[joint] : instants_[instant].places[joint];
  }

  Result<Done> sample(double lengthS, Clip& clip) const {
    const double samples = std::floor(lengthS / clip.frameTimeS + 1e-6) + 1.0;
    if (samples * static_cast<double>(names_.size()) * 7.0 > static_cast<double>(kMaxBvhValues)) {
      return wrong("expected at most 2^26 values", ErrorCode::LimitExceeded);
    }
    std::size_t after = 1;
    std::vector<RigidPose> world(names_.size());
    std::vector<std::size_t> lastGap(names_.size(), kNoGap);
    for (double k = 0.0; k < samples; k += 1.0) {
      const double timeS = instants_.front().timeS + k * clip.frameTimeS;
      while (after + 1 < instants_.size() && instants_[after].timeS < timeS) ++after;
      const double from = instants_[after - 1].timeS, to = instants_[after].timeS;
      const double t = std::clamp((timeS - from) / (to - from), 0.0, 1.0);
      for (std::size_t j = 0; j < world.size(); ++j) {
        const RigidPose &a = placeAt(after - 1, j), &b = placeAt(after, j);
        world[j] = {a.rotation.slerp(t, b.rotation).normalized(),
                    a.translation + t * (b.translation - a.translation)};
      }
      Pose pose;
      for (const RigidPose& local : localOf(world)) {
        pose.rotations.push_back(local.rotation.normalized());
        pose.translations.push_back(local.translation);
      }
      FORETOUCH_TRY(auto checked, validatedPose(clip.skeleton, pose));
      addGaps(after, t, lastGap, clip);
      clip.frames.push_back(std::move(checked));
    }
    return Done{};
  }

  /// Adds the gaps of the next frame, at `t` between an instant and the one before it.
  void addGaps(std::size_t after, double t, std::vector<std::size_t>& lastGap, Clip& clip) const {
    const auto frame = static_cast<std::int64_t>(clip.frames.size());
    const Instant &from = instants_[after - 1], &to = instants_[after];
    const bool isFrom = t <= kAtFrame, isTo = t >= 1.0 - kAtFrame;
    const bool isLeftOut = !isFrom && !isTo && to.timeS - from.timeS > kNotedGap * usualS_;
    for (std::size_t j = 0; j < names_.size(); ++j) {
      const bool isSeen = (isTo || from.isSeen[j]) && (isFrom || to.isSeen[j]);
      if (isSeen && !isLeftOut) continue;
      if (lastGap[j] == kNoGap || clip.gaps[lastGap[j]].last != frame - 1) {
        lastGap[j] = clip.gaps.size();
        clip.gaps.push_back({frame, frame, static_cast<JointId>(j)});
      }
      clip.gaps[lastGap[j]].last = frame;
    }
  }

  void findSpacing() {
    std::vector<double> spacings;
    for (std::size_t k = 1; k < instants_.size(); ++k) {
      spacings.push_back(instants_[k].timeS - instants_[k - 1].timeS);
    }
    std::sort(spacings.begin(), spacings.end());
    longestS_ = spacings.back();
    usualS_ = spacings[spacings.size() / 2];
  }

  void addNotes(Clip& clip) const {
    if (longestS_ > kNotedGap * usualS_) {
      clip.notes.push_back("there are " + inDigits(longestS_, 3) +
                           " s between two of its frames; what happened there is not recorded");
    }
    for (const auto& [name, count] : absent_) {
      if (count == 0) continue;
      clip.notes.push_back(inQuotes(name) + " is absent in " + std::to_string(count) +
                           " frames; it is held where it was before");
    }
  }

  inline static const json kNothing = json();
  static constexpr std::size_t kNoGap = static_cast<std::size_t>(-1);
  std::string key_;  // of the session's part that is being parsed
  Result<Done> read_ = Done{};
  std::vector<std::string> names_;
  std::vector<JointId> parents_;
  std::vector<bool> isSeen_;
  std::vector<RigidPose> firstSeen_;
  std::vector<std::size_t> seenFrom_;    // per joint: a frame
  std::map<std::size_t, Input> inputs_;  // by number
  std::set<std::string> inputNames_;
  std::map<std::string, std::int64_t> absent_;
  std::vector<Instant> instants_;
  double longestS_ = 0.0, usualS_ = 0.0;  // between two of them
};

}  // namespace

Result<Clip> parseWebXrSession(std::string_view text, const std::string& name,
                               std::optional<double> rateHz) {
  SessionReader reader;
  json rest;
  try {
    rest = json::parse(text.begin(), text.end(),
                       [&](int depth, json::parse_event_t event, const json& part) {
                         return reader.take(depth, event, part);
                       });
  } catch (const json::parse_error& error) {
    const std::size_t place = std::min(error.byte, text.size());
    const auto line =
        1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(place), '\n');
    return Error::inLine(name, line, ErrorCode::Syntax,
                         "expected JSON, and it ends or breaks off here");
  } catch (const json::exception&) {
    return Error::in(name, ErrorCode::Syntax, "expected JSON with numbers that a double holds");
  }
  const auto read = reader.finish(rest);
  if (!read.ok()) return inFile(read.error(), name);
  return inFile(reader.take(rateHz), name);
}

}  // namespace foretouch
