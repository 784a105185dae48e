#include "tools/feet/stances.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <utility>

#include "articulated/motion.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "middleware/depth/depth.h"
#include "middleware/near/near_features.h"
#include "tools/feet/rest_runs.h"
#include "tools/feet/slide_path.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

/// Between poses, motion is looked at this often (Hz).
constexpr double kLooksHz = 240.0;
/// Spheres this near to a part's lowest one (m) rest, too: the slowest of them says whether it
/// slides.
constexpr double kAsLow = 0.001;

/// One contact of a part, as it is measured.
struct OpenStance {
  FootStance stance;
  SlidePath path;
  std::optional<Vector3d> from_W;  ///< Where what touches began to rest.
  std::vector<Lss> deepest_W;      ///< The part's LSS at the greatest depth.
};

/// What a part's lowest sphere does, above a surface.
struct CornerMotion {
  double normalSpeed = 0.0;             ///< m/s.
  Vector3d slide_W = Vector3d::Zero();  ///< m/s along the surface.
  Vector3d p_W = Vector3d::Zero();      ///< Its lowest point.
  double share = 0.0;  ///< Share of the way from there to its centre: where the slowest point is.
  std::size_t corner = 0;
};

/// Walks once through the clip.
class Walk {
 public:
  Walk(const FeetInputs& inputs, PartContacts contacts, NearQuery near)
      : inputs_(inputs),
        parts_(inputs.body.parts),
        contacts_(std::move(contacts)),
        near_(std::move(near)),
        cursor_(parts_.size(), 0),
        field_(countFeet(), inputs.stepS()) {
    for (const PartContact& contact : contacts_.contacts)
      open_.push_back({stanceOf(contact), SlidePath(kSlideRuler), {}, {}});
    for (std::size_t part = 0, i = 0; part < parts_.size(); ++part) {
      cursor_[part] = i;
      while (i < open_.size() && open_[i].stance.part == part) ++i;
    }
  }

  Result<Done> step(std::int64_t step);
  FeetAnswer finish();

 private:
  [[nodiscard]] std::size_t countFeet() const;
  [[nodiscard]] FootStance stanceOf(const PartContact& contact) const;
  [[nodiscard]] std::int64_t frameAt(double timeS) const;
  OpenStance* openAt(std::size_t part, double timeS);
  [[nodiscard]] std::optional<GroundSurface> surfaceBelow(const RestingPart& part,
                                                          const OpenStance* open) const;
  void samplePose(std::int64_t step);
  void sampleFoot(std::size_t part, double timeS, PartSample& sample);
  void sampleHand(std::size_t part, PartSample& sample);
  void sampleField();
  void sampleSpeeds();
  void lookBetween(std::int64_t step, double t, double lengthS);
  [[nodiscard]] CornerMotion motionOf(const RestingPart& part, const GroundSurface& surface) const;
  void keepLook(std::int64_t step, std::size_t part, const CornerMotion& motion,
                const Vector3d& normal_W, double lengthS);
  void deepen(OpenStance& open, const RestingPart& part, double depth, double timeS) const;
  [[nodiscard]] std::vector<Lss> placed(const RestingPart& part) const;

  const FeetInputs& inputs_;
  const std::vector<RestingPart>& parts_;
  PartContacts contacts_;
  NearQuery near_;
  std::vector<OpenStance> open_;     ///< One per contact, in its order.
  std::vector<std::size_t> cursor_;  ///< Per part: the first contact that may not be over.
  std::vector<std::optional<GroundSurface>> below_;  ///< Per part, at the last pose.
  Pose to_;                                          ///< At the end of the step.
  ChainMotion motion_;                               ///< The step's.
  MotionEvaluator evaluator_;
  std::vector<LinkState> states_;  ///< At the instant that is looked at.
  Scratch scratch_;
  NearFeatures features_;
  FieldMeter field_;
  FeetAnswer answer_;
};

std::size_t Walk::countFeet() const {
  const auto& limbs = inputs_.body.limbs;
  return static_cast<std::size_t>(std::count_if(
      limbs.begin(), limbs.end(), [](const RestingLimb& limb) { return !limb.isHand; }));
}

std::int64_t Walk::frameAt(double timeS) const {
  return std::llround(timeS / inputs_.played.clip.frameTimeS);
}

