#include "tools/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/near_names.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tessellation/swept_lss.h"
#include "tools/console.h"
#include "tools/inputs/clip_pose.h"
#include "tools/inputs/played_clip.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;

Error optionError(const char* option, ErrorCode code, std::string message) {
  return Error::in(option, code, std::move(message));
}

Result<std::vector<LinkId>> linksOf(const std::vector<std::string>& names, const Avatar& avatar) {
  const Skeleton& skeleton = avatar.skeleton();
  std::vector<bool> isChosen(countOf(avatar.numLinks()), false);
  for (const std::string& name : names) {
    if (name == "all") {
      for (LinkId link = 0; link < avatar.numLinks(); ++link) {
        isChosen[slotOf(link)] = !avatar.lss(link).empty();
      }
      continue;
    }
    const auto link = skeleton.find(name);
    if (!link) {
      std::vector<std::string> known;
      for (LinkId l = 0; l < avatar.numLinks(); ++l) known.push_back(skeleton.name(l));
      return optionError("--links", ErrorCode::UnknownName,
                         "no link is called " + inQuotes(name) + didYouMean(name, known) +
                             " (foretouch avatar check --links lists all)");
    }
    if (avatar.lss(*link).empty()) {
      return optionError("--links", ErrorCode::Empty,
                         "the link " + inQuotes(name) + " has no LSS, and so sweeps nothing");
    }
    isChosen[slotOf(*link)] = true;
  }
  std::vector<LinkId> links;
  for (LinkId link = 0; link < avatar.numLinks(); ++link) {
    if (isChosen[slotOf(link)]) links.push_back(link);
  }
  if (links.empty()) return optionError("--links", ErrorCode::Empty, "expected the name of a link");
  return links;
}

double stepLengthS(const SweepInputs& inputs) {
  return static_cast<double>(inputs.steps.stride) * inputs.clip.frameTimeS;
}

/// Where the step begins, in the clip.
double beginOf(const SweepInputs& inputs, std::int64_t step) {
  return static_cast<double>(inputs.steps.frameOf(step)) * inputs.clip.frameTimeS;
}

/// Sets [from, to], within the steps' times.
Result<Done> setSpan(SweepInputs& inputs) {
  const double firstS = beginOf(inputs, 0), lastS = beginOf(inputs, inputs.steps.count);
  inputs.fromS = inputs.request.fromS.value_or(firstS);
  inputs.toS = inputs.request.toS.value_or(lastS);
  // A frame time printed with few digits makes the end of a clip uncertain by rounding.
  constexpr double kSlack = 1e-9;
  if (inputs.toS > lastS && inputs.toS <= lastS * (1.0 + kSlack)) inputs.toS = lastS;
  if (!(inputs.fromS >= firstS && inputs.fromS < inputs.toS && inputs.toS <= lastS)) {
    return optionError(
        "--from, --to", ErrorCode::OutOfRange,
        fmt::format("expected {:.6g} <= from < to <= {:.6g} s, where the last step ends, "
                    "found {:.6g} and {:.6g}",
                    firstS, lastS, inputs.fromS, inputs.toS));
  }
  return Done{};
}

Result<Pose> poseAt(const SweepInputs& inputs, std::int64_t step) {
  return poseAtFrame({inputs.avatar, inputs.clip, inputs.match, inputs.request.placement,
                      inputs.isUpright, inputs.request.motionPath},
                     inputs.steps.frameOf(step));
}

Result<ChainMotion> motionOf(const SweepInputs& inputs, std::int64_t step) {
  FORETOUCH_TRY(const auto from, poseAt(inputs, step));
  FORETOUCH_TRY(const auto to, poseAt(inputs, step + 1));
  return ChainMotion(inputs.avatar.skeleton(), from, to);
}

/// One LSS's surface under construction.
struct Work {
  LinkId link = 0;
  const Lss* lss = nullptr;
  SweptSurfaceBuilder builder;
};

