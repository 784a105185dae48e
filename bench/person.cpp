// bench/person.cpp: `foretouch-bench body`: what brackets say about persons whose poses are held
// back, by rate and model, judged; and what they cost beside a plain step.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/motion_model.h"
#include "articulated/result.h"
#include "articulated/try.h"
#include "assets/bounds/bounds_file.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/person/ahead_trial.h"
#include "bench/person/pair_trial.h"
#include "bench/person/person_tables.h"
#include "bench/person/person_trial.h"
#include "bench/person/reach_trial.h"
#include "bench/report.h"
#include "bench/solid/busy_places.h"
#include "bench/solid/cast.h"
#include "bench/solid/cells.h"
#include "bench/timing.h"
#include "tools/person/learn_bounds.h"
#include "tools/progress.h"
#include "tools/settings/lists.h"
#include "tools/settings/world_settings.h"

namespace foretouch::tools {
namespace {

struct PersonBenchRequest {
  std::string dataFolder;  ///< With mocap/ and scenes/; empty: the bundled room and dancer alone.
  std::vector<std::string> scenes, clips;                    ///< As loadCast() takes them.
  std::vector<double> ratesHz{60.0, 30.0, 15.0, 10.0, 5.0};  ///< Rates of given poses.
  std::vector<MotionModel> models{MotionModel::ConstantRate, MotionModel::Cubic,
                                  MotionModel::CubicLate};
  std::vector<Asked> asked{Asked::Scene, Asked::OwnLinks, Asked::OtherPerson};
  int places = 1;           ///< Per clip and scene.
  double seconds = 4.0;     ///< Seconds at each.
  int instants = 3;         ///< Instants that the judge looks at per frame.
  double boundShare = 1.0;  ///< Share of the bounds that hold: below 1 to see them found out.
  std::uint64_t seed = 1;   ///< The seed of the places.
  /// Above 0: bounds are learned at this quantile, on all clips of other makers than the judged
  /// one's; touches that are missed or invented are then counted, and are not violations.
  double learned = 0.0;
  double aheadS = 0.0;  ///< Above 0: instead, what is said about so long after each pose.
  int reaches = 0;      ///< Above 0: instead, so many reaches for a table.
  FigureFiles figures;
};

/// Rates that leave less than one frame out judge nothing.
constexpr double kMostRateShare = 0.51;

/// Another person stands so far from this one (m), and is given at this share of the rate, so that
/// the steps of the two do not begin together.
constexpr double kBesideM = 0.35, kOthersShare = 0.7;

/// The clip's part at a place.
SolidActor partOf(const SolidActor& actor, const BusyPlace& place, double seconds) {
  SolidActor part = actor;
  auto& frames = part.clip.frames;
  const double frameTimeS = part.clip.frameTimeS;
  const auto from = static_cast<std::ptrdiff_t>(place.fromS / frameTimeS);
  frames.erase(frames.begin(), frames.begin() + from);
  frames.resize(std::min(frames.size(), static_cast<std::size_t>(seconds / frameTimeS) + 1));
  return part;
}

/// The names of clips begin with their makers.
std::string makerOf(const SolidActor& actor) {
  return actor.name.substr(0, actor.name.find('_'));
}

/// Bounds of strangers, for one actor.
class Strangers {
 public:
  Strangers(const PersonBenchRequest& request, const std::vector<SolidActor>& actors,
            const SolidActor& actor)
      : skeleton_(actor.avatar.skeleton()) {
    LearnRequest learn;
    learn.models = request.models;
    learn.ratesHz = request.ratesHz;
    learn.quantile = request.learned;
    BoundsLearner learner(learn);
    for (const SolidActor& other : actors) {
      if (makerOf(other) != makerOf(actor)) (void)learner.learn(other.clip, other.avatar);
    }
    file_ = learner.bounds();
  }
  /// Empty if no stranger has this rate.
  [[nodiscard]] std::vector<LinkBound> of(MotionModel model, double rateHz) const {
    auto bounds = boundsOf(file_, skeleton_, model, rateHz);
    return bounds.ok() ? std::move(bounds).value().bounds : std::vector<LinkBound>{};
  }

 private:
  const Skeleton& skeleton_;
  BoundsFile file_;
};

class PersonRuns {
 public:
  PersonRuns(const PersonBenchRequest& request, const SolidStage& stage, const Cast& cast)
      : request_(request), stage_(stage), cast_(cast) {}

