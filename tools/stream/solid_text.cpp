#include "tools/stream/solid_text.h"

#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "tools/contact_json.h"
#include "tools/microseconds.h"

namespace foretouch::tools {
namespace {

/// Beyond this many avatars, forgets the known ones.
constexpr std::size_t kMostShownAvatars = 4096;

/// The shortest text that reads back as the same bits: readers of JSON take "-0" for a whole 0.
void writeAllBits(double x, JsonWriter& out) {
  x == 0.0 && std::signbit(x) ? out.raw("-0.0") : out.value(x);
}

void writePoseOnWay(double time, const Pose& pose, JsonWriter& out) {
  out.beginObject();
  out.field("t", time);
  out.list("rotations", pose.rotations, [&](const Quaternion& q) {
    out.beginArray();
    for (const double x : {q.w(), q.x(), q.y(), q.z()}) writeAllBits(x, out);
    out.endArray();
  });
  out.list("translations", pose.translations, [&](const Eigen::Vector3d& p) {
    out.beginArray();
    for (const double x : p) writeAllBits(x, out);
    out.endArray();
  });
  out.endObject();
}

void writeShown(const ShownContact& shown, JsonWriter& out) {
  const SolidContact& contact = shown.contact;
  out.beginObject();
  out.field("link", shown.linkName);
  out.field("lss", contact.lss);
  if (contact.triangle >= 0) {
    out.field("object", shown.otherName);
    out.field("triangle", contact.triangle);
  } else {
    out.field("other", shown.otherName);
  }
  writePush(contact, out);
  out.endObject();
}

void writeWork(const SolidCounters& counters, JsonWriter& out) {
  out.key("counters");
  out.beginObject();
  out.field("queries", counters.queries);
  out.field("iterations", counters.iterations);
  out.field("features", counters.features);
  out.field("rows", counters.rows);
  out.field("around_queries", counters.aroundQueries);
  out.field("placing_queries", counters.placingQueries);
  out.field("work", counters.work);
  out.endObject();
}

/// "'LeftHand' on 'table'", each pair once.
std::string surfacesOf(const SolidMessage& message) {
  constexpr std::size_t kShown = 4;
  std::vector<std::string> pairs;
  for (const ShownContact& shown : message.contacts) {
    const std::string pair = inQuotes(shown.linkName) + " on " + inQuotes(shown.otherName);
    if (pairs.empty() || pairs.back() != pair) pairs.push_back(pair);  // in the order of links
  }
  std::string text;
  for (std::size_t i = 0; i < pairs.size() && i < kShown; ++i) {
    text += (i == 0 ? ": " : "; ") + pairs[i];
  }
  if (pairs.size() > kShown) text += fmt::format("; and {} more", pairs.size() - kShown);
  return text;
}

}  // namespace

void writeSolid(const SolidMessage& message, Stamps stamps, JsonWriter& out) {
  out.beginObject();
  out.field("avatar", message.avatar);
  out.field("session", message.session);
  out.field("sequence", message.sequence);
  out.field("utime", message.utimeUs);
  out.field("kind", toString(message.kind));
  out.field("lost", message.lost);
  out.field("step_us", message.stepUs);
  out.field("avatar_hash", hashText(message.avatarHash));
  out.field("skin", message.skin);
  out.field("tolerance", message.tolerance);
  out.field("catch_up", message.catchUp);
  out.field("work_budget", message.workBudget);
  out.field("state", toString(message.state));
  out.field("limit", toString(message.limit));
  out.field("certified", message.isCertified);
  if (message.hasAppeared) out.field("appeared", true);
  out.field("deviation", message.deviation);
  out.field("lift", message.lift);
  out.field("clearance", message.clearance);
  if (message.snapInUs >= 0) out.field("snap_in_us", message.snapInUs);
  out.key("way");
  out.beginArray();
  for (std::size_t i = 0; i < message.way.size(); ++i) {
    writePoseOnWay(message.times[i], message.way[i], out);
  }
  out.endArray();
  out.list("deviations", message.linkDeviation, [&](double value) { out.value(value); });
  out.list("joints", message.joints, [&](SolidJointState state) { out.value(toString(state)); });
  out.list("contacts", message.contacts,
           [&](const ShownContact& shown) { writeShown(shown, out); });
  if (message.contactsLeftOut > 0) out.field("contacts_left_out", message.contactsLeftOut);
  writeWork(message.counters, out);
  if (stamps == Stamps::With) {
    out.field("receive_utime", message.receiveUtimeUs);
    out.field("send_utime", message.sendUtimeUs);
    out.field("solid_us", message.solidUs);
  }
  out.endObject();
}

std::string solidLine(const SolidMessage& message, Stamps stamps) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.key("solid");
  writeSolid(message, stamps, out);
  out.endObject();
  return text + "\n";
}

std::string solidText(const SolidMessage& message) {
  constexpr double kMmPerM = 1e3;
  std::string text = fmt::format("avatar {}, pose {}: shown {}", message.avatar, message.sequence,
                                 toString(message.state));
  if (message.state == SolidState::Equal) {
    text += " to the tracked pose";
  } else if (message.state == SolidState::Placing) {
    text += ", no free place is found yet";
  } else {
    text += fmt::format(", {:.1f} mm from the tracked pose", kMmPerM * message.deviation);
  }
  if (message.limit != SolidLimit::None) text += fmt::format(" ({})", toString(message.limit));
  if (!message.isCertified && message.state != SolidState::Placing) text += ", not certified";
  if (message.snapInUs >= 0) {
    text += fmt::format(", snaps in {:.2f} s", static_cast<double>(message.snapInUs) / kUsPerS);
  }
  return text + surfacesOf(message) + "\n";
}

bool SolidNews::isNews(const SolidMessage& message) {
  if (last_.size() >= kMostShownAvatars && last_.count(message.avatar) == 0) last_.clear();
  const auto [place, isNew] = last_.try_emplace(message.avatar);
  const Last before = place->second;
  place->second = {message.state, message.limit, message.snapInUs >= 0};
  return isNew || before.state != message.state || before.limit != message.limit ||
         (!before.snaps && message.snapInUs >= 0);
}

}  // namespace foretouch::tools
