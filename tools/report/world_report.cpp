#include "tools/report/world_report.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "lss/fit.h"
#include "lss/index.h"
#include "tools/report/track_builder.h"

namespace foretouch::tools {
namespace {

/// For bounds; nothing of it is shown.
Avatar standInOf(const BodyShape& shape) {
  std::vector<Eigen::Vector3d> points;
  for (const Triangle& triangle : *shape.triangles) {
    points.insert(points.end(), triangle.vertices.begin(), triangle.vertices.end());
  }
  return Avatar::build(shape.skeleton, {{fitLss(points)}}).value();
}

/// The poses of a body in time, and between which of them its motion is known or taken to be.
class BodyTrack {
 public:
  BodyTrack(const LoadedWorld& world, BodyId body, const Avatar& shownAs,
            const std::vector<const BodyStretches*>& stretches)
      : world_(world),
        id_(body),
        body_(world.bodies[slotOf(body)]),
        places_(stretches),
        builder_(shownAs, std::nullopt) {}

  /// Returns whether there was room for all.
  bool addAll(std::size_t mostPoses) {
    for (std::size_t i = 0; i < body_.stretches.size(); ++i) {
      const bool isLast = i + 1 == body_.stretches.size();
      const std::int64_t endUs =
          isLast ? world_.endUs : std::min(world_.endUs, body_.stretches[i + 1].beginUs - 1);
      if (!addStretch(body_.stretches[i], endUs, mostPoses)) return false;
    }
    return true;
  }

  [[nodiscard]] const TrackBuilder& builder() const { return builder_; }
  [[nodiscard]] ViewTrack finish() { return builder_.finish(); }

 private:
  bool addStretch(const BodyStretch& stretch, std::int64_t endUs, std::size_t mostPoses) {
    const Track& track = stretch.track;
    const bool goesOn =
        stretch.isHeldFast() || world_.file.bodies[slotOf(id_)].whenSilent == WhenSilent::HoldStill;
    const std::int64_t knownUs = goesOn ? endUs : std::min(endUs, track.knownUntilUs());
    if (knownUs < track.knownFromUs()) return true;  // it appears later than the page ends
    std::set<std::int64_t> instants{track.knownFromUs(), knownUs};
    addKnots(id_, track.knownFromUs(), knownUs, 0, instants);
    bool isFirst = true;
    for (const std::int64_t us : instants) {
      if (builder_.poses() >= mostPoses) return false;
      builder_.addPose(LoadedWorld::secondsOf(us), places_.poseAt(id_, us));
      const auto pose = static_cast<std::uint32_t>(builder_.poses()) - 1;
      if (!isFirst) builder_.addStep(pose - 1, pose);
      isFirst = false;
    }
    return true;
  }

  /// The body's own in [fromUs, untilUs]; while it is held fast, those of who holds it: its steps
  /// are then theirs.
  void addKnots(BodyId body, std::int64_t fromUs, std::int64_t untilUs, int depth,
                std::set<std::int64_t>& instants) const {
    constexpr int kDeepest = 16;  // who is carried by more than so many has longer steps
    const BodyStretches& stretches = world_.bodies[slotOf(body)].stretches;
    for (std::size_t i = 0; i < stretches.size(); ++i) {
      const std::int64_t endUs = i + 1 < stretches.size() ? stretches[i + 1].beginUs : untilUs;
      const std::int64_t firstUs = std::max(fromUs, stretches[i].beginUs);
      const std::int64_t lastUs = std::min(untilUs, endUs);
      if (lastUs <= firstUs) continue;
      if (stretches[i].isHeldFast()) {
        if (depth < kDeepest) {
          addKnots(stretches[i].carrier->body, firstUs, lastUs, depth + 1, instants);
        }
        continue;
      }
      const Track& track = stretches[i].track;
      for (std::int64_t us = track.nextKnotUs(firstUs); us < lastUs; us = track.nextKnotUs(us)) {
        instants.insert(us);
      }
    }
  }

