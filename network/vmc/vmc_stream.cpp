#include "network/vmc/vmc_stream.h"

#include <algorithm>
#include <cmath>

#include "lss/index.h"

namespace foretouch {
namespace {

constexpr double kUsPerS = 1e6;
constexpr std::size_t kPlaceNumbers = 7;  // x, y, z; quaternion x, y, z, w

/// The place in a message of a name and kPlaceNumbers numbers, or more.
bool readPlace(const OscMessage& message, RigidPose& place) {
  if (message.numArguments < 1 + kPlaceNumbers || !message.arguments[0].text) return false;
  std::array<double, kPlaceNumbers> n{};
  for (std::size_t i = 0; i < kPlaceNumbers; ++i) {
    if (!message.arguments[i + 1].number) return false;
    n[i] = *message.arguments[i + 1].number;
  }
  place.translation = {n[0], n[1], n[2]};
  place.rotation = Quaternion(n[6], n[3], n[4], n[5]);
  return true;
}

std::optional<double> timeIn(const OscMessage& message) {
  const bool isTime = message.address == "/VMC/Ext/T" && message.numArguments > 0;
  return isTime ? message.arguments[0].number : std::nullopt;
}

}  // namespace

VmcStream::VmcStream(const VmcBody& body)
    : body_(&body), seenIn_(body.numBones(), 0), bones_(body.numBones(), false) {
  open_.bones.resize(body.numBones());
  open_.has.resize(body.numBones(), false);
}

bool VmcStream::take(ByteView datagram, std::int64_t receiveUtimeUs, std::vector<Said>& said) {
  std::optional<double> time;
  OscMessage message;
  OscReader check(datagram);
  while (check.next(message)) {
    if (!time) time = timeIn(message);
  }
  if (check.isBroken()) return false;
  // What comes with another time is of another frame, wherever in its datagram the time stands.
  if (time) closeBefore(*time, said);
  now_ = receiveUtimeUs;
  ++datagram_;
  OscReader reader(datagram);
  while (reader.next(message)) takeMessage(message, said);
  if (isComplete()) close(said);
  return true;
}

void VmcStream::takeMessage(const OscMessage& message, std::vector<Said>& said) {
  if (message.address == "/VMC/Ext/Bone/Pos") {
    takeBone(message, said);
  } else if (message.address == "/VMC/Ext/Root/Pos") {
    takeRoot(message, said);
  } else if (const auto time = timeIn(message)) {
    closeBefore(*time, said);
    open_.time = time;
    touch();
  } else if (message.address == "/VMC/Ext/OK") {
    takeState(message);
  }
}

/// (loaded), (calibration state), (calibration mode), (tracking status).
void VmcStream::takeState(const OscMessage& message) {
  constexpr std::size_t kTracking = 3;
  const auto says = [&](std::size_t i, bool before) {
    const bool isSaid = message.numArguments > i && message.arguments[i].number;
    return isSaid ? *message.arguments[i].number != 0.0 : before;
  };
  isLoaded_ = says(0, isLoaded_);
  isTracked_ = says(kTracking, isTracked_);
}

void VmcStream::closeBefore(double time, std::vector<Said>& said) {
  if (open_.time && *open_.time != time && (hasBones_ || hasRoot_)) close(said);
}

void VmcStream::takeRoot(const OscMessage& message, std::vector<Said>& said) {
  RigidPose place;
  if (!readPlace(message, place)) return;
  if (hasRoot_) close(said);
  open_.root = place;
  hasRoot_ = true;
  touch();
}

void VmcStream::takeBone(const OscMessage& message, std::vector<Said>& said) {
  RigidPose place;
  if (!readPlace(message, place)) return;
  const auto bone = body_->boneOf(*message.arguments[0].text);
  if (!bone) return;
  if (open_.has[*bone]) close(said);
  open_.bones[*bone] = place;
  open_.has[*bone] = true;
  hasBones_ = true;
  touch();
}

/// The datagram is one of those that the open frame is made of.
void VmcStream::touch() {
  if (firstDatagram_ == 0) firstDatagram_ = datagram_;
  isOfOne_ = isOfOne_ && firstDatagram_ == datagram_;
  open_.receiveUtimeUs = now_;
  open_.isTracked = isTracked_;
}

bool VmcStream::isComplete() const {
  if (!hasBones_ || frames_ == 0 || (isExpected(rootSeenIn_) && !hasRoot_)) return false;
  for (std::size_t i = 0; i < seenIn_.size(); ++i) {
    if (isExpected(seenIn_[i]) && !open_.has[i]) return false;
  }
  return true;
}

void VmcStream::close(std::vector<Said>& said) {
  if (hasBones_) {
    ++frames_;
    for (std::size_t i = 0; i < seenIn_.size(); ++i) {
      if (open_.has[i]) seenIn_[i] = frames_;
    }
    if (hasRoot_) rootSeenIn_ = frames_;
    open_.isRootOld = rootSeenIn_ > 0 && !hasRoot_;
    open_.isWhole = isOfOne_ && open_.time.has_value();
    if (isLoaded_) say(open_, said);
  }
  open_.time.reset();
  open_.has.assign(open_.has.size(), false);
  hasBones_ = hasRoot_ = false;
  firstDatagram_ = 0;
  isOfOne_ = true;
}

void VmcStream::begin(const VmcFrame& frame, bool isTimed) {
  session_ = std::max(frame.receiveUtimeUs, session_ + 1);
  count_ = 0;
  isTimed_ = isTimed;
  if (isTimed_) baseUs_ = frame.receiveUtimeUs - std::llround(*frame.time * kUsPerS);
}

/// False: a frame that was overtaken by a later one.
bool VmcStream::place(const VmcFrame& frame, std::int64_t& utimeUs) {
  const bool isTimed = frame.isWhole && std::isfinite(*frame.time) && *frame.time >= 0.0 &&
                       *frame.time < kMostVmcTime;
  if (session_ == 0) begin(frame, isTimed);
  if (isTimed_ && isTimed && *frame.time < lastTime_ - kVmcClockJump) begin(frame, true);
  if (isTimed_ && isTimed) {
    utimeUs = baseUs_ + std::llround(*frame.time * kUsPerS);
    const double off = static_cast<double>(frame.receiveUtimeUs - utimeUs) / kUsPerS;
    if (std::abs(off) > kVmcClockJump) {
      begin(frame, true);
      utimeUs = frame.receiveUtimeUs;
    }
    if (count_ > 0 && *frame.time < lastTime_) return false;
    if (count_ > 0 && *frame.time == lastTime_) isTimed_ = false;
    lastTime_ = *frame.time;
  } else {
    isTimed_ = false;
  }
  if (!isTimed_) utimeUs = std::max(frame.receiveUtimeUs, lastUtimeUs_ + 1);
  return true;
}

void VmcStream::say(const VmcFrame& frame, std::vector<Said>& said) {
  std::int64_t utimeUs = 0;
  if (!place(frame, utimeUs)) return;
  lastUtimeUs_ = utimeUs;
  bool isNew = false;
  for (std::size_t i = 0; i < bones_.size(); ++i) {
    if (!frame.has[i] || bones_[i]) continue;
    bones_[i] = isNew = true;
  }
  if (isNew) {
    skeleton_ = body_->skeletonOf(bones_);
    hash_ = skeletonHash(skeleton_);
    ++generation_;
  }
  Said& next = said.emplace_back();
  next.receiveUtimeUs = frame.receiveUtimeUs;
  if (isNew || count_ == 0 || frame.receiveUtimeUs - skeletonSaidUs_ >= kVmcSkeletonEveryUs) {
    skeletonSaidUs_ = frame.receiveUtimeUs;
    next.skeleton = SkeletonMessage{
        body_->avatar(), session_, frame.receiveUtimeUs, generation_, hash_, "VMC", 0.0, skeleton_};
  }
  next.pose.avatar = body_->avatar();
  next.pose.session = session_;
  next.pose.sequence = (isTimed_ ? kFirstUncounted : kFirstUntimed) + count_++;
  next.pose.utimeUs = utimeUs;
  next.pose.sendUtimeUs = frame.receiveUtimeUs;
  next.pose.skeletonHash = hash_;
  body_->fill(bones_, frame, next.pose);
}

}  // namespace foretouch