  void addAhead(const SolidActor& actor, AheadTallies& tallies) const {
    const BusyPlaceRequest places = placesOf(actor);
    for (const BusyPlace& place : busyPlaces(stage_, actor, places)) {
      const SolidActor part = partOf(actor, place, places.seconds);
      for (const double rateHz : request_.ratesHz) {
        if (rateHz * actor.clip.frameTimeS > 1.0 + 1e-9) continue;
        const auto judged = judgeAhead(stage_, part, place.placement, {rateHz, request_.aheadS});
        auto& rows = tallies[-rateHz];
        rows.resize(judged.size());
        for (std::size_t way = 0; way < judged.size(); ++way) rows[way].add(judged[way]);
      }
    }
  }

  void add(const SolidActor& actor, PersonTallies& tallies) const {
    const BusyPlaceRequest places = placesOf(actor);
    std::optional<Strangers> strangers;
    if (request_.learned > 0.0) strangers.emplace(request_, cast_.actors, actor);
    const SolidActor& next = after(actor);
    for (const BusyPlace& place : busyPlaces(stage_, actor, places)) {
      const SolidActor part = partOf(actor, place, places.seconds);
      for (const double rateHz : request_.ratesHz) {
        if (rateHz * actor.clip.frameTimeS > kMostRateShare) continue;
        for (const MotionModel model : request_.models) {
          std::vector<LinkBound> bounds;
          if (strangers) {
            bounds = strangers->of(model, rateHz);
            if (bounds.empty()) continue;
          }
          for (const Asked asked : request_.asked) {
            if (asked == Asked::OtherPerson) {
              if (!strangers) addPair({part, place.placement, {}}, next, rateHz, model, tallies);
              continue;
            }
            PersonTrial trial{
                rateHz,           model, true, asked == Asked::OwnLinks, request_.boundShare,
                request_.instants};
            trial.bounds = bounds;
            tallies[{asked, -rateHz, model}].add(judgePerson(stage_, part, place.placement, trial));
          }
        }
      }
    }
  }

 private:
  [[nodiscard]] BusyPlaceRequest placesOf(const SolidActor& actor) const {
    BusyPlaceRequest places;
    places.count = request_.places;
    places.seconds = std::min(request_.seconds, actor.clip.durationS());
    places.seed = request_.seed;
    return places;
  }

  /// The next one in the cast, who stands beside the others.
  [[nodiscard]] const SolidActor& after(const SolidActor& actor) const {
    const auto at = static_cast<std::size_t>(&actor - cast_.actors.data());
    return cast_.actors[(at + 1) % cast_.actors.size()];
  }

  /// Where the clip's root is in the middle of it.
  static Eigen::Vector3d middleOf(const SolidActor& actor, const Placement& place) {
    const auto& frames = actor.clip.frames;
    return placed(actor.clip.skeleton, frames[frames.size() / 2], place).translations.front();
  }

  void addPair(PersonOfPair one, const SolidActor& next, double rateHz, MotionModel model,
               PersonTallies& tallies) const {
    BusyPlaceRequest anyPlace = placesOf(next);
    anyPlace.count = 1;
    const auto places = busyPlaces(stage_, next, anyPlace);
    if (places.empty()) return;
    const SolidActor part = partOf(next, places.front(), anyPlace.seconds);
    PersonOfPair other{part, places.front().placement, {}};
    other.place.origin += middleOf(one.actor, one.place) - middleOf(part, other.place) +
                          kBesideM * Eigen::Vector3d::UnitX();
    one.trial = {rateHz, model, true, false, request_.boundShare, request_.instants};
    other.trial = one.trial;
    other.trial.rateHz *= kOthersShare;
    tallies[{Asked::OtherPerson, -rateHz, model}].add(judgePersons(stage_, one, other));
  }

