#include "tools/inputs/lost_frames.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include "lss/index.h"

namespace foretouch::tools {

LostFrames::LostFrames(const Avatar& avatar, const Clip& clip, const JointMatch& match)
    : spans_(countOf(avatar.numLinks())), isAny_(!clip.gaps.empty()) {
  std::vector<Spans> ofJoint(countOf(clip.skeleton.numJoints()) + 1);  // the last: of all
  for (const ClipGap& gap : clip.gaps) {
    Spans& spans = gap.joint == kNoParent ? ofJoint.back() : ofJoint[slotOf(gap.joint)];
    spans.emplace_back(gap.first, gap.last);
  }
  for (LinkId link = 0; isAny_ && link < avatar.numLinks(); ++link) {
    Spans& own = spans_[slotOf(link)];
    const auto add = [&](const Spans& more) { own.insert(own.end(), more.begin(), more.end()); };
    add(ofJoint.back());
    const JointId joint = match.clipJointOf[slotOf(link)];
    if (joint != kNoParent) add(ofJoint[slotOf(joint)]);
    const LinkId carrier = avatar.skeleton().parent(link);
    if (carrier != kNoParent) add(spans_[slotOf(carrier)]);
    join(own);
  }
}

void LostFrames::join(Spans& spans) {
  std::sort(spans.begin(), spans.end());
  Spans joined;
  for (const auto& span : spans) {
    if (joined.empty() || span.first > joined.back().second + 1) {
      joined.push_back(span);
    } else {
      joined.back().second = std::max(joined.back().second, span.second);
    }
  }
  spans = std::move(joined);
}

bool LostFrames::isLost(LinkId link, std::int64_t frame) const {
  const Spans& spans = spans_[slotOf(link)];
  const auto after = std::upper_bound(spans.begin(), spans.end(),
                                      std::pair{frame, std::numeric_limits<std::int64_t>::max()});
  return after != spans.begin() && std::prev(after)->second >= frame;
}

std::vector<LinkId> LostFrames::linksAt(std::int64_t frame) const {
  std::vector<LinkId> links;
  for (std::size_t i = 0; isAny_ && i < spans_.size(); ++i) {
    if (isLost(static_cast<LinkId>(i), frame)) links.push_back(static_cast<LinkId>(i));
  }
  return links;
}

bool LostFrames::isAllLost(std::int64_t frame) const {
  return isAny_ && linksAt(frame).size() == spans_.size();
}

}  // namespace foretouch::tools
