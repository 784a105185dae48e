#include "bench/person/ahead_ways.h"

#include <algorithm>
#include <string>

#include "assets/bounds/bounds_file.h"
#include "bench/machine.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// For capsules: instants per horizon. What is found is reported at the instant before it.
constexpr int kGrid = 120;
constexpr double kBeyondM = 1e-3;

/// An arm with its hand, or a leg with its foot; else none.
char limbOf(const std::string& part) {
  if (part == "arm" || part == "hand") return 'a';
  return part == "leg" || part == "foot" ? 'l' : ' ';
}

}  // namespace

const char* toString(AheadWay way) {
  switch (way) {
    case AheadWay::Chain: return "Foretouch";
    case AheadWay::Capsule: return "capsules, acceleration";
    case AheadWay::WiderCapsule: return "capsules, speed";
    case AheadWay::LimbBall: return "balls around limbs";
  }
  return "Foretouch";
}

AheadPerson::AheadPerson(HeldBack& held, const Avatar& avatar, const std::vector<Pose>& frames,
                         const BracketQuery& query, const Horizon& horizon)
    : held_(held),
      avatar_(avatar),
      frames_(frames),
      query_(query),
      horizon_(horizon),
      stepS_(static_cast<double>(horizon.every) * horizon.frameS) {
  for (const HeldBackStep& step : held.steps(horizon.every)) {
    if (step.to + static_cast<std::size_t>(horizon.frames) < frames.size()) steps_.push_back(step);
  }
}

bool AheadPerson::hasSurface(std::size_t link) const {
  return !avatar_.lss(static_cast<LinkId>(link)).empty();
}

/// Where the person is `frame` frames after a step, which may be between two.
const AheadPerson::Axes& AheadPerson::truthAt(const HeldBackStep& step, double frame) {
  const HeldBackStep after{step.to, step.to + static_cast<std::size_t>(horizon_.frames), 0, 0};
  return held_.truthAt(after, frame / horizon_.frames);
}

AheadPerson::Axes AheadPerson::placedBy(AheadWay way, const HeldBackStep& step, double tau) {
  if (way == AheadWay::Chain) return held_.aheadAt(step, tau / stepS_);
  Axes now = held_.posedAt(step.to);
  if (way == AheadWay::WiderCapsule) return now;
  const Axes& before = held_.posedAt(step.from);
  for (std::size_t c = 0; c < now.size(); ++c) {
    for (std::size_t end = 0; end < 2; ++end) {
      now[c][end] = now[c][end] + (tau / stepS_) * (now[c][end] - before[c][end]);
    }
  }
  return now;
}

void AheadPerson::learn(Learn what, AheadBounds& bounds) {
  for (auto& growths : bounds.growths) growths.resize(held_.numLinks());
  if (bounds.limbs.empty()) findLimbs(bounds);
  for (const HeldBackStep& step : steps_) learnStep(what, step, bounds);
  if (what == Learn::Rest) learnLimbs(bounds);
}

/// The speeds from the first instant, and then what more is needed.
void AheadPerson::learnStep(Learn what, const HeldBackStep& step, AheadBounds& bounds) {
  const int last = what == Learn::Speed ? 1 : horizon_.frames;
  for (int frame = 1; frame <= last; ++frame) {
    const double tau = frame * horizon_.frameS;
    const Axes truth = truthAt(step, frame);
    for (std::size_t way = 0; way < bounds.growths.size(); ++way) {
      const Axes model = placedBy(static_cast<AheadWay>(way), step, tau);
      for (std::size_t c = 0; c < truth.size(); ++c) {
        AheadBounds::Growth& bound = bounds.growths[way][slotOf(held_.linkOf()[c])];
        for (std::size_t end = 0; end < 2; ++end) {
          const double error = kBetween * oracle::norm(truth[c][end] - model[c][end]) + kBetweenM;
          if (what == Learn::Speed) {
            bound.speed = std::max(bound.speed, error / tau);
          } else {
            bound.acceleration =
                std::max(bound.acceleration, 2.0 * (error - bound.speed * tau) / (tau * tau));
          }
        }
      }
    }
  }
}

/// Finds the limbs, from the highest link of each on.
void AheadPerson::findLimbs(AheadBounds& bounds) const {
  const std::vector<std::string> parts = boundParts(avatar_.skeleton());
  const std::vector<int>& linkOf = held_.linkOf();
  auto& limbs = bounds.limbs;
  limbs.assign(parts.size(), std::nullopt);
  for (std::size_t link = 0; link < parts.size(); ++link) {
    if (limbOf(parts[link]) == ' ') continue;
    const JointId parent = avatar_.skeleton().parent(static_cast<JointId>(link));
    const bool goesOn = parent != kNoParent && limbs[slotOf(parent)] &&
                        limbOf(parts[slotOf(parent)]) == limbOf(parts[link]);
    const auto own = std::find(linkOf.begin(), linkOf.end(), static_cast<int>(link));
    if (goesOn) {
      limbs[link] = limbs[slotOf(parent)];
    } else if (own != linkOf.end()) {
      limbs[link] = AheadBounds::Limb{static_cast<std::size_t>(own - linkOf.begin()), 0.0, 0.0};
    }
  }
}

