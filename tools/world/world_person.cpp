#include "tools/world/world_person.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bounds/bound_presets.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "middleware/bracket/bracket.h"
#include "tools/json_line.h"
#include "tools/person/bound_check.h"

namespace foretouch::tools {
namespace {

/// A bound is about poses at its rate, within this share of their distance in time.
constexpr double kRateShare = 0.1;
/// Touches in words.
constexpr int kMostTold = 10;

struct Knot {
  std::int64_t utimeUs = 0;
  const Pose* pose = nullptr;
};

/// A body about which something is claimed.
struct Claimed {
  BodyId id = 0;
  bool isPerson = false;
  MotionModel model = MotionModel::ConstantRate;
  std::vector<LinkBound> bounds;
  double stepS = 0.0;  ///< The step that the bounds are about; 0: any.
  std::vector<Knot> knots;
  const std::map<std::int64_t, std::vector<LinkId>>* lost = nullptr;  ///< By knots.
};

double secondsBetween(const Knot& from, const Knot& to) {
  return static_cast<double>(to.utimeUs - from.utimeUs) / kUsPerS;
}

std::vector<Knot> knotsOf(const Track& track) {
  std::vector<Knot> knots;
  for (std::int64_t us = track.knownFromUs();; us = track.nextKnotUs(us)) {
    knots.push_back({us, track.pieceAt(us).from});
    if (us == track.knownUntilUs()) return knots;
  }
}

/// The knots of a body that nothing moves.
std::vector<Knot> standingFrom(const Track& track, std::int64_t fromUs, std::int64_t toUs) {
  const Pose* const pose = track.pieceAt(track.knownUntilUs()).from;
  return {{fromUs, pose}, {toUs, pose}};
}

double usualStepS(const std::vector<Knot>& knots) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < knots.size(); ++i) {
    steps.push_back(secondsBetween(knots[i - 1], knots[i]));
  }
  const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
  std::nth_element(steps.begin(), middle, steps.end());
  return *middle;
}

/// Whether bodies of two groups are asked, by the file; no second group: the scene.
bool isAsked(const LoadedWorld& world, BodyGroup group, std::optional<BodyGroup> other) {
  const std::string &name = world.groups[slotOf(group)],
                    with = other ? world.groups[slotOf(*other)] : "";
  bool asked = true;
  for (const FileAsk& ask : world.file.asks) {
    const bool isSceneAsk = ask.with.empty();
    if (isSceneAsk != !other) continue;
    const bool isThis = ask.group == name && ask.with == with;
    if (isThis || (other && ask.group == with && ask.with == name)) asked = ask.isAsked;
  }
  return asked;
}

/// The steps from knot to knot.
class Steps {
 public:
  explicit Steps(const Claimed& claimed) : claimed_(claimed) {}

  [[nodiscard]] std::size_t count() const { return claimed_.knots.size() - 1; }
  [[nodiscard]] const Knot& from(std::size_t i) const { return claimed_.knots[i]; }
  [[nodiscard]] const Knot& to(std::size_t i) const { return claimed_.knots[i + 1]; }
  /// Valid until the next one is asked for. A step that the bounds are not about has none.
  PersonStep at(std::size_t i) {
    PersonStep step = across(i);
    if (!isUsual(i)) bounds_.assign(bounds_.size(), LinkBound{});
    PosedStep& posed = step.step;
    if (i > 0 && isUsual(i - 1)) {
      posed.before = from(i - 1).pose;
      posed.secondsBefore = secondsBetween(from(i - 1), from(i));
      leaveOutLost(from(i - 1));
    }
    if (i + 1 < count() && isUsual(i + 1) && claimed_.model == MotionModel::CubicLate) {
      posed.after = to(i + 1).pose;
      posed.secondsAfter = secondsBetween(to(i), to(i + 1));
      leaveOutLost(to(i + 1));
    }
    return step;
  }
  /// The same for any length: only the bounds' speeds and errors hold.
  PersonStep across(std::size_t i) {
    bounds_ = claimed_.bounds;
    leaveOutLost(from(i));
    leaveOutLost(to(i));
    PersonStep step;
    step.model = claimed_.model;
    step.bounds = &bounds_;
    step.step.from = from(i).pose;
    step.step.to = to(i).pose;
    step.step.seconds = secondsBetween(from(i), to(i));
    return step;
  }
  [[nodiscard]] bool isUsual(std::size_t i) const {
    const double seconds = secondsBetween(from(i), to(i));
    return claimed_.stepS == 0.0 ||
           std::abs(seconds - claimed_.stepS) <= kRateShare * claimed_.stepS;
  }