FootStance Walk::stanceOf(const PartContact& contact) const {
  FootStance stance;
  stance.part = contact.part;
  stance.object = contact.object;
  stance.fromS = contact.fromS;
  stance.toS = contact.toS;
  stance.fromFrame = frameAt(contact.fromS);
  stance.toFrame = frameAt(contact.toS);
  stance.beganBefore = contact.beganBefore;
  stance.goesOn = contact.goesOn;
  stance.underS = contact.underS;
  if (contact.underS > 0.0) stance.kind = StanceKind::Under;
  return stance;
}

/// The contact that holds at this instant; instants come in order.
OpenStance* Walk::openAt(std::size_t part, double timeS) {
  std::size_t& at = cursor_[part];
  while (at < open_.size() && open_[at].stance.part == part && open_[at].stance.toS < timeS) ++at;
  const bool holds =
      at < open_.size() && open_[at].stance.part == part && open_[at].stance.fromS <= timeS;
  return holds ? &open_[at] : nullptr;
}

/// What is below a foot; what a hand met.
std::optional<GroundSurface> Walk::surfaceBelow(const RestingPart& part,
                                                const OpenStance* open) const {
  if (part.isHand()) {
    if (open == nullptr) return std::nullopt;
    return contacts_.contacts[static_cast<std::size_t>(open - open_.data())].surface;
  }
  const PartCorner& lowest = part.corners[lowestOf(part, states_, Vector3d::UnitY()).corner];
  Vector3d p_W = states_[slotOf(lowest.link)].pointAt(lowest.center_L);
  p_W.y() -= lowest.radius;
  return inputs_.groundOf(inputs_.body.limbs[part.limb], states_, p_W);
}

std::vector<Lss> Walk::placed(const RestingPart& part) const {
  std::vector<Lss> placed;
  for (const LinkId link : part.links) {
    for (const Lss& lss : inputs_.body.avatar.lss(link)) {
      const LinkState& state = states_[slotOf(link)];
      placed.push_back({state.pointAt(lss.a), state.pointAt(lss.b), lss.radius});
    }
  }
  return placed;
}

void Walk::deepen(OpenStance& open, const RestingPart& part, double depth, double timeS) const {
  if (depth <= open.stance.depth) return;
  open.stance.depth = depth;
  open.stance.depthAtS = timeS;
  open.deepest_W = placed(part);
}

void Walk::sampleFoot(std::size_t part, double timeS, PartSample& sample) {
  const RestingPart& of = parts_[part];
  const std::optional<GroundSurface>& ground = below_[part];
  if (!ground) return;
  const double level = ground->normal_W.dot(ground->p_W);
  const double height = lowestOf(of, states_, ground->normal_W).height - level;
  double top = height;
  for (const PartCorner& corner : of.corners) {
    const Vector3d p_W = states_[slotOf(corner.link)].pointAt(corner.center_L);
    top = std::max(top, ground->heightOf(p_W) + corner.radius);
  }
  sample.height = static_cast<float>(height);
  sample.depth = static_cast<float>(std::max(0.0, -height));
  sample.isUnder = top < 0.0;
  OpenStance* const open = openAt(part, timeS);
  sample.touches = open != nullptr;
  if (open != nullptr) deepen(*open, of, -height, timeS);
}

void Walk::sampleHand(std::size_t part, PartSample& sample) {
  double gap = std::numeric_limits<double>::infinity();
  for (const LinkId link : parts_[part].links) {
    const NearRange& range = features_.links[slotOf(link)];
    for (std::size_t i = range.first; i < range.first + range.count; ++i) {
      gap = std::min(gap, features_.features[i].gap);
    }
  }
  if (std::isfinite(gap)) sample.height = static_cast<float>(gap);
  sample.depth = static_cast<float>(std::max(0.0, std::isfinite(gap) ? -gap : 0.0));
}

void Walk::sampleField() {
  const PartSample* const samples = &answer_.samples[answer_.samples.size() - parts_.size()];
  double lowest = std::numeric_limits<double>::infinity();
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const double height = samples[part].height;
    if (!parts_[part].isHand() && height < lowest) lowest = height;
  }
  if (std::isfinite(lowest)) field_.addPose(lowest);
  std::size_t foot = 0;
  for (const RestingLimb& limb : inputs_.body.limbs) {
    if (limb.isHand) continue;
    Vector3d joint = states_[slotOf(limb.toe.value_or(limb.ankle))].p_WL;
    const auto below = inputs_.groundOf(limb, states_, joint);
    joint.y() = below ? below->heightOf(joint) : std::numeric_limits<double>::infinity();
    field_.addFoot(foot++, joint);
  }
}

