// tests/oracle/sweep_placement.cpp: drawing places and probing them.
#include "tests/oracle/sweep_placement.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "judge/heights.h"
#include "tests/support/random_geometry.h"

namespace foretouch::test {
namespace {

constexpr double kLowRate = 0.05, kHighRate = 0.6;

oracle::Box boxOfAll(const oracle::Scene& scene) {
  oracle::Box box;
  for (int i = 0; i < scene.numTriangles(); ++i) box.add(scene.boxOf(i));
  return box;
}

std::optional<Placement> drawPlacement(Random& random, const SweepClip& clip,
                                       const SweepScene& scene, const oracle::Box& bounds) {
  const double x = random.uniform(bounds.low.x, bounds.high.x);
  const double z = random.uniform(bounds.low.z, bounds.high.z);
  const std::vector<double> heights = oracle::heightsAt(scene.oracle, x, z);
  if (heights.empty()) return std::nullopt;
  // Half of the time the lowest surface, a floor mostly; else any, a table's top or a roof.
  const int level = random.chance(0.5) ? 0 : random.below(static_cast<int>(heights.size()));
  Placement placement;
  placement.yaw = random.uniform(-kPi, kPi);
  const Quaternion turn(std::cos(0.5 * placement.yaw), 0.0, std::sin(0.5 * placement.yaw), 0.0);
  const double clearance = random.uniform(0.0, 0.15);
  placement.position = -(turn * clip.standsAt) + Eigen::Vector3d(x, 0.0, z);
  placement.position.y() = heights[static_cast<std::size_t>(level)] + clearance - clip.lowest;
  return placement;
}

struct Probed {
  Placement placement;
  int contacts = 0, starts = 0;  // links, over all probed steps
};

void probe(const SweepClip& clip, const SweepScene& scene, Probed& probed) {
  constexpr int kProbes = 24;
  constexpr double kProbeRateHz = 10.0;
  const auto& frames = clip.clip.frames;
  const int stride =
      std::min(strideFor(clip.clip, kProbeRateHz), static_cast<int>(frames.size()) - 1);
  const int steps = clip.numSteps(stride), probes = std::min(kProbes, steps);
  const Skeleton& skeleton = clip.avatar.skeleton();
  Scratch scratch;
  const Query query = Query::build(clip.avatar, scene.scene).value();
  int touching = 0;
  for (int i = 0; i < probes; ++i) {
    const int frame = static_cast<int>(static_cast<std::int64_t>(i) * steps / probes) * stride;
    const ChainMotion motion(
        skeleton, placed(skeleton, frames[static_cast<std::size_t>(frame)], probed.placement),
        placed(skeleton, frames[static_cast<std::size_t>(frame + stride)], probed.placement));
    const int before = probed.contacts;
    for (const LinkContact& c : query.answer(motion, scratch).links) {
      probed.contacts += c.verdict == Verdict::Contact;
      probed.starts += c.verdict == Verdict::StartsInContact;
    }
    touching += probed.contacts > before;
  }
  probed.placement.contactRate = static_cast<double>(touching) / std::max(1, probes);
}

/// Many first contacts, and few links that are stuck in something and so have none.
double worth(const Probed& p) {
  return static_cast<double>(p.contacts) * p.contacts / (10 + p.starts);
}

/// 0 inside the band, else how far outside.
double offBand(const Placement& p) {
  return std::max({0.0, kLowRate - p.contactRate, p.contactRate - kHighRate});
}

}  // namespace

std::vector<Placement> choosePlacements(const SweepClip& clip, const SweepScene& scene, int count) {
  constexpr int kDraws = 40;
  std::uint64_t seed = 14695981039346656037u;  // FNV-1a of both names: the same on every platform
  for (const char c : clip.name + "/" + scene.name) {
    seed = (seed ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  Random random(seed);
  const oracle::Box bounds = boxOfAll(scene.oracle);
  std::vector<Probed> drawn;
  for (int i = 0; i < kDraws; ++i) {
    const auto placement = drawPlacement(random, clip, scene, bounds);
    if (!placement) continue;
    drawn.push_back({*placement});
    probe(clip, scene, drawn.back());
  }
  // In the band first; there, the most telling.
  std::stable_sort(drawn.begin(), drawn.end(), [](const Probed& a, const Probed& b) {
    const double offA = offBand(a.placement), offB = offBand(b.placement);
    return offA != offB ? offA < offB : worth(a) > worth(b);
  });
  std::vector<Placement> best;
  for (const Probed& p : drawn) {
    if (best.size() < static_cast<std::size_t>(count)) best.push_back(p.placement);
  }
  return best;
}

}  // namespace foretouch::test