 private:
  /// Nothing is claimed about links whose pose is made up.
  void leaveOutLost(const Knot& knot) {
    if (claimed_.lost == nullptr) return;
    const auto found = claimed_.lost->find(knot.utimeUs);
    if (found == claimed_.lost->end()) return;
    for (const LinkId link : found->second) bounds_[slotOf(link)] = LinkBound{};
  }

  std::vector<LinkBound> bounds_;
  const Claimed& claimed_;
};

class Persons {
 public:
  Persons(const LoadedWorld& world, std::int64_t fromUs, std::int64_t toUs)
      : world_(world), fromUs_(fromUs), toUs_(toUs) {}

  Result<std::optional<WorldPersons>> answer() {
    const auto hasBounds = [](const FileBody& body) { return !body.boundsPath.empty(); };
    const auto& bodies = world_.file.bodies;
    if (std::none_of(bodies.begin(), bodies.end(), hasBounds)) return std::optional<WorldPersons>{};
    FORETOUCH_CHECK(claimAll());
    for (std::size_t i = 0; i < claimed_.size(); ++i) {
      if (claimed_[i].isPerson) {
        ++persons_.persons;
        FORETOUCH_CHECK(askAlone(claimed_[i]));
      }
      for (std::size_t j = i + 1; j < claimed_.size(); ++j) {
        FORETOUCH_CHECK(askPair(claimed_[i], claimed_[j]));
      }
    }
    std::stable_sort(persons_.touches.begin(), persons_.touches.end(),
                     [](const WorldPersonTouch& x, const WorldPersonTouch& y) {
                       return x.touch.beginsS[0] < y.touch.beginsS[0];
                     });
    return std::optional<WorldPersons>(std::move(persons_));
  }

 private:
  [[nodiscard]] const LoadedBody& bodyOf(BodyId id) const { return world_.bodies[slotOf(id)]; }
  [[nodiscard]] const Avatar& avatarOf(const Claimed& claimed) const {
    return *bodyOf(claimed.id).shape.avatar;
  }

  Result<Done> claimAll() {
    std::vector<std::string> without;
    for (std::size_t i = 0; i < world_.numBodies(); ++i) {
      const auto id = static_cast<BodyId>(i);
      const LoadedBody& body = world_.bodies[i];
      const FileBody& file = world_.file.bodies[i];
      const bool stands = body.numPoses == 0 && file.changes.empty();
      const bool isKnown = stands || !file.boundsPath.empty() || file.isExact;
      if (!body.shape.avatar || !isKnown) {
        without.push_back(inQuotes(file.name));
        continue;
      }
      FORETOUCH_TRY(auto claimed, claimedOf(id, stands));
      if (claimed.knots.size() > 1) claimed_.push_back(std::move(claimed));
    }
    if (!without.empty()) {
      persons_.notes.push_back(fmt::format(
          "Of persons and {} nothing is claimed: meshes are not asked, and of what moves a body "
          "needs bounds, a file or \"exact\".",
          fmt::join(without, ", ")));
    }
    return Done{};
  }

  Result<Claimed> claimedOf(BodyId id, bool stands) const {
    const FileBody& file = world_.file.bodies[slotOf(id)];
    const LoadedBody& body = bodyOf(id);
    const Track& track = body.stretches.front().track;
    const auto numLinks = countOf(body.shape.avatar->numLinks());
    Claimed claimed;
    claimed.id = id;
    claimed.isPerson = !file.boundsPath.empty();
    claimed.knots = stands ? standingFrom(track, fromUs_, toUs_) : knotsOf(track);
    LinkBound exact;
    exact.acceleration = 0.0;
    claimed.bounds.assign(numLinks, exact);
    if (!claimed.isPerson || claimed.knots.size() < 2) return claimed;
    claimed.model = file.between;
    claimed.stepS = usualStepS(claimed.knots);
    claimed.lost = &body.lostLinks;
    FORETOUCH_TRY(const auto bounds, readBounds(file.boundsPath));
    FORETOUCH_TRY(auto known, inFile(boundsOf(bounds, body.shape.avatar->skeleton(), file.between,
                                              1.0 / claimed.stepS),
                                     file.boundsPath));
    claimed.bounds = std::move(known.bounds);
    return claimed;
  }

  void addTouches(BodyId body, std::optional<BodyId> other, BracketJoiner& joiner) {
    for (PersonTouch& touch : joiner.finish()) {
      persons_.touches.push_back({body, other, touch});
    }
  }

