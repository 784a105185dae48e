#include "tools/report/solid_report.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "tools/report/track_builder.h"
#include "tools/report/view_touches.h"

namespace foretouch::tools {
namespace {

constexpr double kMmPerMetre = 1e3;

std::vector<ViewRow> solidSettings(const ReplayInputs& inputs, SolidRequest solid) {
  const ReplayRequest& request = inputs.request;
  std::vector<ViewRow> rows = sceneSettings(request);
  rows.push_back({"avatar", fileName(request.avatarPath), ""});
  for (ViewRow& row : clipSettings(request)) rows.push_back(std::move(row));
  rows.push_back({"rate", fmt::format("{:.5g} poses a second", 1.0 / tickS(inputs)), ""});
  Settings settings;
  addSolidSettings(settings, solid);
  for (ViewRow& row : rowsOf(settings, {"gap to surfaces", "catches up by", "feet below the floor",
                                        "may snap", "way around"})) {
    rows.push_back(std::move(row));
  }
  for (ViewRow& row : querySettings(request)) {
    if (row.name == "ignored" || row.name == "own links") rows.push_back(std::move(row));
  }
  return rows;
}

std::string inMm(const Deviations& found) {
  return fmt::format("mean {:.3g} mm, p90 {:.3g} mm, max {:.3g} mm", kMmPerMetre * found.mean,
                     kMmPerMetre * found.p90, kMmPerMetre * found.most);
}

std::vector<ViewRow> solidRows(const SolidSummary& summary) {
  std::vector<ViewRow> rows{{"ticks", std::to_string(summary.ticks()), ""}};
  for (std::uint8_t i = 0; i < kNumSolidStates; ++i) {
    const auto state = static_cast<SolidState>(i);
    if (summary.of(state) > 0)
      rows.push_back({toString(state), std::to_string(summary.of(state)), "ticks"});
  }
  rows.push_back({"certified", std::to_string(summary.certified()),
                  "ticks: on the whole way from the pose before, nothing is touched"});
  rows.push_back({"deviation of a link", inMm(summary.ofAll()), "from where its tracker says"});
  if (summary.hasHands()) rows.push_back({"deviation of a hand", inMm(summary.ofHands()), ""});
  rows.push_back({"kept by surfaces", fmt::format("{:.3g} s", summary.keptS()),
                  "sliding, held, or on a way around"});
  rows.push_back({"nearest on any way",
                  fmt::format("at least {:.3g} mm", kMmPerMetre * summary.leastClearance()), ""});
  rows.push_back({"queries a tick", fmt::format("{:.3g}", summary.queriesPerTick()), ""});
  return rows;
}

/// How much of a track a document has room for.
struct ShownPart {
  std::size_t poses = 0, steps = 0, ticks = 0, contacts = 0;
};

ShownPart partOf(const ShownTrack& track, const TrackBuilder& builder,
                 const ReportOptions& options) {
  ShownPart part;
  // Half of the room is for the tracked body.
  const std::size_t most = std::max<std::size_t>(2, builder.capacity(options.maxRotations) / 2);
  const auto& shownAt = track.shownAtTick();
  while (part.ticks < shownAt.size() && shownAt[part.ticks] < most) ++part.ticks;
  part.poses = part.ticks == 0 ? 0 : shownAt[part.ticks - 1] + 1;
  while (part.steps < track.steps().size() && track.steps()[part.steps].to < part.poses) {
    ++part.steps;
  }
  const auto isOver = [&](const ShownContact& contact) {
    return contact.step >= static_cast<std::int64_t>(part.steps);
  };
  const auto& contacts = track.contacts();
  const auto end = std::find_if(contacts.begin(), contacts.end(), isOver);
  part.contacts =
      std::min<std::size_t>(options.maxContacts, static_cast<std::size_t>(end - contacts.begin()));
  return part;
}

/// The shown body's poses and steps.
ViewTrack shownTrackOf(const ShownTrack& track, const ShownPart& part, TrackBuilder& builder,
                       const ReportProgress& progress) {
  for (std::size_t pose = 0; pose < part.poses; ++pose) {
    if (!progress(static_cast<std::int64_t>(pose), static_cast<std::int64_t>(part.poses))) break;
    builder.addPose(track.timesS()[pose], track.poses()[pose]);
  }
  for (std::size_t step = 0; step < part.steps && builder.poses() == part.poses; ++step) {
    builder.addStep(track.steps()[step].from, track.steps()[step].to);
  }
  return builder.finish();
}

/// The tracked body, one step per tick.
ViewTrack trackedTrackOf(const ReplayInputs& inputs, const ShownTrack& track,
                         const ShownPart& part) {
  TrackBuilder builder(inputs.avatar, std::nullopt);
  for (std::size_t tick = 0; tick < part.ticks; ++tick) {
    builder.addPose(track.tickTimesS()[tick], track.tracked()[tick]);
    const auto at = static_cast<std::uint32_t>(tick);
    if (tick > 0) builder.addStep(at - 1, at);
  }
  return builder.finish();
}

ViewSolid solidOf(const ShownTrack& track, const ShownPart& part) {
  ViewSolid solid;
  for (std::size_t tick = 0; tick < part.ticks; ++tick) {
    solid.timesS.push_back(track.tickTimesS()[tick]);
    solid.states.push_back(static_cast<std::uint16_t>(track.states()[tick]));
    solid.deviations.push_back(track.deviations()[tick]);
  }
  return solid;
}

}  // namespace

Result<ViewDocument> solidReport(const SolidSummary& summary, const ShownTrack& track,
                                 const SolidRequest& solid, const ReportOptions& options,
                                 const ReportProgress& progress) {
  const ReplayInputs& inputs = summary.inputs();
  const ReplayRequest& request = inputs.request;
  ViewDocument document;
  document.kind = ViewKind::Replay;
  document.title = fileName(request.motionPath) + " in " + fileName(request.scenePath) + ", solid";
  document.settings = solidSettings(inputs, solid);
  document.summary = solidRows(summary);
  document.notes = remarksOn(inputs);
  ViewAvatar avatar;
  avatar.name = fileName(request.avatarPath);
  avatar.avatar = &inputs.avatar;
  TrackBuilder builder(inputs.avatar, std::nullopt);
  const ShownPart part = partOf(track, builder, options);
  if (part.ticks < track.tickTimesS().size()) {
    document.notes.push_back(
        fmt::format("The report shows the first {} of {} ticks; the results file has them all.",
                    part.ticks, track.tickTimesS().size()));
  }
  avatar.track = shownTrackOf(track, part, builder, progress);
  const Eigen::AlignedBox3d action = builder.box();
  avatar.tracked = trackedTrackOf(inputs, track, part);
  avatar.solid = solidOf(track, part);
  for (std::size_t i = 0; i < part.contacts; ++i) {
    avatar.contacts.push_back(track.contacts()[i]);
    avatar.pushes.push_back({track.contacts()[i].push, track.contacts()[i].slipSpeed});
  }
  document.avatars.push_back(std::move(avatar));
  std::vector<Touch> touches;
  for (const ShownTouchOf& touch : track.touches()) {
    if (touch.first < part.contacts) touches.push_back(touch.touch);
  }
  addTouches(touches, 0, document);
  addScene(inputs.scene, request.scenePath, options.maxTriangles, action, document);
  return document;
}

}  // namespace foretouch::tools
