#include "bench/trade/runner.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <map>
#include <utility>

#include "articulated/try.h"
#include "bench/leaf_timing.h"
#include "lss/assert.h"
#include "lss/index.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// The judge examines only links nearer than this (m).
constexpr double kNearForJudge = 0.1;

/// The truths of all steps of all windows, in order.
struct Truths {
  std::vector<std::vector<LinkTruth>> link, exact;
  std::map<double, std::vector<std::vector<bool>>> within;  ///< By distance (m).
};

class Runner {
 public:
  Runner(const TradeWorld& world, const std::optional<AvatarSurface>& surface, const TradeRun& run,
         std::vector<TradeContender>& contenders)
      : world_(world),
        run_(run),
        contenders_(contenders),
        teller_(world, std::nullopt),
        overheadUs_(clockOverheadUs()) {
    if (surface) exactTeller_.emplace(world, surface);
    for (const TradeWindow& window : run.windows) {
      for (const StepPoses& step : window) steps_.push_back(&step);
    }
    FORETOUCH_ASSERT(!steps_.empty());
  }

  Result<TradeRunResult> run() {
    FORETOUCH_CHECK(tellTruths());
    timeAll();
    TradeRunResult result;
    for (std::size_t c = 0; c < contenders_.size(); ++c) result.rows.push_back(rowOf(c));
    result.judged = judgeSample();
    return result;
  }

 private:
  struct Record {
    std::vector<double> leastUs;                  // per step
    std::vector<std::vector<LinkTouch>> touches;  // per step
    TradeWork work;
  };

  Result<Done> tellTruths() {
    for (const StepPoses* const step : steps_) {
      FORETOUCH_TRY(auto truth, teller_.truthOf(*step));
      truths_.link.push_back(std::move(truth));
      if (!exactTeller_) continue;
      FORETOUCH_TRY(auto exact, exactTeller_->truthOf(*step));
      truths_.exact.push_back(std::move(exact));
    }
    FORETOUCH_CHECK(tellWithin(kNearForJudge));
    for (const TradeContender& contender : contenders_) {
      FORETOUCH_CHECK(tellWithin(contender.tolerance));
    }
    return Done{};
  }

  Result<Done> tellWithin(double distance) {
    if (truths_.within.count(distance) != 0) return Done{};
    std::vector<std::vector<bool>>& all = truths_.within[distance];
    for (const StepPoses* const step : steps_) {
      FORETOUCH_TRY(auto within, teller_.comesWithin(*step, distance));
      all.push_back(std::move(within));
    }
    return Done{};
  }

  void timeAll() {
    records_.resize(contenders_.size());
    for (Record& record : records_) {
      record.leastUs.assign(steps_.size(), std::numeric_limits<double>::infinity());
      record.touches.resize(steps_.size());
    }
    ProgressBar progress(
        "trade", std::int64_t{run_.passes} * static_cast<std::int64_t>(run_.windows.size()));
    std::int64_t done = 0;
    for (int pass = 0; pass < run_.passes; ++pass) {
      std::size_t firstStep = 0;
      for (const TradeWindow& window : run_.windows) {
        for (std::size_t c = 0; c < contenders_.size(); ++c) {
          timeWindow(*contenders_[c].strategy, window, firstStep, pass == 0, records_[c]);
        }
        firstStep += window.size();
        progress.advanceTo(++done);
      }
    }
  }

  void timeWindow(Strategy& strategy, const TradeWindow& window, std::size_t firstStep,
                  bool isCounted, Record& record) {
    for (std::size_t i = 0; i < window.size(); ++i) {
      const TradeStep step{window[i].from, window[i].to, i > 0};
      TradeWork work;
      const Clock::time_point start = Clock::now();
      strategy.solve(step, touches_, work);
      const double us = std::chrono::duration<double, std::micro>(Clock::now() - start).count();
      double& least = record.leastUs[firstStep + i];
      least = std::min(least, std::max(0.0, us - overheadUs_));
      if (!isCounted) continue;
      record.touches[firstStep + i] = touches_;
      record.work.nodes += work.nodes;
      record.work.pairs += work.pairs;
      record.work.states += work.states;
    }
  }

  TradeRow rowOf(std::size_t c) {
    const TradeContender& contender = contenders_[c];
    TradeScorer scorer(run_.stepMs);
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      scorer.add(*steps_[i], records_[c].touches[i],
                 contender.isExact ? truths_.exact[i] : truths_.link[i],
                 truths_.within[contender.tolerance][i], teller_);
    }
    TradeRow row{run_.scene,
                 run_.clip,
                 contender.strategy->name(),
                 contender.strategy->promise(),
                 contender.tolerance,
                 run_.rateHz,
                 scorer.score(),
                 percentilesOf(records_[c].leastUs),
                 records_[c].work,
                 false};
    if (contender.isExact) {  // the distances are those of LSS
      row.score.distanceErrorMean = row.score.distanceErrorMax =
          std::numeric_limits<double>::quiet_NaN();
    }
    return row;
  }

  /// Half of the sample touches, half does not but comes near; spread over all steps.
  JudgedTruth judgeSample() {
    struct Asked {
      std::size_t step;
      LinkId link;
    };
    std::vector<Asked> touching, near;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      for (LinkId link = 0; link < world_.avatar.numLinks(); ++link) {
        const LinkTruth& truth = truths_.link[i][slotOf(link)];
        if (truth.starts) continue;
        if (truth.touches) {
          touching.push_back({i, link});
        } else if (truths_.within[kNearForJudge][i][slotOf(link)]) {
          near.push_back({i, link});
        }
      }
    }
    JudgedTruth judged;
    const auto half = static_cast<std::size_t>(run_.judged) / 2;
    for (const std::vector<Asked>& all : {touching, near}) {
      const std::size_t count = std::min(half, all.size());
      for (std::size_t k = 0; k < count; ++k) {
        const Asked& asked = all[k * all.size() / count];
        judged.add(judge(world_, *steps_[asked.step], asked.link,
                         truths_.link[asked.step][slotOf(asked.link)]));
      }
    }
    return judged;
  }

  const TradeWorld& world_;
  const TradeRun& run_;
  std::vector<TradeContender>& contenders_;
  TruthTeller teller_;
  std::optional<TruthTeller> exactTeller_;
  double overheadUs_;
  std::vector<const StepPoses*> steps_;
  Truths truths_;
  std::vector<Record> records_;
  std::vector<LinkTouch> touches_;
};

}  // namespace

Result<TradeRunResult> runTrade(const TradeWorld& world,
                                const std::optional<AvatarSurface>& surface, const TradeRun& run,
                                std::vector<TradeContender>& contenders) {
  return Runner(world, surface, run, contenders).run();
}

}  // namespace foretouch::tools
