#include "bench/trade/truth.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "articulated/try.h"
#include "bench/judged.h"
#include "judge/first_touch.h"
#include "judge/hull_oracle.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// A body thinner by this touches only where the body itself overlaps.
constexpr double kThinner = 2.0 * kTruthTolerance;

oracle::HullWorld worldOf(const TradeWorld& world, const StepPoses& step, LinkId link) {
  oracle::HullWorld result;
  result.joints = plainJoints(world.avatar.skeleton(), step.from, step.to);
  const ChainMotion motion(world.avatar.skeleton(), step.from, step.to);
  const LinkState state = motion.stateAt(link, 0.0);
  Eigen::Vector3d low = state.p_WL, high = state.p_WL;
  double reach = 0.0;
  for (const Lss& lss : world.avatar.lss(link)) {
    result.hulls.push_back({link, 2, {plain(lss.a), plain(lss.b), {}}, lss.radius});
    const double rho = std::max(lss.a.norm(), lss.b.norm());
    reach = std::max(reach, motion.bounds(link).speedAt(rho) + lss.radius);
    low = low.cwiseMin(state.pointAt(lss.a)).cwiseMin(state.pointAt(lss.b));
    high = high.cwiseMax(state.pointAt(lss.a)).cwiseMax(state.pointAt(lss.b));
  }
  constexpr double kMargin = 1e-3;  // metres; generous against rounding
  const Eigen::Vector3d grown = Eigen::Vector3d::Constant(reach + kMargin);
  oracle::Box around;
  around.add(plain(low - grown));
  around.add(plain(high + grown));
  std::vector<int> near;
  const auto all = countOf(world.judged.numTriangles());
  world.judged.collect(around, all, near);
  for (const int id : near) result.triangles.push_back(world.judged.triangle(id));
  return result;
}

bool touchesAtAll(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

}  // namespace

Avatar withRadiiChanged(const Avatar& avatar, double by) {
  std::vector<std::vector<Lss>> lss;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    lss.push_back(avatar.lss(link));
    for (Lss& one : lss.back()) one.radius = std::max(0.0, one.radius + by);
  }
  return Avatar::build(avatar.skeleton(), std::move(lss)).value();  // as legal as before
}

TruthTeller::TruthTeller(const TradeWorld& world, const std::optional<AvatarSurface>& surface)
    : world_(world), thinner_(withRadiiChanged(world.avatar, -kThinner)) {
  options_.tolerance = kTruthTolerance;
  reference_.backtracking = Backtracking::Scalar;
  if (!surface) return;
  options_.fidelity = Fidelity::Exact;
  options_.surface = surface;
}

Result<StepContacts> TruthTeller::ask(const Avatar& avatar, const StepPoses& step) {
  const ChainMotion motion(avatar.skeleton(), step.from, step.to);
  return firstContacts(avatar, motion, world_.scene, options_, reference_);
}

Result<std::vector<LinkTruth>> TruthTeller::truthOf(const StepPoses& step) {
  const auto own = ask(world_.avatar, step);
  if (!own.ok()) return own.error();
  // A surface cannot be thinned: so anything within the finest tolerance counts as touching, and
  // nothing counts as late.
  FORETOUCH_TRY(const auto sure, options_.surface ? own : ask(thinner_, step));
  std::vector<LinkTruth> truths;
  for (std::size_t i = 0; i < own.value().links.size(); ++i) {
    const LinkContact& first = own.value().links[i];
    const LinkContact& last = sure.links[i];
    LinkTruth truth;
    truth.starts = first.verdict == Verdict::StartsInContact;
    truth.touches = touchesAtAll(last) || truth.starts;
    truth.freeUntil = first.freeUntil;
    truth.touchesBy = truth.starts       ? 0.0
                      : options_.surface ? 1.0
                                         : std::max(last.freeUntil, first.freeUntil);
    truths.push_back(truth);
  }
  return truths;
}

Result<std::vector<bool>> TruthTeller::comesWithin(const StepPoses& step, double distance) {
  if (!thicker_ || thickerBy_ != distance) {
    thicker_ = withRadiiChanged(world_.avatar, distance);
    thickerBy_ = distance;
  }
  QueryOptions options = options_;
  options.fidelity = Fidelity::Link;  // a surface lies within its LSS
  options.surface.reset();
  const ChainMotion motion(thicker_->skeleton(), step.from, step.to);
  FORETOUCH_TRY(const auto contacts,
                firstContacts(*thicker_, motion, world_.scene, options, reference_));
  std::vector<bool> within;
  for (const LinkContact& contact : contacts.links) {
    within.push_back(contact.verdict != Verdict::Clear);
  }
  return within;
}

double TruthTeller::separationAt(const StepPoses& step, LinkId link, double t) {
  const ChainMotion motion(world_.avatar.skeleton(), step.from, step.to);
  const LinkState state = motion.stateAt(link, t);
  double least = kFarM;
  for (const Lss& lss : world_.avatar.lss(link)) {
    const double distance = oracle::distanceTo(world_.judged, plain(state.pointAt(lss.a)),
                                               plain(state.pointAt(lss.b)), kFarM + lss.radius);
    least = std::min(least, distance - lss.radius);
  }
  return least;
}

void JudgedTruth::add(const JudgedTruth& other) {
  links += other.links;
  free += other.free;
  touching += other.touching;
  contacts += other.contacts;
  open += other.open;
  wrong += other.wrong;
}

JudgedTruth judge(const TradeWorld& world, const StepPoses& step, LinkId link,
                  const LinkTruth& truth) {
  JudgedTruth judged;
  judged.links = 1;
  const oracle::HullOracle judge(worldOf(world, step, link));
  std::vector<double> until(countOf(world.avatar.numLinks()), 0.0);
  until[slotOf(link)] = truth.freeUntil;
  const auto proof = judge.proveFree(until)[slotOf(link)];
  judged.free += proof.freedom == oracle::Freedom::Proven ? 1 : 0;
  judged.open += proof.freedom == oracle::Freedom::Open ? 1 : 0;
  judged.wrong += proof.freedom == oracle::Freedom::Touches ? 1 : 0;
  if (!truth.touches) return judged;
  judged.contacts = 1;
  const bool touches = judge.separationAt(link, truth.touchesBy) <= oracle::Precise(0);
  judged.touching += touches ? 1 : 0;
  judged.wrong += touches ? 0 : 1;
  return judged;
}

}  // namespace foretouch::tools