Result<std::vector<Work>> workFor(const SweepInputs& inputs) {
  std::vector<Work> works;
  for (const LinkId link : inputs.links) {
    for (const Lss& lss : inputs.avatar.lss(link)) {
      FORETOUCH_TRY(auto builder,
                    inFile(SweptSurfaceBuilder::create(lss, inputs.request.surface), "--error"));
      works.push_back({link, &lss, std::move(builder)});
    }
  }
  return works;
}

Error tooMany(std::size_t most) {
  return optionError("--max-triangles", ErrorCode::LimitExceeded,
                     fmt::format("more than {} triangles; allow more, allow a larger --error, or "
                                 "sweep fewer links or a shorter time",
                                 most));
}

/// The swept part of the step.
SweptSpan spanOf(const SweepInputs& inputs, std::int64_t step) {
  const double length = stepLengthS(inputs);
  const double beginS = beginOf(inputs, step);
  SweptSpan span;
  span.beginT = std::clamp((inputs.fromS - beginS) / length, 0.0, 1.0);
  span.endT = std::clamp((inputs.toS - beginS) / length, 0.0, 1.0);
  span.beginS = beginS + span.beginT * length;
  span.endS = beginS + span.endT * length;
  return span;
}

Result<Done> addStep(const SweepInputs& inputs, std::int64_t step, std::vector<Work>& works) {
  const SweptSpan span = spanOf(inputs, step);
  if (!(span.beginT < span.endT)) return Done{};
  FORETOUCH_TRY(const auto motion, motionOf(inputs, step));
  std::size_t triangles = 0;
  for (Work& work : works) {
    const auto added = work.builder.add(motion, work.link, span);
    if (!added.ok()) {
      if (added.error().code == ErrorCode::LimitExceeded &&
          work.builder.triangles() > inputs.request.surface.maxTriangles) {
        return tooMany(inputs.request.surface.maxTriangles);
      }
      return inFile(added.error(), "--error");
    }
    triangles += work.builder.triangles();
    if (triangles > inputs.request.surface.maxTriangles) {
      return tooMany(inputs.request.surface.maxTriangles);
    }
  }
  return Done{};
}

/// At least the distance of a point from the LSS while the motion is in [beginT, endT].
double distanceFrom(const ChainMotion& motion, LinkId link, const Lss& lss, double beginT,
                    double endT, const Vector3d& point) {
  constexpr int kTimes = 17;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < kTimes; ++i) {
    const double t = beginT + (endT - beginT) * i / (kTimes - 1);
    const AxisEnds ends = axisEnds(lss, motion.stateAt(link, t));
    const Vector3d axis = ends.b - ends.a;
    const double square = axis.squaredNorm();
    const double along =
        square > 0.0 ? std::clamp((point - ends.a).dot(axis) / square, 0.0, 1.0) : 0.0;
    least = std::min(least, (ends.a + along * axis - point).norm());
  }
  return std::max(0.0, least - lss.radius);
}

/// A vertex and the middle of some triangles, spread evenly over the surface, in order of time.
void sampleSurface(const SweepInputs& inputs, const Work& work, const SweptSurface& surface,
                   Sweep& sweep) {
  constexpr std::size_t kSamples = 500;
  const std::size_t stride = std::max<std::size_t>(1, surface.triangles.size() / kSamples);
  const double length = stepLengthS(inputs), firstS = beginOf(inputs, 0);
  std::int64_t madeFor = -1;
  std::optional<ChainMotion> motion;
  for (std::size_t i = 0; i < surface.triangles.size(); i += stride) {
    const auto& corners = surface.triangles[i];
    double beginS = surface.timesS[corners[0]], endS = beginS;
    Vector3d middle = Vector3d::Zero();
    for (const std::uint32_t corner : corners) {
      beginS = std::min(beginS, surface.timesS[corner]);
      endS = std::max(endS, surface.timesS[corner]);
      middle += surface.vertices[corner] / 3.0;
    }
    const auto step = std::clamp<std::int64_t>(
        static_cast<std::int64_t>(std::floor((0.5 * (beginS + endS) - firstS) / length)), 0,
        inputs.steps.count - 1);
    if (step != madeFor) {
      auto made = motionOf(inputs, step);
      if (!made.ok()) return;  // its poses were valid during the sweep
      motion.emplace(std::move(made).value());
      madeFor = step;
    }
    const SweptSpan span = spanOf(inputs, step);
    const auto inSpan = [&](double timeS) {
      return std::clamp((timeS - beginOf(inputs, step)) / length, span.beginT, span.endT);
    };
    for (const Vector3d& point : {middle, surface.vertices[corners[0]]}) {
      sweep.sampledError = std::max(
          sweep.sampledError,
          distanceFrom(*motion, work.link, *work.lss, inSpan(beginS), inSpan(endS), point));
      ++sweep.samples;
    }
  }
}

