#include "tests/oracle/world_campaign.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "tests/middleware/world/random_worlds.h"
#include "tests/oracle/world_stage.h"

namespace foretouch::test {
namespace {

using Eigen::Vector3d;

constexpr std::int64_t kWindowUs = 150'000;
constexpr std::size_t kMostFindings = 20;

/// What one world is about: who is asked about whom.
class CampaignWorld {
 public:
  CampaignWorld(const SweepClip& one, const SweepClip& other, const WorldCampaign& campaign)
      : one_(one),
        other_(other),
        campaign_(campaign),
        random_(campaign.seed),
        both_(campaign.tolerance),
        untilUs_(campaign.windows * kWindowUs) {
    both_.tamper = campaign.tamper;
  }

  [[nodiscard]] WorldCampaignTally run() {
    switch (campaign_.part) {
      case WorldPart::Pairs: pairs(); break;
      case WorldPart::Thrown: thrown(); break;
      case WorldPart::Held: held(); break;
      case WorldPart::Doors: doors(); break;
      case WorldPart::Lifts: lifts(); break;
      case WorldPart::Wild: wild(); break;
      case WorldPart::Sheets: sheets(); break;
    }
    if (campaign_.eventInstants > 0) return eventTally();
    judgeWindows();
    return tally();
  }

 private:
  [[nodiscard]] BodyId dancer(const SweepClip& clip, double rateHz, std::int64_t offsetUs,
                              const Walk& walk) {
    const BodyId body = both_.add(clip.avatar, ownLinksOf(clip.avatar));
    pushAll(both_, body, posesOf(clip, rateHz, offsetUs, untilUs_, walk));
    return body;
  }
  [[nodiscard]] BodyOptions ownLinksOf(const Avatar& avatar) const {
    BodyOptions options;
    if (campaign_.eventInstants == 0) return options;
    if (auto rules = PairRules::derive(avatar); rules.ok()) options.self = rules.value();
    return options;
  }
  /// Walks through the place where the first one dances.
  [[nodiscard]] BodyId passer() {
    Walk walk;
    walk.place.yaw = random_.uniform(-3.0, 3.0);
    walk.place.position = Vector3d(random_.uniform(0.4, 0.9), 0.0, random_.uniform(-0.3, 0.3));
    walk.speed = Vector3d(random_.uniform(-2.0, -0.5), 0.0, random_.uniform(-0.5, 0.5));
    return dancer(other_, campaign_.otherRateHz, -random_.below(5000), walk);
  }
  [[nodiscard]] BodyId first() { return dancer(one_, campaign_.rateHz, 0, {}); }

  void pairs() {
    const BodyId body = first();
    asked_ = {{body, passer()}};
  }

  void thrown() {
    const BodyId body = first(), prop = both_.add(ring(random_.uniform(0.05, 0.2), 0.02, 16));
    Flight flight;
    flight.periodUs = std::llround(1e6 / campaign_.otherRateHz);
    const double step = 1e-6 * static_cast<double>(flight.periodUs);
    flight.pose = {random_.rotation(), Vector3d(-0.6, random_.uniform(-0.5, 0.5), 0.0)};
    flight.stepBy = step * Vector3d(random_.uniform(1.5, 4.0), 0.0, random_.uniform(-0.5, 0.5));
    flight.turnBy = random_.turn(random_.uniform(4.0, 12.0) * step);
    fly(both_, prop, flight, untilUs_);
    asked_ = {{body, prop}};
  }

  void held() {
    const BodyId body = first(), near = passer(), tool = both_.add(sword());
    const auto hand = one_.avatar.skeleton().find("RightHand");
    const LinkId holding = hand ? *hand : one_.avatar.numLinks() - 1;
    both_.attach(tool, {body, holding}, 0, {random_.rotation(), Vector3d::Zero()});
    asked_ = {{body, tool}, {near, tool}};
  }

  void doors() {
    const BodyId body = first(), door = both_.add(doorPanel(0.9, 2.0));
    const BodyId near = passer();
    Flight swing;
    swing.periodUs = std::llround(1e6 / campaign_.otherRateHz);
    const double angle = random_.uniform(1.0, 4.0) * 1e-6 * static_cast<double>(swing.periodUs);
    swing.turnBy = Quaternion(Eigen::AngleAxisd(angle, Vector3d::UnitY()));
    swing.pose = {Quaternion(Eigen::AngleAxisd(random_.uniform(-3.0, 3.0), Vector3d::UnitY())),
                  Vector3d(random_.uniform(-0.5, 0.5), -1.0, random_.uniform(-0.5, 0.5))};
    fly(both_, door, swing, untilUs_);
    asked_ = {{body, door}, {door, near}};
  }

  void lifts() {
    const BodyId lift = both_.add(platform(3.0));
    Flight rise;
    rise.pose = {random_.rotation(), random_.inBox(3.0)};
    rise.stepBy = 0.01 * random_.direction();
    rise.turnBy = random_.turn(0.01);
    fly(both_, lift, rise, untilUs_);
    for (const SweepClip* clip : {&one_, &other_}) {
      Walk walk;
      const double side = clip == &one_ ? -0.15 : 0.15;
      walk.place.position = Vector3d(side, random_.uniform(0.6, 0.9), random_.uniform(-0.2, 0.2));
      walk.speed = random_.inBox(0.4);
      const double rateHz = clip == &one_ ? campaign_.rateHz : campaign_.otherRateHz;
      rideAll(both_, both_.add(clip->avatar), {lift, 0, true},
              posesOf(*clip, rateHz, 0, untilUs_, walk));
    }
    asked_ = {{1, 2}, {lift, 1}, {lift, 2}};
  }