void AheadPerson::learnLimbs(AheadBounds& bounds) {
  Axes last;
  for (std::size_t frame = 0; frame < frames_.size(); ++frame) {
    const Axes now = held_.posedAt(frame);
    for (std::size_t c = 0; c < now.size(); ++c) {
      const auto& own = bounds.limbs[slotOf(held_.linkOf()[c])];
      if (!own) continue;
      const std::size_t baseAxis = own->base;
      const oracle::Vec3d base = now[baseAxis][0];
      double reach = 0.0;
      for (const oracle::Vec3d& end : now[c]) reach = std::max(reach, oracle::norm(end - base));
      reach = kBetween * reach + held_.radiusOf(c);
      const double way = last.empty() ? 0.0 : oracle::norm(base - last[baseAxis][0]);
      for (auto& limb : bounds.limbs) {
        if (!limb || limb->base != baseAxis) continue;
        limb->reach = std::max(limb->reach, reach);
        limb->speed = std::max(limb->speed, kBetween * way / horizon_.frameS + kBetweenM);
      }
    }
    last = now;
  }
}

AheadPerson::Instants AheadPerson::told(AheadWay way, const HeldBackStep& step,
                                        const AheadBounds& bounds, double& us) {
  switch (way) {
    case AheadWay::Chain: return byChain(step, bounds, us);
    case AheadWay::Capsule:
    case AheadWay::WiderCapsule: return byCapsules(way, step, bounds);
    case AheadWay::LimbBall: return byLimbs(step, bounds);
  }
  return {};
}

AheadPerson::Instants AheadPerson::byChain(const HeldBackStep& step, const AheadBounds& bounds,
                                           double& us) {
  std::vector<LinkBound> claims(held_.numLinks());
  for (std::size_t link = 0; link < claims.size(); ++link) {
    claims[link].aheadSpeed = bounds.growths[0][link].speed;
    claims[link].aheadAcceleration = bounds.growths[0][link].acceleration;
  }
  PosedStep posed;
  posed.from = &frames_[step.from];
  posed.to = &frames_[step.to];
  posed.seconds = stepS_;
  const ThreadStopwatch watch;
  (void)query_.lookAhead(posed, horizon_.seconds(), claims, scratch_, brackets_);
  us += watch.us();
  Instants told(claims.size());
  for (const LinkBracket& bracket : brackets_.links) {
    if (bracket.verdict == BracketVerdict::Unclaimed) told[slotOf(bracket.link)] = 0.0;
    if (bracket.verdict != BracketVerdict::Possible) continue;
    told[slotOf(bracket.link)] = bracket.possibleFrom * horizon_.seconds();
  }
  return told;
}

AheadPerson::Instants AheadPerson::byCapsules(AheadWay way, const HeldBackStep& step,
                                              const AheadBounds& bounds) {
  const auto& growths = bounds.growths[static_cast<std::size_t>(way)];
  Instants told(growths.size());
  for (int i = 1; i <= kGrid; ++i) {
    const double tau = horizon_.seconds() * i / kGrid;
    const Axes axes = placedBy(way, step, tau);
    for (std::size_t link = 0; link < growths.size(); ++link) {
      if (told[link] || !hasSurface(link)) continue;
      const double growth = growths[link].at(tau);
      if (held_.fromScene(axes, static_cast<int>(link), growth + kBeyondM) <= growth) {
        told[link] = horizon_.seconds() * (i - 1) / kGrid;
      }
    }
  }
  return told;
}

AheadPerson::Instants AheadPerson::byLimbs(const HeldBackStep& step, const AheadBounds& bounds) {
  Instants told = byCapsules(AheadWay::WiderCapsule, step, bounds);
  const Axes now = held_.posedAt(step.to);
  for (std::size_t link = 0; link < bounds.limbs.size(); ++link) {
    const auto& limb = bounds.limbs[link];
    if (!limb || !hasSurface(link)) continue;
    const double most = limb->reach + limb->speed * horizon_.seconds();
    const double apart = held_.fromScene(now[limb->base][0], most + kBeyondM);
    told[link] = std::nullopt;
    if (apart <= most) told[link] = std::max(0.0, apart - limb->reach) / limb->speed;
  }
  return told;
}

AheadPerson::Instants AheadPerson::truth(const HeldBackStep& step) {
  constexpr int kPerFrame = 3;
  Instants touched(held_.numLinks());
  for (int i = 0; i <= kPerFrame * horizon_.frames; ++i) {
    const double frame = static_cast<double>(i) / kPerFrame;
    const Axes axes = truthAt(step, frame);
    for (std::size_t link = 0; link < touched.size(); ++link) {
      if (touched[link] || !hasSurface(link)) continue;
      const double apart = held_.fromScene(axes, static_cast<int>(link), kBeyondM);
      if (apart < -kJudgeRounding) touched[link] = frame * horizon_.frameS;
    }
  }
  return touched;
}

}  // namespace foretouch::tools
