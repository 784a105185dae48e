#include "bench/trade/strategies.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/trade/link_sweep.h"
#include "lss/index.h"

namespace foretouch::tools {
namespace {

/// Builds the motion, then solves every LSS of every link separately.
class LssByLss : public Strategy {
 public:
  LssByLss(std::string name, TradePromise promise, const TradeWorld& world, double tolerance)
      : Strategy(std::move(name), promise), world_(world), tolerance_(tolerance) {}

  void solve(const TradeStep& step, std::vector<LinkTouch>& touches, TradeWork& work) override {
    motion_.assign(world_.avatar.skeleton(), step.from, step.to);
    evaluator_.reset(motion_);
    touches.assign(countOf(world_.avatar.numLinks()), {});
    begin(step);
    std::size_t index = 0;
    for (LinkId link = 0; link < world_.avatar.numLinks(); ++link) {
      LinkTouch& touch = touches[slotOf(link)];
      for (const Lss& lss : world_.avatar.lss(link)) {
        LinkSweep sweep(link, lss, evaluator_, world_.tree, work);
        const double toi = firstContact(index++, sweep, touch.toi);
        if (toi > touch.toi || toi == kNever) continue;
        touch = {true, toi};
      }
    }
  }

 protected:
  static constexpr double kNever = std::numeric_limits<double>::infinity();
  virtual void begin(const TradeStep& /*step*/) {}
  /// When the avatar's LSS number `index` first touches; kNever if not on [0, until].
  virtual double firstContact(std::size_t index, LinkSweep& sweep, double until) = 0;
  [[nodiscard]] const TradeWorld& world() const { return world_; }
  [[nodiscard]] double tolerance() const { return tolerance_; }

 private:
  const TradeWorld& world_;
  double tolerance_;
  ChainMotion motion_;
  MotionEvaluator evaluator_;
};

class Sampling : public Strategy {
 public:
  Sampling(const TradeWorld& world, int instants, double tolerance)
      : Strategy(instants == 1 ? "poses only" : fmt::format("sampling {}", instants),
                 TradePromise::Nothing),
        world_(world),
        instants_(instants),
        tolerance_(tolerance) {}

  void solve(const TradeStep& step, std::vector<LinkTouch>& touches, TradeWork& work) override {
    motion_.assign(world_.avatar.skeleton(), step.from, step.to);
    evaluator_.reset(motion_);
    touches.assign(countOf(world_.avatar.numLinks()), {});
    for (int i = 0; i <= instants_; ++i) {
      const double t = static_cast<double>(i) / instants_;
      evaluator_.statesAt(t, states_);
      work.states += states_.size();
      for (LinkId link = 0; link < world_.avatar.numLinks(); ++link) {
        LinkTouch& touch = touches[slotOf(link)];
        if (!touch.touches && isNear(link, work)) touch = {true, t};
      }
    }
  }

 private:
  [[nodiscard]] bool isNear(LinkId link, TradeWork& work) const {
    const LinkState& state = states_[slotOf(link)];
    const std::vector<Lss>& all = world_.avatar.lss(link);
    return std::any_of(all.begin(), all.end(), [&](const Lss& lss) {
      const double reach = lss.radius + tolerance_;
      const double cap = std::nextafter(reach, 2.0 * kMaxCoordinate);  // `reach` itself counts
      return world_.tree.distance(state.pointAt(lss.a), state.pointAt(lss.b), cap, reach, work) <=
             reach;
    });
  }

  const TradeWorld& world_;
  int instants_;
  double tolerance_;
  ChainMotion motion_;
  MotionEvaluator evaluator_;
  std::vector<LinkState> states_;
};

class Subdivision : public LssByLss {
 public:
  Subdivision(const TradeWorld& world, double tolerance)
      : LssByLss("adaptive subdivision", TradePromise::Accurate, world, tolerance) {}

 private:
  double firstContact(std::size_t /*index*/, LinkSweep& sweep, double until) override {
    const double atBegin = clearance(sweep, 0.0);
    if (atBegin <= tolerance()) return 0.0;
    return inSpan(sweep, 0.0, atBegin, until, clearance(sweep, until));
  }

  /// A clearance beyond the whole path needs no exact value.
  [[nodiscard]] double clearance(LinkSweep& sweep, double t) const {
    return std::max(0.0, sweep.separation(t, sweep.speed() + tolerance(), 0.0));
  }

  /// Free at `begin`, by more than the tolerance. Ends, as both clearances of a span that is
  /// shorter than the tolerance over the speed prove it free or hold the contact.
  double inSpan(LinkSweep& sweep, double begin, double atBegin, double end, double atEnd) {
    if (sweep.speed() * (end - begin) < atBegin + atEnd) {
      return atEnd <= tolerance() ? end : kNever;
    }
    const double middle = 0.5 * (begin + end);
    if (middle <= begin || middle >= end) return begin;  // doubles end here: early is safe
    const double atMiddle = clearance(sweep, middle);
    const double first = inSpan(sweep, begin, atBegin, middle, atMiddle);
    return first != kNever ? first : inSpan(sweep, middle, atMiddle, end, atEnd);
  }
};

/// Advances from `t` on in steps of clearance over speed.
double advance(LinkSweep& sweep, double t, double until, double tolerance) {
  while (t <= until) {
    const double cap = sweep.speed() * (until - t) + tolerance;
    const double separation = sweep.separation(t, std::nextafter(cap, 2.0 * cap + 1.0), 0.0);
    if (separation <= tolerance) return t;
    if (separation > sweep.speed() * (until - t)) break;
    const double next = t + separation / sweep.speed();
    if (next <= t) return t;  // doubles end here: early is safe
    t = next;
  }
  return std::numeric_limits<double>::infinity();
}

class Advancement : public LssByLss {
 public:
  Advancement(const TradeWorld& world, double tolerance)
      : LssByLss("plain advancement", TradePromise::Accurate, world, tolerance) {}