void Walk::samplePose(std::int64_t step) {
  const double timeS = inputs_.timeOf(step);
  std::vector<double> reach(states_.size(), -1.0);
  bool hasHands = false;
  below_.clear();
  for (const RestingPart& part : parts_) {
    below_.push_back(part.isHand() ? std::nullopt : surfaceBelow(part, nullptr));
    hasHands = hasHands || part.isHand();
    if (!part.isHand()) continue;
    for (const LinkId link : part.links) reach[slotOf(link)] = kFarthestSurface;
  }
  if (hasHands) near_.answer(states_, reach, scratch_, features_, NearDetail::Nearest);
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    PartSample sample;
    if (parts_[part].isHand()) {
      sampleHand(part, sample);
      OpenStance* const open = openAt(part, timeS);
      sample.touches = open != nullptr;
      if (open != nullptr) deepen(*open, parts_[part], sample.depth, timeS);
    } else {
      sampleFoot(part, timeS, sample);
    }
    answer_.samples.push_back(sample);
  }
  sampleField();
}

/// Where between these two velocities the least one is, 0 to 1.
double leastBetween(const Vector3d& a, const Vector3d& b) {
  const Vector3d way = b - a;
  const double square = way.squaredNorm();
  return square > 0.0 ? std::clamp(-a.dot(way) / square, 0.0, 1.0) : 0.0;
}

/// Takes the sphere that moves least along the surface, of those that are about as low, and on it
/// the slowest of the points between its touch and its centre: what rolls does not slide, nor what
/// turns in place, and soles give.
CornerMotion Walk::motionOf(const RestingPart& part, const GroundSurface& surface) const {
  const Vector3d& up = surface.normal_W;
  const LowestCorner lowest = lowestOf(part, states_, up);
  const double perS = 1.0 / inputs_.stepS();
  std::optional<CornerMotion> slowest;
  for (std::size_t i = 0; i < part.corners.size(); ++i) {
    const PartCorner& corner = part.corners[i];
    const LinkState& state = states_[slotOf(corner.link)];
    const Vector3d center = state.pointAt(corner.center_L);
    if (up.dot(center) - corner.radius > lowest.height + kAsLow) continue;
    const Vector3d p_W = center - corner.radius * up;
    const Vector3d atCenter = perS * state.velocityOf(center),
                   atPoint = perS * state.velocityOf(p_W);
    const Vector3d along = atCenter - up.dot(atCenter) * up;
    const Vector3d point = atPoint - up.dot(atPoint) * up;
    const double share = leastBetween(point, along);
    const CornerMotion motion{up.dot(atCenter), point + share * (along - point), p_W, share, i};
    if (!slowest || motion.slide_W.norm() < slowest->slide_W.norm()) slowest = motion;
  }
  return *slowest;
}

/// Keeps the look for the stance that is open there.
void Walk::keepLook(std::int64_t step, std::size_t part, const CornerMotion& motion,
                    const Vector3d& normal_W, double lengthS) {
  const PartCorner& corner = parts_[part].corners[motion.corner];
  const LinkState& state = states_[slotOf(corner.link)];
  const Vector3d p_W = motion.p_W + motion.share * corner.radius * normal_W;
  open_[cursor_[part]].stance.looks.push_back({step, corner.link, motion.corner,
                                               state.R_WL.transpose() * (p_W - state.p_WL),
                                               normal_W, lengthS * motion.slide_W});
}

void Walk::lookBetween(std::int64_t step, double t, double lengthS) {
  const double timeS = inputs_.timeOf(step) + t * inputs_.stepS();
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    OpenStance* const open = openAt(part, timeS);
    if (open == nullptr) continue;
    const auto surface = surfaceBelow(parts_[part], open);
    if (!surface) continue;
    const CornerMotion motion = motionOf(parts_[part], *surface);
    if (!parts_[part].isHand()) {
      deepen(*open, parts_[part], -surface->heightOf(motion.p_W), timeS);
    }
    if (std::abs(motion.normalSpeed) > kRestNormalSpeed) continue;
    if (inputs_.keepsLooks) keepLook(step, part, motion, surface->normal_W, lengthS);
    // From one point on: another one that touches later adds its way, not how far away it is.
    if (!open->from_W) open->from_W = motion.p_W;
    if (open->path.add(lengthS * motion.slide_W)) {
      std::vector<Vector3d>& trace_W = open->stance.trace_W;
      if (trace_W.empty()) trace_W.push_back(*open->from_W);
      trace_W.emplace_back(*open->from_W + open->path.needle());
    }
    PartSample& sample = answer_.samples[answer_.samples.size() - parts_.size() + part];
    sample.slide += static_cast<float>(motion.slide_W.norm() * lengthS / inputs_.stepS());
  }
}