  void count(const std::vector<LinkBracket>& brackets) {
    for (const LinkBracket& bracket : brackets) persons_.counts.add(bracket.verdict);
  }

  [[nodiscard]] bool isWithin(const Knot& from, const Knot& to) const {
    return to.utimeUs > fromUs_ && from.utimeUs < toUs_;
  }

  /// Asks about the scene, and own links.
  Result<Done> askAlone(const Claimed& claimed) {
    const LoadedBody& body = bodyOf(claimed.id);
    const bool asksScene = world_.scene && isAsked(world_, body.group, std::nullopt);
    if (!asksScene && !body.self) return Done{};
    BracketOptions options;
    options.surface = body.shape.surface;
    options.self = body.self;
    FORETOUCH_TRY(
        const auto query,
        BracketQuery::build(avatarOf(claimed), asksScene ? world_.scene : std::nullopt, options));
    BracketJoiner joiner;
    Steps steps(claimed);
    BoundCheck check(avatarOf(claimed), claimed.bounds);
    const double worstM = persons_.counts.worstM;
    for (std::size_t i = 0; i < steps.count(); ++i) {
      if (!isWithin(steps.from(i), steps.to(i))) continue;
      const PersonStep step = steps.isUsual(i) ? steps.at(i) : steps.across(i);
      FORETOUCH_CHECK(steps.isUsual(i)
                          ? query.answer(step.step, step.model, *step.bounds, scratch_, brackets_)
                          : query.answerGap(step.step, *step.bounds, scratch_, brackets_));
      if (asksScene) {
        count(brackets_.links);
        if (steps.isUsual(i)) checkLeftOut(step, steps.from(i), steps.to(i), body, check);
      }
      joiner.add(LoadedWorld::secondsOf(steps.from(i).utimeUs),
                 LoadedWorld::secondsOf(steps.to(i).utimeUs), brackets_);
    }
    addTouches(claimed.id, std::nullopt, joiner);
    if (persons_.counts.worstM > worstM) persons_.worstBody = claimed.id;
    return Done{};
  }

  /// Checks the clip's poses between the two knots.
  void checkLeftOut(const PersonStep& step, const Knot& from, const Knot& to,
                    const LoadedBody& body, BoundCheck& check) {
    auto next =
        std::upper_bound(body.leftOut.begin(), body.leftOut.end(), from.utimeUs,
                         [](std::int64_t us, const BodyKnot& knot) { return us < knot.utimeUs; });
    if (next == body.leftOut.end() || next->utimeUs >= to.utimeUs) return;
    check.begin(step.step, step.model);
    for (; next != body.leftOut.end() && next->utimeUs < to.utimeUs; ++next) {
      const double u = static_cast<double>(next->utimeUs - from.utimeUs) /
                       static_cast<double>(to.utimeUs - from.utimeUs);
      check.leftOut(
          next->pose, u, LoadedWorld::secondsOf(next->utimeUs), brackets_,
          [](LinkId) { return true; }, persons_.counts);
    }
  }

  /// The part of a step from one instant to another.
  static PersonStep partOf(Steps& steps, std::size_t i, std::int64_t fromUs, std::int64_t toUs) {
    PersonStep step = steps.at(i);
    const auto at = [&](std::int64_t us) {
      return static_cast<double>(us - steps.from(i).utimeUs) /
             static_cast<double>(steps.to(i).utimeUs - steps.from(i).utimeUs);
    };
    step.begin = at(fromUs);
    step.end = at(toUs);
    return step;
  }