 private:
  double firstContact(std::size_t /*index*/, LinkSweep& sweep, double until) override {
    return advance(sweep, 0.0, until, tolerance());
  }
};

class Certificates : public LssByLss {
 public:
  Certificates(const TradeWorld& world, double tolerance)
      : LssByLss("carried certificates", TradePromise::Accurate, world, tolerance),
        margins_(countOf(world.avatar.numLss()), 0.0) {}

 private:
  /// How far to search: farther costs more, but lasts longer.
  static constexpr double kLookM = 0.5;

  void begin(const TradeStep& step) override {
    if (!step.continues) std::fill(margins_.begin(), margins_.end(), 0.0);
  }

  double firstContact(std::size_t index, LinkSweep& sweep, double until) override {
    double& margin = margins_[index];
    if (margin <= sweep.speed()) {
      margin = sweep.separation(0.0, std::max(kLookM, 2.0 * sweep.speed()), 0.0);
    }
    if (margin > sweep.speed()) {
      margin -= sweep.speed();
      return kNever;
    }
    margin = 0.0;  // the clearance at the step's end is unknown
    return advance(sweep, 0.0, until, tolerance());
  }

  std::vector<double> margins_;  // one per LSS: clearance known at the step's beginning (m)
};

class VoxelSweep : public Strategy {
 public:
  explicit VoxelSweep(const TradeWorld& world)
      : Strategy("voxel sweep", TradePromise::Sound), world_(world) {}

  void solve(const TradeStep& step, std::vector<LinkTouch>& touches, TradeWork& work) override {
    motion_.assign(world_.avatar.skeleton(), step.from, step.to);
    evaluator_.reset(motion_);
    touches.assign(countOf(world_.avatar.numLinks()), {});
    for (LinkId link = 0; link < world_.avatar.numLinks(); ++link) {
      LinkTouch& touch = touches[slotOf(link)];
      for (const Lss& lss : world_.avatar.lss(link)) sweep(link, lss, touch, work);
    }
  }

 private:
  /// Pieces of [0,1] in which the axis stays within a quarter of a cell of where it is at the
  /// middle; a contact is reported at its piece's begin.
  void sweep(LinkId link, const Lss& lss, LinkTouch& touch, TradeWork& work) {
    const double rho = std::max(lss.a.norm(), lss.b.norm());
    const double way = motion_.bounds(link).speedAt(rho);
    const double pieces = std::max(1.0, std::ceil(2.0 * way / world_.voxels.cell()));
    const double reach = lss.radius + world_.voxels.halfDiagonal() + 0.5 * way / pieces;
    for (double piece = 0.0; piece < pieces; piece += 1.0) {
      const double begin = piece / pieces;
      if (touch.touches && touch.toi <= begin) return;
      ++work.states;
      const LinkState state = evaluator_.stateAt(link, (piece + 0.5) / pieces);
      if (world_.voxels.hasWithin(state.pointAt(lss.a), state.pointAt(lss.b), reach, work)) {
        touch = {true, begin};
        return;
      }
    }
  }

  const TradeWorld& world_;
  ChainMotion motion_;
  MotionEvaluator evaluator_;
};

class ForetouchQuery : public Strategy {
 public:
  ForetouchQuery(Query query, const std::string& name, TradePromise promise)
      : Strategy(name, promise), query_(std::move(query)) {}

  void solve(const TradeStep& step, std::vector<LinkTouch>& touches, TradeWork& work) override {
    motion_.assign(query_.avatar().skeleton(), step.from, step.to);
    query_.answer(motion_, scratch_, contacts_);
    touches.resize(contacts_.links.size());
    for (std::size_t i = 0; i < touches.size(); ++i) {
      const LinkContact& contact = contacts_.links[i];
      touches[i] = {contact.verdict != Verdict::Clear, contact.freeUntil};
    }
    const QueryCounters& c = contacts_.counters;
    work.nodes += c.nodes + c.leaves + c.hierarchyTests + c.planeTests;
    work.pairs += c.clusterSteps + c.laneSteps + c.partSteps + c.advancements + c.leafTests;
    work.states += c.states;
  }

 private:
  Query query_;
  ChainMotion motion_;
  Scratch scratch_;
  StepContacts contacts_;
};

}  // namespace

std::unique_ptr<Strategy> sampling(const TradeWorld& world, int instants, double tolerance) {
  return std::make_unique<Sampling>(world, instants, tolerance);
}
std::unique_ptr<Strategy> subdivision(const TradeWorld& world, double tolerance) {
  return std::make_unique<Subdivision>(world, tolerance);
}
std::unique_ptr<Strategy> advancement(const TradeWorld& world, double tolerance) {
  return std::make_unique<Advancement>(world, tolerance);
}
std::unique_ptr<Strategy> certificates(const TradeWorld& world, double tolerance) {
  return std::make_unique<Certificates>(world, tolerance);
}
std::unique_ptr<Strategy> voxelSweep(const TradeWorld& world) {
  return std::make_unique<VoxelSweep>(world);
}
std::unique_ptr<Strategy> foretouchQuery(const TradeWorld& world, const QueryOptions& options,
                                         const std::string& name,
                                         const ReferenceOptions& reference) {
  const bool isAccurate = options.fidelity == Fidelity::Link && !reference.rung;
  return std::make_unique<ForetouchQuery>(
      buildReference(world.avatar, world.scene, options, reference).value(), name,
      isAccurate ? TradePromise::Accurate : TradePromise::Sound);
}

}  // namespace foretouch::tools