Result<Done> finishOne(const SweepInputs& inputs, Work& work, Sweep& sweep) {
  auto finished = work.builder.finish();
  if (!finished.ok()) return tooMany(inputs.request.surface.maxTriangles);
  SweptSurface surface = std::move(finished).value();
  if (surface.vanishes) {
    ++sweep.vanished;
    return Done{};
  }
  if (inputs.request.surface.side == SurfaceSide::Outer) {
    sampleSurface(inputs, work, surface, sweep);
  }
  sweep.certifiedError = std::max(sweep.certifiedError, surface.certifiedError);
  sweep.pieces += surface.pieces;
  sweep.vertices += surface.vertices.size();
  sweep.triangles += surface.triangles.size();
  if (sweep.links.empty() || sweep.links.back().link != work.link) {
    sweep.links.push_back({work.link, inputs.avatar.skeleton().name(work.link), {}});
  }
  sweep.links.back().parts.push_back(std::move(surface));
  if (sweep.triangles > inputs.request.surface.maxTriangles) {
    return tooMany(inputs.request.surface.maxTriangles);
  }
  return Done{};
}

}  // namespace

Result<SweepInputs> loadSweepInputs(const SweepRequest& request) {
  FORETOUCH_TRY(auto played, loadPlayedClip(request));
  auto& [avatar, clip, match, steps, isUpright, frame, isByParts] = played;
  FORETOUCH_TRY(auto links, linksOf(request.links, avatar));
  SweepInputs inputs{request, std::move(avatar), std::move(clip), std::move(match),
                     steps,   isUpright,         std::move(links)};
  FORETOUCH_CHECK(setSpan(inputs));
  return inputs;
}

Result<Sweep> sweepOf(const SweepInputs& inputs,
                      const std::function<bool(std::int64_t, std::int64_t)>& progress) {
  FORETOUCH_TRY(auto works, workFor(inputs));
  const double length = stepLengthS(inputs);
  const double firstS = beginOf(inputs, 0);
  const auto first = static_cast<std::int64_t>(std::floor((inputs.fromS - firstS) / length));
  const std::int64_t end = std::min(
      inputs.steps.count, static_cast<std::int64_t>(std::ceil((inputs.toS - firstS) / length)));
  const std::int64_t total =
      std::max<std::int64_t>(0, end - first) + static_cast<std::int64_t>(works.size());
  Sweep sweep;
  std::int64_t done = 0;
  for (std::int64_t step = std::min(first, end - 1); step < end; ++step) {
    FORETOUCH_CHECK(addStep(inputs, step, works));
    if (!progress(++done, total)) return sweep;
  }
  for (Work& work : works) {
    FORETOUCH_CHECK(finishOne(inputs, work, sweep));
    if (!progress(++done, total)) return sweep;
  }
  if (sweep.links.empty()) {
    return optionError("--error", ErrorCode::Empty,
                       "every LSS is too thin for an inner surface with this error; its radius "
                       "must be at least 1.2 times the error");
  }
  return sweep;
}

}  // namespace foretouch::tools