  Result<Done> askPair(const Claimed& one, const Claimed& other) {
    const LoadedBody &body = bodyOf(one.id), &otherBody = bodyOf(other.id);
    if (!one.isPerson && !other.isPerson) return Done{};
    if (!isAsked(world_, body.group, otherBody.group)) return Done{};
    PairBracketQuery::Options options;
    options.surface = body.shape.surface;
    options.otherSurface = otherBody.shape.surface;
    FORETOUCH_TRY(const auto query,
                  PairBracketQuery::build(avatarOf(one), avatarOf(other), options));
    BracketJoiner joiner;
    Steps ofOne(one), ofOther(other);
    const auto links = avatarOf(one).numLinks() * avatarOf(other).numLinks();
    for (std::size_t i = 0, j = 0; i < ofOne.count() && j < ofOther.count();) {
      const std::int64_t fromUs =
          std::max({ofOne.from(i).utimeUs, ofOther.from(j).utimeUs, fromUs_});
      const std::int64_t toUs = std::min({ofOne.to(i).utimeUs, ofOther.to(j).utimeUs, toUs_});
      if (fromUs < toUs) {
        FORETOUCH_CHECK(query.answer(partOf(ofOne, i, fromUs, toUs),
                                     partOf(ofOther, j, fromUs, toUs), scratch_, brackets_));
        count(brackets_.pairs);
        persons_.counts.addExcluded(links - static_cast<LinkId>(brackets_.pairs.size()));
        joiner.add(LoadedWorld::secondsOf(fromUs), LoadedWorld::secondsOf(toUs), brackets_);
      }
      ofOne.to(i).utimeUs <= ofOther.to(j).utimeUs ? ++i : ++j;
    }
    addTouches(one.id, other.id, joiner);
    return Done{};
  }

  const LoadedWorld& world_;
  std::int64_t fromUs_, toUs_;
  std::vector<Claimed> claimed_;
  Scratch scratch_;
  StepBrackets brackets_;
  WorldPersons persons_;
};

PersonNames namesOf(const LoadedWorld& world, const WorldPersonTouch& of) {
  PersonNames names;
  names.body = world.nameOf(of.body);
  names.link = world.linkNameOf(of.body, of.touch.link);
  if (of.other) names.otherBody = world.nameOf(*of.other);
  if (of.touch.other != kNoParent) {
    names.other = world.linkNameOf(of.other.value_or(of.body), of.touch.other);
  }
  if (of.touch.triangle >= 0 && !of.other) {
    names.object = world.scene->objectNames()[slotOf(world.scene->object(of.touch.triangle))];
  }
  return names;
}

std::int64_t certainOf(const WorldPersons& persons) {
  return std::count_if(persons.touches.begin(), persons.touches.end(),
                       [](const WorldPersonTouch& of) { return of.touch.isCertain; });
}

}  // namespace

Result<std::optional<WorldPersons>> personsOf(const LoadedWorld& world, std::int64_t fromUs,
                                              std::int64_t toUs) {
  return Persons(world, fromUs, toUs).answer();
}

std::string personLines(const LoadedWorld& world, const WorldPersons& persons) {
  std::string text;
  for (const WorldPersonTouch& of : persons.touches) {
    text += personTouchLine(namesOf(world, of), of.touch);
  }
  return text + objectLine("persons", [&](JsonWriter& out) {
           out.field("bodies", persons.persons);
           out.field("intervals", persons.counts.intervals);
           out.field("excluded", persons.counts.excluded);
           out.field("possible", persons.counts.possible);
           out.field("certain", persons.counts.certain);
           out.field("unclaimed", persons.counts.unclaimed);
           out.field("bounds_broken", persons.counts.broken);
           if (persons.counts.broken > 0) {
             out.field("worst_body", world.nameOf(persons.worstBody));
             out.field("worst_link", world.linkNameOf(persons.worstBody, persons.counts.worstLink));
             out.field("worst_s", persons.counts.worstS);
             out.field("worst_m", persons.counts.worstM);
           }
         });
}

std::string personText(const LoadedWorld& world, const WorldPersons& persons) {
  std::string text = fmt::format("\nwithin the bounds of {} of the bodies:\n", persons.persons);
  const std::int64_t certain = certainOf(persons);
  text += fmt::format("{:<22}{:>10}\n{:<22}{:>10}\n", "surely touched", certain, "perhaps touched",
                      static_cast<std::int64_t>(persons.touches.size()) - certain);
  int told = 0;
  for (const WorldPersonTouch& of : persons.touches) {
    if (!of.touch.isCertain || ++told > kMostTold) continue;
    const PersonNames names = namesOf(world, of);
    const std::string other = of.other
                                  ? names.otherBody + (names.other.empty() ? "" : " " + names.other)
                                  : names.other + names.object;
    text += fmt::format("  {} {} and {}: began between {:.3f} and {:.3f} s\n", names.body,
                        names.link, other, of.touch.beginsS[0], of.touch.beginsS[1]);
  }
  if (told > kMostTold) text += fmt::format("  and {} more in the results\n", told - kMostTold);
  for (const std::string& note : persons.notes) text += note + "\n";
  const std::string broken =
      persons.counts.brokenNote(world.labelOf(persons.worstBody, persons.counts.worstLink));
  return broken.empty() ? text : text + broken + "\n";
}

}  // namespace foretouch::tools
