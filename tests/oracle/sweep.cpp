// tests/oracle/sweep.cpp: the loop over steps and links.
#include "tests/oracle/sweep.h"

#include <algorithm>
#include <atomic>
#include <iomanip>
#include <sstream>
#include <thread>

#include "tests/reference/rungs.h"
#include "tests/support/judged_pairs.h"

namespace foretouch::test {
namespace {

using Clock = std::chrono::steady_clock;
constexpr std::size_t kMostViolations = 20;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

class Sweeper {
 public:
  Sweeper(const SweepClip& clip, const SweepScene& scene, const Placement& placement,
          const SweepOptions& options)
      : clip_(clip), scene_(scene), placement_(placement), options_(options) {
    query_.tolerance = options.tolerance;
    query_.workBudget = options.workBudget;
    query_.deadlineUs = options.deadlineUs;
    query_.surface = clip.surface;
    query_.fidelity = clip.surface ? Fidelity::Exact : options.fidelity;
    if (clip.skin && options.fidelity == Fidelity::Skinned) {
      query_.fidelity = Fidelity::Skinned;
      query_.skin = clip.skin;
    }
    query_.self = options.self;
    if (options.self) {
      pairs_.emplace(clip.avatar, *options.self, clip.surface ? &*clip.surface : nullptr);
    }
    stride_ = std::min(strideFor(clip.clip, options.rateHz),
                       static_cast<int>(clip.clip.frames.size()) - 1);
    steps_ = clip.numSteps(stride_);
    chosen_ = std::min(options.maxSteps, steps_);
  }

  SweepTally run() {
    std::vector<SweepTally> tallies(static_cast<std::size_t>(std::max(1, options_.threads)));
    std::vector<std::thread> workers;
    for (std::size_t i = 1; i < tallies.size(); ++i) {
      workers.emplace_back([this, &tallies, i] { work(tallies[i]); });
    }
    work(tallies[0]);
    for (std::thread& worker : workers) worker.join();
    SweepTally total;
    for (const SweepTally& tally : tallies) total.add(tally);
    std::sort(total.violations.begin(), total.violations.end());
    return total;
  }

 private:
  void work(SweepTally& tally) {
    Scratch scratch;
    const auto query = buildReference(clip_.avatar, scene_.scene, query_, options_.reference);
    if (!query.ok()) {
      ++tally.failedQueries;
      note(tally, "query refused: " + describe(query.error()));
      return;
    }
    for (int i = next_++; i < chosen_; i = next_++) {
      if (options_.deadline && Clock::now() > *options_.deadline) {
        tally.outOfTime = true;
        return;
      }
      step(static_cast<int>(static_cast<std::int64_t>(i) * steps_ / chosen_), query.value(),
           scratch, tally);
    }
  }

  void step(int n, const Query& query, Scratch& scratch, SweepTally& tally) const {
    const Skeleton& skeleton = clip_.avatar.skeleton();
    const auto frame = static_cast<std::size_t>(n * stride_);
    const Pose from = placed(skeleton, clip_.clip.frames[frame], placement_);
    const Pose to =
        placed(skeleton, clip_.clip.frames[frame + static_cast<std::size_t>(stride_)], placement_);
    const auto asked = Clock::now();
    const ChainMotion motion(skeleton, from, to);
    StepContacts answer = query.answer(motion, scratch);
    const double seconds = secondsSince(asked);
    tally.querySeconds += seconds;
    tally.slowestQueryS = std::max(tally.slowestQueryS, seconds);
    ++tally.steps;
    const oracle::Motion truth(plainJoints(skeleton, from, to));
    if (pairs_) return judgePairs(n, answer, truth, tally);
    if (options_.reference.rung) {
      judgeVolumes(n, motion, answer, truth, tally);
      return;
    }
    for (LinkContact contact : answer.links) {
      if (options_.tamper) options_.tamper(contact);
      judge(n, contact, truth, tally);
    }
  }

  void judgePairs(int n, StepContacts& step, const oracle::Motion& truth, SweepTally& tally) const {
    if (!step.arePairsAnswered) {
      ++tally.failedQueries;
      note(tally, where(n) + " says nothing of pairs");
    }
    if (options_.tamperWithPairs) options_.tamperWithPairs(step.pairs);
    const auto start = Clock::now();
    const std::vector<JudgedPair> judged = pairs_->judge(truth, step, options_.tolerance);
    addJudgeTime(start, tally);
    for (const JudgedPair& pair : judged) {
      count(pair.verdict, pair.judgement, tally);
      if (!pair.isOk()) note(tally, where(n) + " " + pair.text(clip_.avatar.skeleton()));
    }
  }

  /// Each volume once, by what its first link was told.
  void judgeVolumes(int n, const ChainMotion& motion, const StepContacts& step,
                    const oracle::Motion& truth, SweepTally& tally) const {
    for (const RungVolume& volume :
         rungVolumes(clip_.avatar, motion, scene_.scene, *options_.reference.rung)) {
      LinkContact contact = step.links[static_cast<std::size_t>(volume.links.front())];
      contact.link = volume.carrier;
      if (options_.tamper) options_.tamper(contact);
      judge(n, contact, truth, {plain(volume.lss)}, tally);
    }
  }

  void judge(int n, const LinkContact& contact, const oracle::Motion& truth,
             SweepTally& tally) const {
    judge(n, contact, truth, clip_.capsules[static_cast<std::size_t>(contact.link)], tally);
  }