  const LoadedWorld& world_;
  BodyId id_;
  const LoadedBody& body_;
  BodyPlaces places_;
  TrackBuilder builder_;
};

std::vector<ViewCarried> carriedOf(const BodyStretches& stretches) {
  std::vector<ViewCarried> carried;
  for (std::size_t i = 0; i < stretches.size(); ++i) {
    if (!stretches[i].carrier) continue;
    ViewCarried& one = carried.emplace_back();
    one.fromS = LoadedWorld::secondsOf(stretches[i].beginUs);
    if (i + 1 < stretches.size()) one.untilS = LoadedWorld::secondsOf(stretches[i + 1].beginUs);
    one.avatar = slotOf(stretches[i].carrier->body);
    one.link = stretches[i].carrier->link;
  }
  return carried;
}

/// Of two: the one whose contact it is told as. What has several links is told of first.
bool isToldOfOther(const LoadedWorld& world, BodyId a, BodyId b) {
  if (b == kStillScene || a == b) return false;
  const auto links = [&](BodyId body) {
    return world.bodies[slotOf(body)].shape.skeleton.numJoints();
  };
  return links(a) == 1 && links(b) > 1;
}

std::string labelOf(const LoadedWorld& world, BodyId body, LinkId link) {
  const std::string name = world.linkNameOf(body, link);
  return name.empty() ? world.nameOf(body) : world.nameOf(body) + ": " + name;
}

/// The step of a track that covers an instant; nothing if none does.
std::optional<std::size_t> stepAt(const ViewTrack& track, double timeS) {
  const auto begins = [&](double time, std::uint32_t from) {
    return time < track.poseTimesS[from];
  };
  const auto after = std::upper_bound(track.stepFrom.begin(), track.stepFrom.end(), timeS, begins);
  if (after == track.stepFrom.begin()) return std::nullopt;
  const auto step = static_cast<std::size_t>(after - track.stepFrom.begin()) - 1;
  // A microsecond before a change of carrier a track has its last pose.
  constexpr double kGapS = 2.0 / kUsPerS;
  if (timeS > track.poseTimesS[track.stepTo[step]] + kGapS) return std::nullopt;
  return step;
}

/// As a row of the body that it is told of; nothing if its track has no step there.
std::optional<ReportedContact> rowOf(const LoadedWorld& world, const WorldContact& contact,
                                     const ViewTrack& track) {
  const bool isTurned = isToldOfOther(world, contact.a.body, contact.b.body);
  const ContactSide& own = isTurned ? contact.b : contact.a;
  const ContactSide& other = isTurned ? contact.a : contact.b;
  ReportedContact row;
  row.timeS = (static_cast<double>(contact.time.us) + contact.time.fraction) / kUsPerS;
  const auto step = stepAt(track, row.timeS);
  if (!step) return std::nullopt;
  const double fromS = track.poseTimesS[track.stepFrom[*step]];
  const double toS = track.poseTimesS[track.stepTo[*step]];
  row.step = static_cast<std::int64_t>(*step);
  LinkContact& seen = row.contact;
  seen.link = own.link;
  seen.verdict = contact.verdict;
  seen.reason = contact.reason;
  seen.toi = seen.freeUntil = std::clamp((row.timeS - fromS) / (toS - fromS), 0.0, 1.0);
  seen.separation = contact.separation;
  seen.penetration = contact.penetration;
  seen.p_WLink = own.p_W;
  seen.p_WScene = other.p_W;
  seen.nhat_SL_W = isTurned ? Eigen::Vector3d(-contact.nhat_BA_W) : contact.nhat_BA_W;
  if (other.body == kStillScene) {
    seen.triangle = other.triangle;
    if (other.triangle >= 0) {
      row.object = world.scene->objectNames()[slotOf(world.scene->object(other.triangle))];
    }
    return row;
  }
  row.other = other.link;
  row.otherBody = other.body == own.body ? -1 : other.body;
  row.object = labelOf(world, other.body, other.link);
  return row;
}

std::vector<ViewRow> settingsOf(const LoadedWorld& world) {
  std::vector<ViewRow> rows{{"world", fileName(world.file.path), ""}};
  if (world.scene) {
    for (ViewRow& row : sceneSettings(world.file.scene)) rows.push_back(std::move(row));
  }
  rows.push_back({"tolerance", fmt::format("{:g} m", world.file.tolerance), ""});
  for (std::size_t i = 0; i < world.numBodies(); ++i) {
    const FileBody& body = world.file.bodies[i];
    std::string text = madeOf(body.shape);
    for (const std::string& path : {fileOf(body.shape), body.clip.motionPath, body.posesPath}) {
      if (!path.empty()) text += ", " + fileName(path);
    }
    if (body.massKg) text += fmt::format(", {:g} kg", *body.massKg);
    rows.push_back({body.name, text, ""});
  }
  return rows;
}

std::vector<ViewRow> rowsOf(const WorldSummary& summary) {
  const auto text = [](std::int64_t number) { return std::to_string(number); };
  const WorldTouchCounts& touches = summary.touches();
  std::vector<ViewRow> rows{
      {"touches of two bodies", text(touches.bodies),
       "from a first contact of two links to where it ends"},
      {"touches with the scene", text(touches.scene), ""},
      {"touches of own links", text(touches.own), ""},
      {"touches missed", text(touches.missed),
       "of these: nothing touches where a window begins or ends"},
      {"windows", text(summary.windows()), ""},
      {"windows with contact", text(summary.windowsWithContact()), ""},
      {"contacts", text(summary.total().contacts), ""},
      {"starts in contact", text(summary.total().startsInContact), ""},
      {"undecided", text(summary.total().undecided), ""},
      {"latency of a window",
       fmt::format("p50 {:.1f} us, p99 {:.1f} us", summary.latencyUs(0.5), summary.latencyUs(0.99)),
       "the query, over all bodies"}};
  if (summary.assumed() > 0) {
    rows.push_back({"assumed", text(summary.assumed()),
                    "contacts that rest on a silent body that is taken to hold still"});
  }
  return rows;
}

using TouchKey = std::tuple<BodyId, LinkId, BodyId, LinkId, std::string>;

/// Where contacts are left out for want of room, so are the touches that have none.
void leaveOutBareTouches(std::vector<ViewTouch>& touches) {
  touches.erase(std::remove_if(touches.begin(), touches.end(),
                               [](const ViewTouch& touch) { return touch.rows.empty(); }),
                touches.end());
}

}  // namespace

WorldReport::WorldReport(const LoadedWorld& world, ReportOptions options)
    : world_(world), options_(std::move(options)) {
  for (const LoadedBody& body : world.bodies) {
    shownAs_.push_back(body.shape.avatar ? *body.shape.avatar : standInOf(body.shape));
  }
}

void WorldReport::add(const WorldStep& step) {
  for (const WorldContact& contact : step.answer.contacts) {
    if (contact.a.link == kEveryLink || kept_.size() >= options_.maxContacts) {
      ++numLeftOut_;
      continue;
    }
    kept_.push_back({contact, step.window});
  }
}

void WorldReport::addBodies(ViewDocument& document, Eigen::AlignedBox3d& action,
                            const ReportProgress& progress) const {
  const std::vector<const BodyStretches*> stretches = world_.stretches();
  const auto count = static_cast<std::int64_t>(world_.numBodies());
  for (BodyId id = 0; id < count; ++id) {
    if (!progress(id, count)) return;
    const LoadedBody& body = world_.bodies[slotOf(id)];
    const Avatar& shownAs = shownAs_[slotOf(id)];
    ViewAvatar& view = document.avatars.emplace_back();
    view.id = id;
    view.name = world_.nameOf(id);
    view.avatar = &shownAs;
    view.hasLss = !body.isMesh();
    view.knowsMissed = false;
    if (body.isMesh()) {
      view.meshes = linkMeshes({*body.shape.triangles}, document.notes);
    }
    BodyTrack track(world_, id, shownAs, stretches);
    const std::size_t room =
        track.builder().capacity(options_.maxRotations / static_cast<std::size_t>(count));
    if (!track.addAll(room)) {
      document.notes.push_back(fmt::format("Of {} the report shows the first {} poses.", view.name,
                                           track.builder().poses()));
    }
    view.carried = carriedOf(body.stretches);
    if (view.carried.empty()) action.extend(track.builder().box());
    view.track = track.finish();
  }
}

void WorldReport::addFound(const WorldTouches& touches, ViewDocument& document) const {
  std::vector<ViewTouch>& shown = document.touches.emplace();
  std::map<TouchKey, std::vector<std::size_t>> ofKey;          // places in `shown`, by begin
  std::vector<std::pair<std::int64_t, std::int64_t>> windows;  // of each that is shown
  for (const Touch& touch : touches.listed()) {
    const TouchSides sides = touches.sidesOf(touch);
    const bool isTurned = isToldOfOther(world_, sides.a, sides.b);
    ViewTouch view{slotOf(isTurned ? sides.b : sides.a), touch, {}, std::nullopt};
    view.touch.link = isTurned ? sides.linkOfB : sides.linkOfA;
    if (sides.b != kStillScene) {
      const BodyId other = isTurned ? sides.a : sides.b;
      view.touch.other = isTurned ? sides.linkOfA : sides.linkOfB;
      view.touch.object = labelOf(world_, other, view.touch.other);
      if (sides.a != sides.b) view.otherAvatar = slotOf(other);
    }
    const ViewTrack& track = *document.avatars[view.avatar].track;
    const auto first = stepAt(track, touch.beginS), last = stepAt(track, touch.endS);
    if (!first || !last) continue;
    view.touch.firstStep = static_cast<std::int64_t>(*first);
    view.touch.lastStep = static_cast<std::int64_t>(*last);
    ofKey[{sides.a, sides.linkOfA, sides.b, sides.linkOfB,
           sides.b == kStillScene ? touch.object : std::string()}]
        .push_back(shown.size());
    windows.emplace_back(touch.firstStep, touch.lastStep);
    shown.push_back(std::move(view));
  }
  for (const Kept& kept : kept_) {
    const WorldContact& contact = kept.contact;
    const bool isTurned = isToldOfOther(world_, contact.a.body, contact.b.body);
    ViewAvatar& avatar = document.avatars[slotOf(isTurned ? contact.b.body : contact.a.body)];
    auto row = rowOf(world_, contact, *avatar.track);
    if (!row) continue;
    const bool isOfScene = contact.b.body == kStillScene;
    const auto found =
        ofKey.find({contact.a.body, contact.a.link, contact.b.body, isOfScene ? 0 : contact.b.link,
                    isOfScene ? row->object : std::string()});
    avatar.contacts.push_back(std::move(*row));
    if (found == ofKey.end() || contact.verdict == Verdict::Undecided) continue;
    for (const std::size_t place : found->second) {
      if (kept.window < windows[place].first || kept.window > windows[place].second) continue;
      shown[place].rows.push_back(static_cast<std::uint32_t>(avatar.contacts.size()) - 1);
      break;
    }
  }
}

ViewDocument WorldReport::document(const WorldSummary* summary, const WorldTouches* touches,
                                   const ReportProgress& progress) const {
  ViewDocument document;
  document.kind = ViewKind::World;
  document.title = fileName(world_.file.path);
  document.settings = settingsOf(world_);
  document.notes = world_.remarks;
  if (summary != nullptr) document.summary = rowsOf(*summary);
  Eigen::AlignedBox3d action;
  addBodies(document, action, progress);
  if (document.avatars.size() < world_.numBodies()) return document;  // interrupted
  if (touches != nullptr) addFound(*touches, document);
  if (numLeftOut_ > 0) {
    if (document.touches) leaveOutBareTouches(*document.touches);
    document.notes.push_back(fmt::format(
        "{} contacts are not shown, for want of room or of a link; the results file has them all.",
        numLeftOut_));
  }
  if (world_.scene) {
    addScene(*world_.scene, world_.file.scene.scenePath, options_.maxTriangles, action, document);
  }
  return document;
}

}  // namespace foretouch::tools
