#include "tools/report/replay_report.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "tools/report/view_feet.h"
#include "tools/report/view_touches.h"

namespace foretouch::tools {

ReplayReport::ReplayReport(const ReplayInputs& inputs, const ReportOptions& options)
    : inputs_(inputs),
      options_(options),
      track_(inputs.avatar, touchQuestion(inputs.avatar, inputs.scene, inputs.query)),
      mostSteps_(static_cast<std::int64_t>(track_.capacity(options.maxRotations)) - 1) {}

void ReplayReport::add(const ReplayedStep& step) {
  const StepAnswer& answer = step.answer;
  isFull_ = isFull_ || answer.step >= mostSteps_ ||
            contacts_.size() + shownOf(answer).size() + answer.pairs.size() > options_.maxContacts;
  if (isFull_) return;
  latenciesUs_.push_back(answer.latencyUs);
  for (const LinkContact& contact : shownOf(answer)) {
    ReportedContact view = contactView(contact, inputs_.scene, answer.step, answer.t0S, answer.t1S);
    view.missedByPoses =
        std::count(answer.missedByPoses.begin(), answer.missedByPoses.end(), contact.link) > 0;
    contacts_.push_back(std::move(view));
  }
  for (const PairContact& contact : answer.pairs) {
    contacts_.push_back(
        contactView(contact, inputs_.avatar.skeleton(), answer.step, answer.t0S, answer.t1S));
  }
}

const std::vector<LinkContact>& ReplayReport::shownOf(const StepAnswer& answer) const {
  return inputs_.query.scope == Scope::EveryObject ? answer.objects : answer.contacts;
}

Result<Done> ReplayReport::addTrack(const ReportProgress& progress) {
  const auto steps = static_cast<std::int64_t>(latenciesUs_.size());
  for (std::int64_t pose = 0; pose <= steps; ++pose) {
    if (!progress(pose, steps)) return Done{};
    FORETOUCH_TRY(const auto read, poseAtFrame(inputs_, inputs_.steps.frameOf(pose)));
    track_.addPose(inputs_.timeOfStep(pose), read);
  }
  for (std::int64_t step = 0; step < steps; ++step) {
    const auto from = static_cast<std::uint32_t>(step);
    track_.addStep(from, from + 1, latenciesUs_[from]);
  }
  return Done{};
}

std::vector<ViewRow> ReplayReport::settings() const {
  const ReplayRequest& request = inputs_.request;
  std::vector<ViewRow> rows = sceneSettings(request);
  rows.push_back({"avatar", fileName(request.avatarPath), ""});
  for (ViewRow& row : clipSettings(request)) rows.push_back(std::move(row));
  const double clipHz = 1.0 / inputs_.clip.frameTimeS;
  const double hz = clipHz / static_cast<double>(inputs_.steps.stride);
  rows.push_back({"rate", fmt::format("{:.5g} of {:.5g} poses a second", hz, clipHz), ""});
  for (ViewRow& row : querySettings(request)) rows.push_back(std::move(row));
  return rows;
}

std::vector<ViewRow> ReplayReport::rowsOf(const ReplaySummary& summary) {
  const auto& total = summary.total();
  const auto text = [](std::int64_t number) { return std::to_string(number); };
  std::vector<ViewRow> rows = touchRows(summary.touches(), summary.inputs().query.self.has_value());
  const std::vector<ViewRow> ofSteps{
      {"steps", text(summary.steps()), ""},
      {"steps with contact", text(summary.stepsWithContact()), ""},
      {"contacts", text(total.contacts), "of single steps: a touch has many, also of the ground"},
      {"missed by poses", text(total.missedByPoses),
       "of these contacts: they touch nothing at either pose of their step"},
      {"starts in contact", text(total.startsInContact), ""},
      {"undecided", text(total.undecided), ""},
      {"latency of a step",
       fmt::format("p50 {:.1f} us, p99 {:.1f} us", summary.latencyUs(0.5), summary.latencyUs(0.99)),
       "the query, from two poses to all verdicts"}};
  rows.insert(rows.end(), ofSteps.begin(), ofSteps.end());
  if (summary.inputs().query.scope == Scope::EveryObject) {
    const auto& ofObjects = summary.totalOfObjects();
    rows.push_back({"by object: contacts", text(ofObjects.contacts),
                    "the first contact of every link with every object"});
    rows.push_back({"by object: starts in contact", text(ofObjects.startsInContact), ""});
    rows.push_back({"by object: undecided", text(ofObjects.undecided), ""});
  }
  if (summary.inputs().query.self) {
    const PairRules& rules = *summary.inputs().query.self;
    const auto& own = summary.totalOfPairs();
    rows.push_back(
        {"own pairs asked", text(rules.numAsked()),
         fmt::format("of {} pairs of own links; nothing is said of the others", rules.numPairs())});
    rows.push_back({"steps with own contact", text(summary.stepsWithPairs()), ""});
    rows.push_back({"own contacts", text(own.contacts), ""});
    rows.push_back({"start in own contact", text(own.startsInContact), ""});
    rows.push_back({"own pairs undecided", text(own.undecided), ""});
  }
  return rows;
}

/// The touches of the kept steps. Nothing is known there of what follows them.
std::vector<Touch> ReplayReport::keptOf(const std::vector<Touch>& touches) const {
  const auto steps = static_cast<std::int64_t>(latenciesUs_.size());
  std::vector<Touch> kept;
  for (const Touch& touch : touches) {
    if (touch.firstStep >= steps) continue;
    kept.push_back(touch);
    if (touch.lastStep < steps) continue;
    kept.back().isOpen = true;
    kept.back().lastStep = steps - 1;
    kept.back().endS = inputs_.timeOfStep(steps);
  }
  return kept;
}

Result<ViewDocument> ReplayReport::document(const ReplaySummary& summary,
                                            const std::vector<Touch>& touches,
                                            const ReportProgress& progress) {
  FORETOUCH_CHECK(addTrack(progress));
  const ReplayRequest& request = inputs_.request;
  ViewDocument document;
  document.kind = ViewKind::Replay;
  document.title = fileName(request.motionPath) + " in " + fileName(request.scenePath);
  document.settings = settings();
  document.summary = rowsOf(summary);
  document.notes = remarksOn(inputs_);
  noteFidelity(request.query.fidelity, document.notes);
  noteGround(summary.touches(), request.ground, document.notes);
  if (isFull_) {
    document.notes.push_back(
        fmt::format("The report shows the first {} of {} steps; the results file has them all.",
                    latenciesUs_.size(), summary.steps()));
  }
  ViewAvatar avatar;
  avatar.name = fileName(request.avatarPath);
  avatar.avatar = &inputs_.avatar;
  if (inputs_.query.surface) {
    avatar.meshes = linkMeshes(trianglesOf(*inputs_.query.surface), document.notes);
  }
  const Eigen::AlignedBox3d action = track_.box();
  avatar.track = track_.finish();
  avatar.contacts = std::move(contacts_);
  document.avatars.push_back(std::move(avatar));
  addTouches(keptOf(touches), 0, document);
  if (isFull_) {
    for (ViewTouch& shown : *document.touches) {
      shown.touch.contacts = static_cast<std::int64_t>(shown.rows.size());
    }
  }
  document.frameTimeS = inputs_.clip.frameTimeS * static_cast<double>(inputs_.clip.framesPerRow);
  addFeet(inputs_, static_cast<std::int64_t>(latenciesUs_.size()), document);
  addScene(inputs_.scene, request.scenePath, options_.maxTriangles, action, document);
  addSwept({}, document, progress);
  return document;
}

}  // namespace foretouch::tools
