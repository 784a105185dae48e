#include "tools/solid/solid_summary.h"

#include <algorithm>

#include <fmt/format.h>

#include "articulated/motion.h"
#include "assets/json_writer.h"
#include "lss/index.h"
#include "tools/json_line.h"
#include "tools/percentile.h"

namespace foretouch::tools {
namespace {

/// The hands, by their names' weights: hands count 4, the trunk 30, others 1 (solid_options.h).
std::vector<LinkId> handsOf(const Avatar& avatar) {
  constexpr double kOther = 1.0, kBelowTrunk = 10.0;
  const std::vector<double> visibility = visibilityByName(avatar);
  std::vector<LinkId> hands;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    const double own = visibility[slotOf(link)];
    if (own > kOther && own < kBelowTrunk && !avatar.lss(link).empty()) hands.push_back(link);
  }
  return hands;
}

double shiftBetween(const Skeleton& skeleton, const Pose& from, const Pose& to) {
  const ChainMotion motion(skeleton, from, to);
  double most = 0.0;
  for (JointId joint = 0; joint < skeleton.numJoints(); ++joint) {
    most =
        std::max(most, (motion.stateAt(joint, 1.0).p_WL - motion.stateAt(joint, 0.0).p_WL).norm());
  }
  return most;
}

std::string inMillimetres(const Deviations& found) {
  constexpr double kMmPerM = 1e3;
  return fmt::format("mean {:.3g} mm   p90 {:.3g} mm   max {:.3g} mm", kMmPerM * found.mean,
                     kMmPerM * found.p90, kMmPerM * found.most);
}

void writeDeviations(const char* name, const Deviations& found, JsonWriter& out) {
  writeObject(name, out, [&] {
    out.field("mean", found.mean);
    out.field("p90", found.p90);
    out.field("max", found.most);
  });
}

}  // namespace

SolidSummary::SolidSummary(const ReplayInputs& inputs)
    : inputs_(inputs), handLinks_(handsOf(inputs.avatar)) {
  for (LinkId link = 0; link < inputs.avatar.numLinks(); ++link) {
    if (!inputs.avatar.lss(link).empty()) links_.push_back(link);
  }
}

void SolidSummary::add(const PlayedTick& tick) {
  const SolidTick& answer = tick.answer;
  ++ticks_;
  ++ofState_[static_cast<std::size_t>(answer.state)];
  ++ofLimit_[static_cast<std::size_t>(answer.limit)];
  certified_ += answer.isCertified ? 1 : 0;
  queries_ += answer.counters.queries;
  latenciesUs_.push_back(static_cast<float>(tick.latencyUs));
  lift_ = std::max(lift_, answer.lift);
  for (const SolidContact& contact : answer.contacts) push_ = std::max(push_, contact.push);
  if (answer.isCertified && tick.numPieces() > 0) {
    motions_ += static_cast<std::int64_t>(tick.numPieces());
    clearance_ = clearance_ < 0.0 ? answer.clearance : std::min(clearance_, answer.clearance);
  }
  if (answer.state == SolidState::Placing) return;
  if (tick.start() != nullptr && !isPlaced_) {
    placingShift_ = shiftBetween(inputs_.avatar.skeleton(), tick.tracked, *tick.start());
    isPlaced_ = true;
  }
  const auto deviationOf = [&](LinkId link) {
    return static_cast<float>(answer.linkDeviation[slotOf(link)]);
  };
  for (const LinkId link : links_) all_.push_back(deviationOf(link));
  for (const LinkId link : handLinks_) hands_.push_back(deviationOf(link));
}

Deviations SolidSummary::deviations(const std::vector<float>& all) {
  if (all.empty()) return {};
  double sum = 0.0;
  for (const float value : all) sum += static_cast<double>(value);
  std::vector<float> values = all;
  return {sum / static_cast<double>(all.size()), percentile(values, 0.9), percentile(values, 1.0)};
}

double SolidSummary::keptS() const {
  const std::int64_t kept = of(SolidState::Sliding) + of(SolidState::Held) + of(SolidState::Around);
  return static_cast<double>(kept) * tickS(inputs_);
}

double SolidSummary::queriesPerTick() const {
  return static_cast<double>(queries_) / static_cast<double>(std::max<std::int64_t>(1, ticks_));
}