  void wild() {
    for (int k = 0; k < 3; ++k) {
      Walker walker = randomWalker(random_, random_.inBox(0.4), 0.15);
      const BodyId body = both_.add(walker.avatar, ownLinksOf(walker.avatar));
      walk(both_, body, walker, randomPeriod(random_), untilUs_, random_);
    }
    asked_ = {{0, 1}, {0, 2}, {1, 2}};
  }

  void sheets() {
    const BodyId body = first(), stack = both_.add(sheetStack(0.3, 5, 0.04));
    Flight flight;
    flight.periodUs = std::llround(1e6 / campaign_.otherRateHz);
    const double step = 1e-6 * static_cast<double>(flight.periodUs);
    flight.pose = {random_.rotation(), Vector3d(-0.8, random_.uniform(-0.6, 0.4), 0.0)};
    flight.stepBy = step * Vector3d(random_.uniform(2.0, 8.0), 0.0, random_.uniform(-0.5, 0.5));
    flight.turnBy = random_.turn(random_.uniform(0.0, 12.0) * step);
    fly(both_, stack, flight, untilUs_);
    asked_ = {{body, stack}};
  }

  /// Followed in two calls.
  [[nodiscard]] WorldCampaignTally eventTally() {
    JudgedEvents judged(both_, 0);
    judged.follow(untilUs_ / 3);
    judged.follow(untilUs_);
    judged.judge(campaign_.eventInstants);
    WorldCampaignTally tally;
    tally.worlds = 1;
    tally.windows = judged.tally.counters.windows;
    tally.pairInstants = judged.tally.samples;
    tally.events = judged.tally;
    for (const std::string& problem : judged.tally.problems) addFinding(problem, tally);
    return tally;
  }

  void judgeWindows() {
    for (std::int64_t from = 0; from < untilUs_; from += kWindowUs) {
      for (const auto& [a, b] : asked_) both_.judge(a, b, from, from + kWindowUs);
      ++windows_;
    }
  }

  [[nodiscard]] WorldCampaignTally tally() const {
    WorldCampaignTally tally;
    tally.answers = both_.tally;
    tally.worlds = 1;
    tally.windows = windows_;
    tally.pairInstants = both_.oracle.pairInstants;
    for (const std::string& problem : both_.problems) {
      const std::string kind = problem.substr(problem.rfind(": ") + 2);
      ++(kind == "missed"  ? tally.missed
         : kind == "late"  ? tally.late
         : kind == "early" ? tally.early
                           : tally.other);
      addFinding(problem, tally);
    }
    return tally;
  }
  void addFinding(const std::string& problem, WorldCampaignTally& tally) const {
    tally.findings.push_back(
        fmt::format("{} and {}, {}, {:g} and {:g} Hz, tolerance {:g}, seed {}: {}", one_.name,
                    other_.name, toString(campaign_.part), campaign_.rateHz, campaign_.otherRateHz,
                    campaign_.tolerance, campaign_.seed, problem));
  }

  const SweepClip &one_, &other_;
  const WorldCampaign& campaign_;
  Random random_;
  BothWorlds both_;
  std::int64_t untilUs_;
  std::vector<std::pair<BodyId, BodyId>> asked_;  // the lower one first
  std::uint64_t windows_ = 0;
};

}  // namespace

const char* toString(WorldPart part) {
  constexpr std::array<const char*, kNumWorldParts> kWords = {"pairs", "thrown", "held",  "doors",
                                                              "lifts", "wild",   "sheets"};
  return kWords[static_cast<std::size_t>(part)];
}

void WorldCampaignTally::add(const WorldCampaignTally& more) {
  answers.clear += more.answers.clear;
  answers.contact += more.answers.contact;
  answers.start += more.answers.start;
  answers.undecided += more.answers.undecided;
  answers.grazing += more.answers.grazing;
  worlds += more.worlds;
  windows += more.windows;
  pairInstants += more.pairInstants;
  missed += more.missed;
  late += more.late;
  early += more.early;
  other += more.other;
  events.add(more.events);
  for (const std::string& finding : more.findings) {
    if (findings.size() < kMostFindings) findings.push_back(finding);
  }
}

std::string WorldCampaignTally::summary() const {
  return fmt::format(
      "{} worlds, {} windows, {} pair-instants; {} clear, {} contacts, {} in contact from the "
      "start, {} undecided, {} too slow for the judge; {} missed, {} late, {} early, {} untrue",
      worlds, windows, pairInstants, answers.clear, answers.contact, answers.start,
      answers.undecided, answers.grazing, missed, late, early, other);
}

std::string WorldCampaignTally::summaryOfEvents() const {
  const auto of = [this](EventKind kind) { return events.kinds[static_cast<std::size_t>(kind)]; };
  const auto per = [](std::uint64_t count, std::uint64_t spans) {
    return spans > 0 ? static_cast<double>(count) / static_cast<double>(spans) : 0.0;
  };
  const EventCounters& c = events.counters;
  return fmt::format(
      "{} worlds, {} windows, {} samples, {} of them touching and {} in contact; {} enter, {} "
      "leave, {} start inside, {} pairs with several contacts, {} unresolved; {:.2f} looks in "
      "contact and {:.2f} beside per span in contact; {} touching in free, {} too far in contact, "
      "{} untrue",
      worlds, windows, events.samples, events.touching, events.inContact, of(EventKind::Enter),
      of(EventKind::Leave), of(EventKind::StartsInside), events.severalParts, events.unresolved,
      per(c.contactLooks, c.stretches), per(c.freeLooks, c.stretches), events.missed, events.tooFar,
      events.untrue);
}

WorldCampaignTally judgeWorld(const SweepClip& one, const SweepClip& other,
                              const WorldCampaign& campaign) {
  return CampaignWorld(one, other, campaign).run();
}

}  // namespace foretouch::test
