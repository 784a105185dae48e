#include "tools/report/world_report.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "lss/index.h"
#include "tools/report/body_track.h"
#include "tools/world/outline.h"

namespace foretouch::tools {
namespace {

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

/// True if a contact of two is reported as b's. The body with several links comes first.
bool isToldOfOther(const LoadedWorld& world, BodyId a, BodyId b) {
  if (b == kStillScene || a == b) return false;
  const auto links = [&](BodyId body) {
    return world.bodies[slotOf(body)].shape.skeleton.numJoints();
  };
  return links(a) == 1 && links(b) > 1;
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

/// The contact as a row of the body that reports it; nothing if its track has no step there.
std::optional<ReportedContact> rowOf(const LoadedWorld& world, const WorldContact& contact,
                                     const ViewTrack& track) {
  const bool isTurned = isToldOfOther(world, contact.a.body, contact.b.body);
  const ContactSide& own = isTurned ? contact.b : contact.a;
  const ContactSide& other = isTurned ? contact.a : contact.b;
  ReportedContact row;
  row.timeS = LoadedWorld::secondsOf(contact.time);
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
  row.object = world.labelOf(other.body, other.link);
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

/// Nothing if the track of the body that reports it has no steps there.
std::optional<ViewTouch> viewOf(const LoadedWorld& world, const WorldTouch& touch,
                                const TouchSides& sides, const ViewDocument& document) {
  const bool isTurned = isToldOfOther(world, sides.a, sides.b);
  ViewTouch view{slotOf(isTurned ? sides.b : sides.a), touch, {}};
  view.strength = touch.strength;
  view.touch.link = isTurned ? sides.linkOfB : sides.linkOfA;
  if (sides.b != kStillScene) {
    const BodyId other = isTurned ? sides.a : sides.b;
    view.touch.other = isTurned ? sides.linkOfA : sides.linkOfB;
    view.touch.object = world.labelOf(other, view.touch.other);
    if (sides.a != sides.b) view.otherAvatar = slotOf(other);
  }
  const ViewTrack& track = *document.avatars[view.avatar].track;
  const auto first = stepAt(track, touch.beginS), last = stepAt(track, touch.endS);
  if (!first || !last) return std::nullopt;
  view.touch.firstStep = static_cast<std::int64_t>(*first);
  view.touch.lastStep = static_cast<std::int64_t>(*last);
  return view;
}

/// The latest of those at these places, by begin, that goes on at this time; null: none.
ViewTouch* touchAt(std::vector<ViewTouch>& shown, const std::vector<std::size_t>& places,
                   double timeS) {
  const auto begins = [&](double time, std::size_t place) {
    return time < shown[place].touch.beginS;
  };
  auto after = std::upper_bound(places.begin(), places.end(), timeS, begins);
  while (after != places.begin()) {
    ViewTouch& touch = shown[*--after];
    if (timeS <= touch.touch.endS) return &touch;
  }
  return nullptr;
}

void addEventRows(const WorldIntervals& followed, std::vector<ViewRow>& rows) {
  const auto& told = followed.counts();
  const auto text = [](const std::int64_t(&counts)[kNumEventKinds], EventKind kind) {
    return std::to_string(counts[slotOf(kind)]);
  };
  rows.push_back({"enters", text(told.ofContacts, EventKind::Enter),
                  "two were free, and are in contact from then on"});
  rows.push_back({"leaves", text(told.ofContacts, EventKind::Leave), ""});
  rows.push_back({"starts inside", text(told.ofContacts, EventKind::StartsInside),
                  "in contact where the two are known first"});
  if (!followed.stays().empty()) {
    rows.push_back({"triggers entered", text(told.ofTriggers, EventKind::Enter), ""});
    rows.push_back({"triggers left", text(told.ofTriggers, EventKind::Leave), ""});
  }
}

using TouchKey = std::tuple<BodyId, LinkId, BodyId, LinkId, std::string>;

/// Where contacts are left out for lack of room, so are the touches that have none.
void leaveOutBareTouches(std::vector<ViewTouch>& touches) {
  touches.erase(std::remove_if(touches.begin(), touches.end(),
                               [](const ViewTouch& touch) { return touch.rows.empty(); }),
                touches.end());
}

}  // namespace

Result<WorldReport> WorldReport::make(const LoadedWorld& world, ReportOptions options,
                                      const WorldIntervals* followed) {
  std::vector<Avatar> shownAs;
  for (std::size_t i = 0; i < world.bodies.size(); ++i) {
    const BodyShape& shape = world.bodies[i].shape;
    const FileBody& file = world.file.bodies[i];
    const auto refused = [&](const Error& error) {
      return Error::inLine(
          world.file.path, file.line, error.code,
          fmt::format("{} {}: {}", file.title(), inQuotes(file.name), error.message));
    };
    FORETOUCH_TRY_OR(refused, auto avatar,
                     shape.avatar ? Result<Avatar>(*shape.avatar) : standInOf(shape));
    shownAs.push_back(std::move(avatar));
  }
  return WorldReport(world, std::move(options), followed, std::move(shownAs));
}

void WorldReport::add(const WorldStep& step) {
  for (const WorldContact& contact : step.answer.contacts) {
    if (contact.a.link == kEveryLink || kept_.size() >= options_.maxContacts) {
      ++numLeftOut_;
      continue;
    }
    if (followed_ != nullptr && contact.verdict == Verdict::Contact) continue;
    kept_.push_back(contact);
  }
}

void WorldReport::addBodies(ViewDocument& document, Eigen::AlignedBox3d& action,
                            const ReportProgress& progress) const {
  const std::vector<const BodyStretches*> stretches = world_.stretches();
  const auto count = static_cast<std::int64_t>(world_.bodies.size());
  for (BodyId id = 0; id < count; ++id) {
    if (!progress(id, count)) return;
    const LoadedBody& body = world_.bodies[slotOf(id)];
    const Avatar& shownAs = shownAs_[slotOf(id)];
    ViewAvatar& view = document.avatars.emplace_back();
    view.id = id;
    view.name = world_.nameOf(id);
    view.avatar = &shownAs;
    const bool isTrigger = world_.isTrigger(id);
    view.hasLss = !body.isMesh() && !isTrigger;
    view.knowsMissed = false;
    if (isTrigger) {
      for (const Eigen::Vector3d& point : outlineOf(body.shape)) {
        for (const double x : point) view.outline.push_back(static_cast<float>(x));
      }
    } else if (body.isMesh()) {
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
    if (view.carried.empty() && !isTrigger) action.extend(track.builder().box());
    view.track = track.finish();
  }
}

std::size_t WorldReport::addFound(const WorldTouches& touches, ViewDocument& document) const {
  std::vector<ViewTouch>& shown = document.touches.emplace();
  std::map<TouchKey, std::vector<std::size_t>> ofKey;  // places in `shown`, by begin
  std::vector<const WorldContact*> found;
  for (const WorldTouch& touch : touches.listed()) {
    const TouchSides sides = touches.sidesOf(touch);
    auto view = viewOf(world_, touch, sides, document);
    if (!view) continue;
    if (touch.strength) found.push_back(&touch.first);
    ofKey[{sides.a, sides.linkOfA, sides.b, sides.linkOfB,
           sides.b == kStillScene ? touch.object : std::string()}]
        .push_back(shown.size());
    shown.push_back(std::move(*view));
  }
  for (const WorldContact& contact : kept_) found.push_back(&contact);
  std::stable_sort(found.begin(), found.end(),
                   [](const WorldContact* x, const WorldContact* y) { return x->time < y->time; });
  const std::size_t numLeftOut = found.size() - std::min(found.size(), options_.maxContacts);
  found.resize(found.size() - numLeftOut);
  for (const WorldContact* contact : found) {
    const bool isTurned = isToldOfOther(world_, contact->a.body, contact->b.body);
    ViewAvatar& avatar = document.avatars[slotOf(isTurned ? contact->b.body : contact->a.body)];
    auto row = rowOf(world_, *contact, *avatar.track);
    if (!row) continue;
    const double timeS = row->timeS;
    const bool isOfScene = contact->b.body == kStillScene;
    const auto places =
        ofKey.find({contact->a.body, contact->a.link, contact->b.body,
                    isOfScene ? 0 : contact->b.link, isOfScene ? row->object : std::string()});
    ViewTouch* const touch = places == ofKey.end() || contact->verdict == Verdict::Undecided
                                 ? nullptr
                                 : touchAt(shown, places->second, timeS);
    // Where a touch starts inside, a window says so, too: what it begins with is there already.
    const bool isSaidTwice =
        touch != nullptr && touch->strength && !touch->rows.empty() && timeS == touch->touch.beginS;
    if (isSaidTwice) continue;
    avatar.contacts.push_back(std::move(*row));
    if (touch == nullptr) continue;
    touch->rows.push_back(static_cast<std::uint32_t>(avatar.contacts.size()) - 1);
  }
  return numLeftOut;
}

/// Adds them as bars without contacts. A link that stands for all of a body's is its first one.
void WorldReport::addUnresolved(ViewDocument& document) const {
  for (const ContactInterval& interval : followed_->contacts()) {
    const WorldPart& part = interval.part;
    if (part.kind != PartKind::Unresolved || part.a.body < 0) continue;
    ViewTouch view{slotOf(part.a.body), {}, {}};
    view.touch.link = std::max(0, part.a.link);
    view.touch.object = part.b.body == kEveryBody    ? "everybody"
                        : part.b.body == kStillScene ? "the scene"
                                                     : world_.labelOf(part.b.body, part.b.link);
    view.touch.beginS = LoadedWorld::secondsOf(part.from);
    view.touch.endS = LoadedWorld::secondsOf(part.to);
    view.touch.isOpen = part.goesOn;
    view.unresolved = part.reason;
    document.touches->push_back(std::move(view));
  }
  std::stable_sort(
      document.touches->begin(), document.touches->end(),
      [](const ViewTouch& x, const ViewTouch& y) { return x.touch.beginS < y.touch.beginS; });
}

void WorldReport::addStays(ViewDocument& document) const {
  for (const TriggerStay& stay : followed_->stays()) {
    ViewStay& view = document.stays.emplace_back();
    view.trigger = slotOf(world_.triggers.body(stay.trigger));
    view.avatar = slotOf(stay.body);
    view.link = std::max(0, stay.link);
    view.beginS = LoadedWorld::secondsOf(stay.from);
    view.endS = LoadedWorld::secondsOf(stay.to);
    view.beginsInside = stay.startsInside;
    view.isOpen = stay.goesOn;
    view.isUnresolved = stay.isUnresolved;
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
  if (document.avatars.size() < world_.bodies.size()) return document;  // interrupted
  std::size_t numLeftOut = numLeftOut_;
  if (touches != nullptr) numLeftOut += addFound(*touches, document);
  if (numLeftOut > 0) {
    if (document.touches) leaveOutBareTouches(*document.touches);
    document.notes.push_back(fmt::format(
        "{} contacts are not shown, for want of room or of a link; the results file has them all.",
        numLeftOut));
  }
  if (followed_ != nullptr && touches != nullptr) {
    addUnresolved(document);
    addStays(document);
    addEventRows(*followed_, document.summary);
  }
  if (world_.scene) {
    addScene(*world_.scene, world_.file.scene.scenePath, options_.maxTriangles, action, document);
  }
  return document;
}

}  // namespace foretouch::tools