/// Fills in the speeds of the last pose's samples, in the middle of the step from it.
void Walk::sampleSpeeds() {
  const double perS = 1.0 / inputs_.stepS();
  for (std::size_t part = 0; part < parts_.size(); ++part) {
    const RestingPart& of = parts_[part];
    PartSample& sample = answer_.samples[answer_.samples.size() - parts_.size() + part];
    const PartCorner& corner = of.corners[lowestOf(of, states_, Vector3d::UnitY()).corner];
    const LinkState& state = states_[slotOf(corner.link)];
    sample.speed = static_cast<float>(perS * state.velocityAt(corner.center_L).norm());
    if (!below_[part]) continue;
    const LinkState& joint = states_[slotOf(of.joint)];
    sample.byRule =
        below_[part]->heightOf(joint.p_WL) < kRuleHeight && perS * joint.v_WL.norm() < kRuleSpeed;
  }
}

Result<Done> Walk::step(std::int64_t step) {
  if (step == 0) {
    FORETOUCH_TRY(to_, inputs_.poseAt(0));
  }
  const Pose from = to_;
  if (step < inputs_.steps()) {
    FORETOUCH_TRY(to_, inputs_.poseAt(step + 1));
  }
  motion_.assign(inputs_.body.avatar.skeleton(), from, to_);
  evaluator_.reset(motion_);
  evaluator_.statesAt(0.0, states_);
  samplePose(step);
  evaluator_.statesAt(0.5, states_);
  sampleSpeeds();
  if (step == inputs_.steps()) return Done{};
  const auto looks = static_cast<int>(std::max(1.0, std::ceil(inputs_.stepS() * kLooksHz)));
  for (int i = 0; i < looks; ++i) {
    const double t = (i + 0.5) / looks;
    evaluator_.statesAt(t, states_);
    lookBetween(step, t, inputs_.stepS() / looks);
  }
  return Done{};
}

FeetAnswer Walk::finish() {
  for (OpenStance& open : open_) {
    open.stance.slide = open.path.length();
    open.stance.moved = open.path.farthest();
    if (!open.deepest_W.empty()) {
      const Depth least = depthIn(open.deepest_W, inputs_.level.scene(), scratch_);
      open.stance.leastWay = least.lower;
    }
    answer_.stances.push_back(std::move(open.stance));
  }
  for (FootStance& stance : restRunsOf(inputs_, answer_))
    answer_.stances.push_back(std::move(stance));
  std::sort(answer_.stances.begin(), answer_.stances.end(),
            [](const FootStance& x, const FootStance& y) {
              return std::tie(x.part, x.fromS, x.kind) < std::tie(y.part, y.fromS, y.kind);
            });
  answer_.field = field_.finish();
  answer_.unresolvedS = contacts_.unresolvedS;
  return std::move(answer_);
}

}  // namespace

const char* toString(StanceKind kind) {
  switch (kind) {
    case StanceKind::Touches: return "touches";
    case StanceKind::Hovers: return "hovers";
    case StanceKind::Under: return "under";
  }
  return "";
}

Result<FeetAnswer> stancesOf(const FeetInputs& inputs,
                             const std::function<bool(std::int64_t)>& progress) {
  FORETOUCH_TRY(auto contacts, partContactsOf(inputs));
  FORETOUCH_TRY(auto near, NearQuery::build(inputs.body.avatar, inputs.level.scene()));
  Walk walk(inputs, std::move(contacts), std::move(near));
  for (std::int64_t step = 0; step <= inputs.steps(); ++step) {
    FORETOUCH_CHECK(walk.step(step));
    if (!progress(step)) break;
  }
  return walk.finish();
}

}  // namespace foretouch::tools