double SolidSummary::leastClearance() const {
  return std::max(0.0, clearance_);
}

double SolidSummary::latencyUs(double share) const {
  std::vector<float> latencies = latenciesUs_;
  return percentile(latencies, share);
}

std::string SolidSummary::states() const {
  std::string text;
  for (std::size_t i = 0; i < ofState_.size(); ++i) {
    if (ofState_[i] == 0) continue;
    text += fmt::format("  {:<20}{:>10}   {:.1f} %\n", toString(static_cast<SolidState>(i)),
                        ofState_[i],
                        100.0 * static_cast<double>(ofState_[i]) / static_cast<double>(ticks_));
  }
  return text;
}

std::string SolidSummary::text() const {
  constexpr double kMmPerM = 1e3;
  const double clipHz = 1.0 / inputs_.clip.frameTimeS;
  std::string text = fmt::format(
      "{} in {}: {} triangles, {} links, {:.5g} of {:.5g} poses a second\n\n{:<22}{:>10}\n",
      inputs_.request.motionPath, inputs_.request.scenePath, inputs_.scene.audit().triangles,
      inputs_.avatar.numLinks(), clipHz / static_cast<double>(inputs_.steps.stride), clipHz,
      "ticks", ticks_);
  text += states();
  text += fmt::format("{:<22}{:>10}   {} motions, each proven to touch nothing\n", "certified",
                      certified_, motions_);
  text += fmt::format("\ndeviation of a link    {}\n", inMillimetres(ofAll()));
  if (hasHands()) text += fmt::format("of a hand              {}\n", inMillimetres(ofHands()));
  text += fmt::format("kept by surfaces       {:.3g} s of {:.3g} s\n", keptS(),
                      static_cast<double>(ticks_) * tickS(inputs_));
  text += fmt::format("nearest on any way     at least {:.3g} mm\n", kMmPerM * leastClearance());
  if (placingShift_ > 0.0) {
    text += fmt::format("first place            {:.3g} mm from the tracked pose\n",
                        kMmPerM * placingShift_);
  }
  if (lift_ > 0.0)
    text += fmt::format("lifted off the floor   {:.3g} mm at most\n", kMmPerM * lift_);
  text += fmt::format(
      "queries a tick         {:.3g}\nlatency of a tick, us  p50 {:.1f}   p99 {:.1f}   max "
      "{:.1f}\n",
      queriesPerTick(), latencyUs(0.5), latencyUs(0.99), latencyUs(1.0));
  return text;
}

std::string SolidSummary::fields() const {
  std::string text;
  JsonWriter out(text);
  out.field("ticks", ticks_);
  writeObject("states", out, [&] {
    for (std::size_t i = 0; i < ofState_.size(); ++i) {
      out.field(toString(static_cast<SolidState>(i)), ofState_[i]);
    }
  });
  writeObject("limits", out, [&] {
    for (std::size_t i = 0; i < ofLimit_.size(); ++i) {
      out.field(toString(static_cast<SolidLimit>(i)), ofLimit_[i]);
    }
  });
  out.field("certified", certified_);
  out.field("motions", motions_);
  writeDeviations("deviation", ofAll(), out);
  if (hasHands()) writeDeviations("deviation_of_hands", ofHands(), out);
  out.field("kept", keptS());
  out.field("clearance", leastClearance());
  out.field("most_push", push_);
  out.field("most_lift", lift_);
  out.field("placing_shift", placingShift_);
  out.field("queries_per_tick", queriesPerTick());
  return text;
}

std::string SolidSummary::jsonLine(const std::string& output, const std::string& report) const {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("motion", inputs_.request.motionPath);
  out.field("scene", inputs_.request.scenePath);
  out.field("rate", rateTaken(inputs_.steps, inputs_.clip.frameTimeS));
  out.rawItems(fields());
  writeObject("latency_us", out, [&] {
    for (const auto& [name, share] : {std::pair{"p50", 0.5}, {"p99", 0.99}, {"max", 1.0}}) {
      out.field(name, latencyUs(share));
    }
  });
  out.field("output", output);
  if (!report.empty()) out.field("report", report);
  out.endObject();
  return text + "\n";
}

}  // namespace foretouch::tools