  const PersonBenchRequest& request_;
  const SolidStage& stage_;
  const Cast& cast_;
};

JudgedReport measureReaches(const PersonBenchRequest& request) {
  JudgedReport bench{startedReport("body", "Who is warned before a hand touches a table")};
  ReachRequest reach;
  reach.reaches = request.reaches;
  reach.seed = request.seed;
  bench.add(reachTable(reach));
  return bench;
}

/// One thread.
Result<JudgedReport> measurePerson(const PersonBenchRequest& request) {
  if (request.reaches > 0) return measureReaches(request);
  FORETOUCH_TRY(const auto cast, loadCast(request.dataFolder, request.scenes, request.clips));
  JudgedReport bench{startedReport("body", "What the person touched, who is not the model")};
  BenchReport& report = bench.report;
  PersonTallies tallies;
  AheadTallies ahead;
  ProgressBar progress("body", static_cast<std::int64_t>(cast.stages.size() * cast.actors.size()));
  std::int64_t done = 0;
  for (const SolidStage& stage : cast.stages) {
    for (const SolidActor& actor : cast.actors) {
      const PersonRuns runs(request, stage, cast);
      request.aheadS > 0.0 ? runs.addAhead(actor, ahead) : runs.add(actor, tallies);
      progress.advanceTo(++done);
    }
  }
  for (const auto& [kind, tally] : tallies) {
    if (request.learned > 0.0) break;
    bench.violations += tally.missed + tally.lied;
    for (const std::string& finding : tally.findings) report.notes.push_back(finding);
  }
  for (const auto& [rate, rows] : ahead) {
    for (const AheadTally& tally : rows) bench.violations += tally.late;
  }
  if (request.aheadS > 0.0) {
    report.tables.push_back(aheadTable(ahead, request.aheadS));
  } else {
    report.tables.push_back(bracketTable(tallies, request.learned));
    report.tables.push_back(widthTable(tallies));
  }
  std::vector<std::string> clips;
  for (const SolidActor& actor : cast.actors) clips.push_back(actor.name);
  report.workload.emplace_back("clips", listed(clips));
  if (!cast.leftOut.empty()) report.workload.emplace_back("absent", listed(cast.leftOut));
  return bench;
}

struct AskedPerson {
  PersonBenchRequest request;
  std::vector<std::string> models{"constant-rate", "cubic", "cubic-late"};
  std::vector<std::string> asked{"scene", "own-links", "other-person"};
};

ExitCode run(AskedPerson& asked) {
  PersonBenchRequest& request = asked.request;
  request.models.clear();
  for (const std::string& word : asked.models) request.models.push_back(*motionModelNamed(word));
  request.asked.clear();
  for (const std::string& word : asked.asked) {
    request.asked.push_back(word == "scene"       ? Asked::Scene
                            : word == "own-links" ? Asked::OwnLinks
                                                  : Asked::OtherPerson);
  }
  FORETOUCH_TRY_OR(failed, const auto bench, measurePerson(request));
  return finished(bench, "touches were missed or invented", request.figures);
}

}  // namespace

Command bodyCommand() {
  constexpr int kMostReaches = 100'000, kMostPlaces = 1000, kMostInstants = 100,
                kMostSeed = 1'000'000'000;
  const auto asked = std::make_shared<AskedPerson>();
  PersonBenchRequest& request = asked->request;
  Settings settings;
  addData(settings, request.dataFolder, "With mocap/ and scenes/; $FORETOUCH_DATA says another");
  addWords(settings, "--scenes", "NAME,...", request.scenes, {},
           "kitchen, office, collision-world, undulating, room; kitchen,office,room if not given");
  addWords(settings, "--clips", "NAME,...", request.clips, {},
           "Of mocap/, or paths, or all; six if not given");
  addNumbers(settings, "--rates", "HZ,...", request.ratesHz, kAboveZero,
             "Given poses per second, of clips that have twice as many");
  addWords(settings, "--between", "WORD,...", asked->models,
           {"constant-rate", "cubic", "cubic-late"}, "Models of the motion between two poses");
  addWords(settings, "--asked", "WORD,...", asked->asked, {"scene", "own-links", "other-person"},
           "What the person may touch");
  settings.whole("--places", "N", request.places, 1, kMostPlaces, "Busy places per clip and scene");
  settings.number("--seconds", "S", request.seconds, kAboveZero, "Of the clip at each place");
  settings.whole("--instants", "N", request.instants, 1, kMostInstants,
                 "Per frame of the clip, that the judge looks at");
  settings.whole("--seed", "N", request.seed, 1, kMostSeed, "Of the places");
  settings.number("--bound-share", "X", request.boundShare, kAboveZero,
                  "Of the bounds that hold: below 1, touches are missed");
  settings.number("--learned", "Q", request.learned, NumberRange{0.0, 1.0},
                  "Instead by bounds of the clips of other makers, learned at this quantile");
  settings.number("--ahead", "S", request.aheadS, NumberRange{0.0, 2.0},
                  "Instead: what is said of this long after each pose, beside grown capsules");
  settings.whole(
      "--reaches", "N", request.reaches, 0, kMostReaches,
      "Instead: how long before a touch so many hands are warned that reach for a table, "
      "at 90 Hz");
  addFigures(settings, request.figures, "Also write the table to a file");
  Command command{"body",
                  "What brackets say of persons whose poses are held back; exit code 1 where a "
                  "touch is missed or invented",
                  "Example:\n  foretouch-bench body --scenes kitchen --clips all --rates 30,10",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
