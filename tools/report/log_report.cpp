#include "tools/report/log_report.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "tools/microseconds.h"
#include "tools/report/view_touches.h"

namespace foretouch::tools {
namespace {

/// Between a timeline and one moved behind it.
constexpr double kPauseS = 1.0;

std::vector<ViewRow> rowsOf(const LogReplayReport& report, const LogReplaySummary& summary) {
  const auto text = [](std::int64_t number) { return std::to_string(number); };
  const LogReplaySummary::Counts& total = summary.total();
  std::int64_t refused = 0;
  for (const std::uint64_t count : report.rejects) refused += static_cast<std::int64_t>(count);
  std::vector<ViewRow> rows{
      {"poses", text(report.poses), ""},
      {"answered", text(report.answers), ""},
      {"refused", text(refused), "poses and skeletons"},
      {"timelines", text(report.timelines), ""},
      {"lost poses", text(report.lost), fmt::format("in {} gaps", report.gaps)},
      {"contacts", text(total.contacts), ""},
      {"starts in contact", text(total.startsInContact), ""},
      {"undecided", text(total.undecided), ""},
      {"latency of a query",
       fmt::format("p50 {:.1f} us, p99 {:.1f} us", summary.queryUs(0.5), summary.queryUs(0.99)),
       ""}};
  if (report.journal.hasRecord()) {
    rows.push_back({"verdicts equal to the log's", text(report.journal.equal()),
                    fmt::format("of {} recorded, byte for byte", report.journal.recorded())});
  }
  return rows;
}

}  // namespace

LogReport::Player::Player(const Avatar& avatar, const LogReplayInputs& inputs,
                          const QueryOptions& options)
    : surface(options.surface),
      track(avatar, touchQuestion(avatar, inputs.scene, options)),
      ground(avatar, inputs.scene, inputs.request.world.ground) {}

LogReport::LogReport(const LogReplayInputs& inputs, const ReportOptions& options)
    : inputs_(inputs), options_(options), players_(inputs.avatars.size()) {}

LogReport::Player& LogReport::playerOf(const AnsweredPose& answered) {
  std::unique_ptr<Player>& player = players_[answered.avatar];
  if (!player) {
    player = std::make_unique<Player>(inputs_.avatars[answered.avatar], inputs_, answered.query);
  }
  return *player;
}

/// Each avatar has its share, so that one cannot take all room.
bool LogReport::hasRoom(const Player& player) const {
  return player.leftOut == 0 &&
         player.track.poses() < player.track.capacity(options_.maxRotations / players_.size()) &&
         player.contacts.size() < options_.maxContacts / players_.size();
}

void LogReport::add(const AnsweredPose& answered) {
  Player& player = playerOf(answered);
  if (!hasRoom(player)) {
    ++player.leftOut;
    return;
  }
  if (!beginUs_) beginUs_ = answered.step.utimeToUs;
  const double sinceBeginS = static_cast<double>(answered.step.utimeToUs - *beginUs_) / kUsPerS;
  double timeS = sinceBeginS + player.shiftS;
  if (player.track.poses() > 0 && !(timeS > player.track.lastTimeS())) {
    timeS = player.track.lastTimeS() + kPauseS;
    player.shiftS = timeS - sinceBeginS;
    ++player.moved;
  }
  player.track.addPose(timeS, *answered.step.to);
  addStep(answered, player);
}

void LogReport::addStep(const AnsweredPose& answered, Player& player) {
  if (answered.step.kind == StepKind::AcrossGap) {
    for (const AnsweredContact& found : answered.answer.contacts) {
      player.acrossGaps += found.contact.verdict == Verdict::Contact ? 1 : 0;
    }
  }
  // The step that begins at a timeline's first pose shows that pose's touches as starting in
  // contact.
  if (answered.step.kind != StepKind::Consecutive) return;
  const auto to = static_cast<std::uint32_t>(player.track.poses() - 1);
  const std::uint32_t from = to - 1;
  const auto step = static_cast<std::uint32_t>(player.track.steps());
  const double t0S = player.track.timeS(from), t1S = player.track.timeS(to);
  player.track.addStep(from, to, answered.answer.queryUs);
  if (from != player.lastTo) player.tracker.breakOff(player.touches);
  player.lastTo = to;
  const std::size_t firstRow = player.contacts.size();
  for (const AnsweredContact& found : answered.answer.contacts) {
    ReportedContact view = contactView(found.contact, inputs_.scene, step, t0S, t1S);
    const LinkId link = found.contact.link;
    view.missedByPoses = found.contact.verdict == Verdict::Contact &&
                         !player.track.touches(from, link) && !player.track.touches(to, link);
    player.contacts.push_back(std::move(view));
  }
  track(answered, firstRow, player);
}

/// The touches of the step whose contacts begin at `firstRow`.
void LogReport::track(const AnsweredPose& answered, std::size_t firstRow, Player& player) const {
  const ChainMotion motion(inputs_.avatars[answered.avatar].skeleton(), *answered.step.from,
                           *answered.step.to);
  player.ground.beginStep(motion);
  TouchStep step;
  step.step = static_cast<std::int64_t>(player.track.steps()) - 1;
  for (std::size_t i = firstRow; i < player.contacts.size(); ++i) {
    const ReportedContact& found = player.contacts[i];
    TouchRow& row = step.rows.emplace_back();
    row.contact = &found.contact;
    row.object = found.object;
    row.timeS = found.timeS;
    row.isMissed = found.missedByPoses;
    row.isGround = player.ground.isGround(found.contact);
  }
  std::vector<std::size_t> begun;
  player.tracker.addStep(step, player.touches, begun);
}

/// The touches without those of the ground if these are ignored.
std::vector<Touch> LogReport::listed(const std::vector<Touch>& touches) const {
  std::vector<Touch> kept;
  const bool isIgnored = inputs_.request.world.ground.use == GroundUse::Ignore;
  std::copy_if(touches.begin(), touches.end(), std::back_inserter(kept),
               [&](const Touch& touch) { return !isIgnored || !touch.isGround; });
  return kept;
}

ViewAvatar LogReport::avatarOf(std::size_t index, double fromS, ViewDocument& document) {
  const NumberedAvatar& numbered = inputs_.request.avatars[index];
  ViewAvatar view;
  view.id = numbered.id;
  view.name = fileName(numbered.path);
  view.avatar = &inputs_.avatars[index];
  Player& player = *players_[index];
  if (player.surface) {
    view.meshes = linkMeshes(trianglesOf(*player.surface), document.notes);
  }
  view.track = player.track.finish();
  view.contacts = std::move(player.contacts);
  for (double& timeS : view.track->poseTimesS) timeS -= fromS;
  for (ReportedContact& contact : view.contacts) contact.timeS -= fromS;
  player.tracker.breakOff(player.touches);
  for (Touch& touch : player.touches) {
    touch.beginS -= fromS;
    touch.endS -= fromS;
  }
  return view;
}

void LogReport::noteWhatIsMissing(std::vector<std::string>& notes) const {
  for (std::size_t i = 0; i < players_.size(); ++i) {
    const std::int32_t id = inputs_.request.avatars[i].id;
    if (!players_[i]) {
      notes.push_back(fmt::format("No pose of avatar {} was answered.", id));
      continue;
    }
    const Player& player = *players_[i];
    if (player.leftOut > 0) {
      notes.push_back(fmt::format(
          "Of avatar {} the report shows the first {} of {} answered poses; the results file has "
          "them all.",
          id, player.track.poses(),
          player.leftOut + static_cast<std::int64_t>(player.track.poses())));
    }
    if (player.moved > 0) {
      notes.push_back(fmt::format(
          "{} timelines of avatar {} begin before the one before has ended: they are shown behind "
          "it.",
          player.moved, id));
    }
    if (player.acrossGaps > 0) {
      notes.push_back(fmt::format(
          "{} contacts of avatar {} across lost poses are in the results file alone: what happened "
          "in between is not known, and not drawn.",
          player.acrossGaps, id));
    }
  }
}

std::vector<ViewRow> LogReport::settings() const {
  const LogReplayRequest& request = inputs_.request;
  std::vector<ViewRow> rows = sceneSettings(request.world);
  rows.push_back({"log", fileName(request.logPath), ""});
  for (const NumberedAvatar& avatar : request.avatars) {
    rows.push_back({fmt::format("avatar {}", avatar.id), fileName(avatar.path), ""});
  }
  for (ViewRow& row : querySettings(request.world)) rows.push_back(std::move(row));
  return rows;
}

ViewDocument LogReport::document(const LogReplayReport& report, const LogReplaySummary& summary,
                                 const ReportProgress& progress) {
  const LogReplayRequest& request = inputs_.request;
  ViewDocument document;
  document.kind = ViewKind::Log;
  document.title = fileName(request.logPath) + " in " + fileName(request.world.scenePath);
  document.settings = settings();
  document.summary = touchRows(summary.touches(), false);
  for (ViewRow& row : rowsOf(report, summary)) document.summary.push_back(std::move(row));
  document.notes = report.remarks;
  noteFidelity(request.world.query.fidelity, document.notes);
  noteGround(summary.touches(), request.world.ground, document.notes);
  noteWhatIsMissing(document.notes);
  double fromS = std::numeric_limits<double>::infinity();
  Eigen::AlignedBox3d action;
  for (const auto& player : players_) {
    if (!player) continue;
    fromS = std::min(fromS, player->track.timeS(0));
    action.extend(player->track.box());
  }
  for (std::size_t i = 0; i < players_.size(); ++i) {
    if (!players_[i]) continue;
    document.avatars.push_back(avatarOf(i, fromS, document));
    addTouches(listed(players_[i]->touches), document.avatars.size() - 1, document);
  }
  addScene(inputs_.scene, request.world.scenePath, options_.maxTriangles, action, document);
  addSwept({}, document, progress);
  return document;
}

}  // namespace foretouch::tools
