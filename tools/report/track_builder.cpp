#include "tools/report/track_builder.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include "lss/assert.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

void append(const Eigen::Vector3d& v, std::vector<double>& numbers) {
  numbers.insert(numbers.end(), v.data(), v.data() + 3);
}

Eigen::Vector3d vectorAt(const std::vector<double>& numbers, std::size_t index) {
  return {numbers[3 * index], numbers[3 * index + 1], numbers[3 * index + 2]};
}

/// The same bits: -0 is not 0.
bool isSame(const Eigen::Vector3d& v, const Eigen::Vector3d& w) {
  return std::memcmp(v.data(), w.data(), 3 * sizeof(double)) == 0;
}

}  // namespace

std::optional<Query> touchQuestion(const Avatar& avatar, const Scene& scene,
                                   const QueryOptions& options) {
  auto query = Query::build(avatar, scene, options);
  if (!query.ok()) return std::nullopt;
  return std::move(query).value();
}

TrackBuilder::TrackBuilder(const Avatar& avatar, std::optional<Query> question)
    : avatar_(avatar), question_(std::move(question)) {
  if (question_) track_.touchingFirst.push_back(0);
}

std::size_t TrackBuilder::capacity(std::size_t numbers) const {
  return numbers / (4 * countOf(avatar_.numLinks()));
}

void TrackBuilder::addPose(double timeS, const Pose& pose) {
  FORETOUCH_ASSERT(track_.poseTimesS.empty() || timeS > track_.poseTimesS.back());
  for (const Quaternion& q : pose.rotations) {
    for (const double number : {q.w(), q.x(), q.y(), q.z()}) track_.rotations.push_back(number);
  }
  addTranslations(pose);
  track_.poseTimesS.push_back(timeS);
  motion_.assign(avatar_.skeleton(), pose, pose);
  growBox(motion_);
  if (question_) askWhatTouches(motion_);
}

void TrackBuilder::addTranslations(const Pose& pose) {
  const std::size_t before = track_.poses();
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    const auto index = slotOf(link);
    const Eigen::Vector3d& translation = pose.translations[index];
    if (before == 0) {
      append(translation, track_.offsets);
      continue;
    }
    auto moving = moving_.find(link);
    if (moving == moving_.end()) {
      const Eigen::Vector3d offset = vectorAt(track_.offsets, index);
      if (isSame(translation, offset)) continue;
      // It stood still so far.
      moving = moving_.try_emplace(link).first;
      for (std::size_t i = 0; i < before; ++i) append(offset, moving->second);
    }
    append(translation, moving->second);
  }
}

void TrackBuilder::growBox(const ChainMotion& motion) {
  motion.statesAt(0.0, states_);
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    const LinkState& state = states_[slotOf(link)];
    for (const Lss& lss : avatar_.lss(link)) {
      const Eigen::Vector3d reach = Eigen::Vector3d::Constant(lss.radius);
      for (const Eigen::Vector3d& end : {state.pointAt(lss.a), state.pointAt(lss.b)}) {
        box_.extend(end - reach);
        box_.extend(end + reach);
      }
    }
  }
}

void TrackBuilder::askWhatTouches(const ChainMotion& motion) {
  for (LinkId link = 0; link < avatar_.numLinks(); ++link) {
    if (question_->touchesAt(motion, link, 0.0, scratch_)) {
      track_.touching.push_back(static_cast<std::uint16_t>(link));
    }
  }
  track_.touchingFirst.push_back(static_cast<std::uint32_t>(track_.touching.size()));
}

void TrackBuilder::addStep(std::uint32_t from, std::uint32_t to, std::optional<double> latencyUs) {
  FORETOUCH_ASSERT(from <= to && to < poses());
  track_.stepFrom.push_back(from);
  track_.stepTo.push_back(to);
  if (latencyUs) track_.latencyUs.push_back(*latencyUs);
}

bool TrackBuilder::touches(std::size_t pose, LinkId link) const {
  if (!question_) return false;
  const auto first = track_.touching.begin() + track_.touchingFirst[pose];
  const auto last = track_.touching.begin() + track_.touchingFirst[pose + 1];
  return std::binary_search(first, last, static_cast<std::uint16_t>(link));
}

ViewTrack TrackBuilder::finish() {
  for (const auto& [link, values] : moving_) track_.moving.push_back(link);
  for (std::size_t pose = 0; pose < poses(); ++pose) {
    for (const auto& [link, values] : moving_) append(vectorAt(values, pose), track_.values);
  }
  moving_.clear();
  return std::move(track_);
}

Pose poseOf(const ViewTrack& track, std::size_t pose) {
  const std::size_t links = track.offsets.size() / 3;
  Pose made;
  for (std::size_t link = 0; link < links; ++link) {
    const double* const q = track.rotations.data() + 4 * (pose * links + link);
    made.rotations.emplace_back(q[0], q[1], q[2], q[3]);
    made.translations.push_back(vectorAt(track.offsets, link));
  }
  const std::size_t moving = track.moving.size();
  for (std::size_t i = 0; i < moving; ++i) {
    made.translations[slotOf(track.moving[i])] = vectorAt(track.values, pose * moving + i);
  }
  return made;
}

}  // namespace foretouch::tools