  void judge(int n, const LinkContact& contact, const oracle::Motion& truth,
             const std::vector<oracle::Capsule>& capsules, SweepTally& tally) const {
    if (capsules.empty() && contact.verdict == Verdict::Clear) return;
    const bool isExact = !clip_.meshes.empty();
    if (isExact && clip_.meshes[static_cast<std::size_t>(contact.link)].empty()) {
      if (contact.verdict != Verdict::Clear) note(tally, where(n) + " touches without a mesh");
      return;
    }
    const auto start = Clock::now();
    const oracle::Answer answer = plain(contact);
    const bool isSkinned = query_.fidelity == Fidelity::Skinned;
    const oracle::Judgement judgement =
        isSkinned ? oracle::Judge(scene_.oracle, truth,
                                  clip_.skins[static_cast<std::size_t>(contact.link)])
                        .judge(answer, options_.tolerance)
        : isExact ? oracle::Judge(scene_.oracle, truth, contact.link,
                                  clip_.meshes[static_cast<std::size_t>(contact.link)])
                        .judge(answer, options_.tolerance)
                  : oracle::Judge(scene_.oracle, truth, contact.link, capsules)
                        .judge(answer, options_.tolerance);
    addJudgeTime(start, tally);
    count(answer.verdict, judgement, tally);
    if (judgement.finding == oracle::Finding::Ok) return;
    std::ostringstream line;
    line << where(n) << " link " << contact.link << " '"
         << clip_.avatar.skeleton().name(contact.link) << "' lss " << contact.lss << " triangle "
         << contact.triangle << ": " << toString(answer.verdict) << std::setprecision(17)
         << ", toi " << answer.toi << ", free until " << answer.freeUntil << ", separation "
         << answer.separation << ", penetration " << answer.penetration << " -> "
         << toString(judgement.finding) << (judgement.what.empty() ? "" : " (") << judgement.what
         << (judgement.what.empty() ? "" : ")") << ": at t " << std::setprecision(21)
         << judgement.time << " the separation is " << judgement.separation;
    note(tally, line.str());
  }

  static void addJudgeTime(Clock::time_point start, SweepTally& tally) {
    const double seconds = secondsSince(start);
    tally.judgeSeconds += seconds;
    tally.slowestJudgementS = std::max(tally.slowestJudgementS, seconds);
  }

  static void count(oracle::Verdict verdict, const oracle::Judgement& judgement,
                    SweepTally& tally) {
    ++tally.judged;
    ++tally.verdicts[static_cast<std::size_t>(verdict)];
    ++tally.findings[static_cast<std::size_t>(judgement.finding)];
    tally.grazing += judgement.grazing;
    tally.looks += judgement.looks;
  }

  [[nodiscard]] std::string where(int n) const {
    std::ostringstream text;
    text << clip_.name << " x " << scene_.name << std::setprecision(17) << ", scale " << clip_.scale
         << ", placed at (" << placement_.position.x() << ", " << placement_.position.y() << ", "
         << placement_.position.z() << ") yaw " << placement_.yaw << ", eps " << options_.tolerance
         << ", step " << n << " (frames " << n * stride_ << " to " << (n + 1) * stride_ << ")";
    return text.str();
  }

  static void note(SweepTally& tally, const std::string& line) {
    if (tally.violations.size() < kMostViolations) tally.violations.push_back(line);
  }

  const SweepClip& clip_;
  const SweepScene& scene_;
  const Placement& placement_;
  const SweepOptions& options_;
  QueryOptions query_;
  std::optional<PairsJudge> pairs_;  // of own links, if they are asked
  int stride_ = 1, steps_ = 0, chosen_ = 0;
  std::atomic<int> next_{0};
};

}  // namespace

void SweepTally::add(const SweepTally& other) {
  steps += other.steps;
  judged += other.judged;
  for (std::size_t i = 0; i < kVerdicts; ++i) verdicts[i] += other.verdicts[i];
  for (std::size_t i = 0; i < kFindings; ++i) findings[i] += other.findings[i];
  failedQueries += other.failedQueries;
  grazing += other.grazing;
  looks += other.looks;
  querySeconds += other.querySeconds;
  judgeSeconds += other.judgeSeconds;
  slowestQueryS = std::max(slowestQueryS, other.slowestQueryS);
  slowestJudgementS = std::max(slowestJudgementS, other.slowestJudgementS);
  for (const std::string& line : other.violations) {
    if (violations.size() < kMostViolations) violations.push_back(line);
  }
  outOfTime = outOfTime || other.outOfTime;
}

std::uint64_t SweepTally::broken() const {
  std::uint64_t sum = failedQueries;
  for (const auto finding : {oracle::Finding::Missed, oracle::Finding::Late, oracle::Finding::Early,
                             oracle::Finding::WrongStart, oracle::Finding::Inconsistent}) {
    sum += of(finding);
  }
  return sum;
}

std::string SweepTally::summary() const {
  using oracle::Finding;
  using oracle::Verdict;
  std::ostringstream text;
  text << steps << " steps, " << judged << " answers: " << of(Verdict::Contact) << " contact, "
       << of(Verdict::StartsInContact) << " starts in contact, " << of(Verdict::Clear) << " clear, "
       << of(Verdict::Undecided) << " undecided";
  for (const auto finding : {Finding::Missed, Finding::Late, Finding::Early, Finding::WrongStart,
                             Finding::Inconsistent, Finding::Unproved}) {
    text << ", " << of(finding) << " " << toString(finding);
  }
  if (failedQueries > 0) text << ", " << failedQueries << " failed queries";
  text << std::setprecision(3) << "; " << grazing << " grazing spans; query " << querySeconds
       << " s (slowest step " << 1e3 * slowestQueryS << " ms), judge " << judgeSeconds
       << " s (slowest " << 1e3 * slowestJudgementS << " ms)";
  return text.str();
}

SweepTally sweep(const SweepClip& clip, const SweepScene& scene, const Placement& placement,
                 const SweepOptions& options) {
  return Sweeper(clip, scene, placement, options).run();
}

}  // namespace foretouch::test
