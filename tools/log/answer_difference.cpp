#include "tools/log/answer_difference.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "assets/json_writer.h"
#include "middleware/exact/feature.h"

namespace foretouch::tools {
namespace {

/// Its name for people, and its value. Values with equal text are equal, bit for bit.
struct Field {
  std::string name, value;
};
using Fields = std::vector<Field>;
using LinkNames = std::map<LinkId, std::string>;

std::string textOf(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", numberText(v.x()), numberText(v.y()), numberText(v.z()));
}

Fields optionsOf(const ContactsMessage& message) {
  return {{"tolerance", numberText(message.tolerance)},
          {"fidelity", toString(message.fidelity)},
          {"work budget", std::to_string(message.workBudget)},
          {"skeleton hash", std::to_string(message.skeletonHash)},
          {"kind", toString(message.kind)},
          {"number of links", std::to_string(message.verdicts.size())}};
}

void addContact(const AnsweredContact& answered, Fields& fields) {
  const LinkContact& contact = answered.contact;
  const std::string of = " of " + inQuotes(answered.linkName);
  fields.push_back({"reason" + of, toString(contact.reason)});
  fields.push_back({"toi" + of, numberText(contact.freeUntil)});
  fields.push_back({"separation" + of, numberText(contact.separation)});
  fields.push_back({"penetration" + of, numberText(contact.penetration)});
  fields.push_back({"triangle" + of, std::to_string(contact.triangle)});
  fields.push_back({"object" + of, inQuotes(answered.objectName)});
  fields.push_back({"point" + of, textOf(contact.p_WScene)});
  fields.push_back({"point on the link" + of, textOf(contact.p_WLink)});
  fields.push_back({"normal" + of, textOf(contact.nhat_SL_W)});
  fields.push_back({"triangle of the link" + of, std::to_string(contact.linkTriangle)});
  fields.push_back({"feature of the link" + of, toString(contact.linkFeature)});
  fields.push_back({"feature of the scene" + of, toString(contact.sceneFeature)});
}

/// All fields that are not options. Verdicts come before contacts, so that the lists of contacts
/// have the same links when their fields are compared.
Fields answerOf(const ContactsMessage& message, const LinkNames& names) {
  Fields fields{{"sequence that it begins with", std::to_string(message.sequenceFrom)},
                {"utime that it begins with", std::to_string(message.utimeFromUs)},
                {"utime that it ends with", std::to_string(message.utimeToUs)},
                {"number of lost poses", std::to_string(message.lost)}};
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    const auto name = names.find(static_cast<LinkId>(i));
    fields.push_back(
        {"verdict of " + (name == names.end() ? fmt::format("link {}", i) : inQuotes(name->second)),
         toString(message.verdicts[i])});
  }
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    fields.push_back(
        {fmt::format("link of contact {}", i), inQuotes(message.contacts[i].linkName)});
  }
  for (const AnsweredContact& answered : message.contacts) addContact(answered, fields);
  return fields;
}

/// Both have the same fields up to the first that differs.
std::string differenceIn(const Fields& recorded, const Fields& replayed) {
  for (std::size_t i = 0; i < std::min(recorded.size(), replayed.size()); ++i) {
    if (recorded[i].value == replayed[i].value) continue;
    return fmt::format("the {} is {} in the log, {} here", recorded[i].name, recorded[i].value,
                       replayed[i].value);
  }
  return "";
}

Fields optionsOf(const SolidMessage& message) {
  return {{"skin", numberText(message.skin)},
          {"tolerance", numberText(message.tolerance)},
          {"catch-up", numberText(message.catchUp)},
          {"work budget", std::to_string(message.workBudget)},
          {"avatar hash", std::to_string(message.avatarHash)},
          {"kind", toString(message.kind)},
          {"length of the step", std::to_string(message.stepUs)},
          {"number of joints", std::to_string(message.joints.size())}};
}

Fields optionsOf(const PersonMessage& message) {
  return {{"motion between poses", toString(message.model)},
          {"hash of the bounds", std::to_string(message.boundsHash)},
          {"resolution", numberText(message.resolution)},
          {"number of links", std::to_string(message.verdicts.size())}};
}

void addBracket(std::size_t place, const ToldBracket& told, Fields& fields) {
  const LinkBracket& bracket = told.bracket;
  const std::string of = fmt::format(" of bracket {}", place);
  fields.push_back({"link" + of, inQuotes(told.linkName)});
  fields.push_back({"other side" + of, inQuotes(told.otherName)});
  fields.push_back({"triangle" + of, std::to_string(bracket.triangle)});
  fields.push_back({"verdict" + of, toString(bracket.verdict)});
  fields.push_back({"begin" + of, numberText(bracket.possibleFrom)});
  fields.push_back({"end" + of, numberText(bracket.possibleUntil)});
  fields.push_back({"certain begin" + of, numberText(bracket.certainFrom)});
  fields.push_back({"certain end" + of, numberText(bracket.certainUntil)});
  fields.push_back({"growth" + of, numberText(bracket.growth)});
}

/// All fields that are not options.
Fields answerOf(const PersonMessage& message) {
  Fields fields{{"kind", toString(message.kind)},
                {"sequence that it begins with", std::to_string(message.sequenceFrom)},
                {"sequence that it ends with", std::to_string(message.sequenceTo)},
                {"utime that it begins with", std::to_string(message.utimeFromUs)},
                {"utime that it ends with", std::to_string(message.utimeToUs)},
                {"horizon", std::to_string(message.aheadUs)}};
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    const std::string of = fmt::format(" of link {}", i);
    fields.push_back({"verdict" + of, toString(message.verdicts[i])});
    fields.push_back(
        {"instant until which nothing is touched" + of, std::to_string(message.notBeforeUs[i])});
  }
  fields.push_back({"number of brackets", std::to_string(message.brackets.size())});
  for (std::size_t i = 0; i < message.brackets.size(); ++i) {
    addBracket(i, message.brackets[i], fields);
  }
  fields.push_back({"number of broken bounds", std::to_string(message.broken.size())});
  for (const BrokenBound& broken : message.broken) {
    fields.push_back({fmt::format("broken bound of link {}", broken.link),
                      fmt::format("{}, {}", toString(broken.claim), numberText(broken.beyond))});
  }
  return fields;
}

void addPose(std::size_t place, double time, const Pose& pose, Fields& fields) {
  fields.push_back({fmt::format("time of pose {} on the way", place), numberText(time)});
  for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
    const std::string of = fmt::format(" of joint {} in pose {} on the way", joint, place);
    const Quaternion& q = pose.rotations[joint];
    fields.push_back(
        {"rotation" + of, fmt::format("[{}, {}, {}, {}]", numberText(q.w()), numberText(q.x()),
                                      numberText(q.y()), numberText(q.z()))});
    fields.push_back({"translation" + of, textOf(pose.translations[joint])});
  }
}

void addContact(std::size_t place, const ShownContact& shown, Fields& fields) {
  const SolidContact& contact = shown.contact;
  const std::string of = fmt::format(" of contact {}", place);
  fields.push_back({"link" + of, inQuotes(shown.linkName)});
  fields.push_back({"LSS" + of, std::to_string(contact.lss)});
  fields.push_back({"triangle" + of, std::to_string(contact.triangle)});
  fields.push_back({"other side" + of, inQuotes(shown.otherName)});
  fields.push_back({"point" + of, textOf(contact.p_W)});
  fields.push_back({"normal" + of, textOf(contact.nhat_W)});
  fields.push_back({"gap" + of, numberText(contact.gap)});
  fields.push_back({"push" + of, numberText(contact.push)});
  fields.push_back({"slip speed" + of, numberText(contact.slipSpeed)});
}

/// All fields that are not options. What says more comes first.
Fields answerOf(const SolidMessage& message) {
  Fields fields{{"state", toString(message.state)},
                {"limit", toString(message.limit)},
                {"certificate", message.isCertified ? "true" : "false"},
                {"break of the way", message.hasAppeared ? "true" : "false"},
                {"number of poses on the way", std::to_string(message.way.size())}};
  for (std::size_t i = 0; i < message.way.size(); ++i) {
    addPose(i, message.times[i], message.way[i], fields);
  }
  fields.push_back({"deviation", numberText(message.deviation)});
  fields.push_back({"lift", numberText(message.lift)});
  fields.push_back({"clearance", numberText(message.clearance)});
  fields.push_back({"time until it snaps", std::to_string(message.snapInUs)});
  for (std::size_t i = 0; i < message.joints.size(); ++i) {
    fields.push_back({fmt::format("state of joint {}", i), toString(message.joints[i])});
    fields.push_back(
        {fmt::format("deviation of link {}", i), numberText(message.linkDeviation[i])});
  }
  fields.push_back({"number of contacts", std::to_string(message.contacts.size())});
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    addContact(i, message.contacts[i], fields);
  }
  fields.push_back({"number of queries", std::to_string(message.counters.queries)});
  fields.push_back({"work", std::to_string(message.counters.work)});
  return fields;
}

/// All fields. What says more comes first.
Fields answerOf(const PushesMessage& message) {
  Fields fields{{"end of the tick", std::to_string(message.utimeUs)},
                {"length of the tick", std::to_string(message.stepUs)},
                {"timeline", std::to_string(message.timeline)},
                {"mark", message.isAssumed ? "true" : "false"},
                {"number of contacts", std::to_string(message.contacts.size())},
                {"number of crushes", std::to_string(message.crushes.size())}};
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const SolidBodyContact& contact = message.contacts[i].contact;
    const std::string of = fmt::format(" of contact {}", i);
    fields.push_back({"link" + of, inQuotes(message.contacts[i].linkName)});
    fields.push_back({"body" + of, std::to_string(contact.body)});
    fields.push_back({"triangle" + of, std::to_string(contact.triangle)});
    fields.push_back({"point" + of, textOf(contact.p_W)});
    fields.push_back({"normal" + of, textOf(contact.nhat_W)});
    fields.push_back({"gap" + of, numberText(contact.gap)});
    fields.push_back({"push" + of, numberText(contact.push)});
    fields.push_back({"slip speed" + of, numberText(contact.slipSpeed)});
  }
  for (std::size_t i = 0; i < message.crushes.size(); ++i) {
    const SolidCrush& crush = message.crushes[i].crush;
    const std::string of = fmt::format(" of crush {}", i);
    fields.push_back({"body" + of, std::to_string(crush.body)});
    fields.push_back({"link" + of, inQuotes(message.crushes[i].linkName)});
    fields.push_back({"begin" + of, std::to_string(crush.sinceUs)});
    fields.push_back({"depth" + of, numberText(crush.depth)});
  }
  return fields;
}

std::string textOf(const WorldTime& time) {
  return fmt::format("{} us and {}", time.us, numberText(time.fraction));
}

void addSide(const ContactSide& side, const std::string& of, Fields& fields) {
  fields.push_back({"body" + of, std::to_string(side.body)});
  fields.push_back({"link" + of, std::to_string(side.link)});
  fields.push_back({"LSS" + of, std::to_string(side.lss)});
  fields.push_back({"triangle" + of, std::to_string(side.triangle)});
  fields.push_back({"point" + of, textOf(side.p_W)});
}

void addEvent(std::size_t place, const ToldEvent& told, Fields& fields) {
  const WorldEvent& event = told.event;
  const std::string of = fmt::format(" of event {}", place);
  fields.push_back({"kind" + of, toString(event.kind)});
  fields.push_back({"time" + of, textOf(event.time)});
  addSide(event.a, of + ", one side", fields);
  addSide(event.b, of + ", other side", fields);
  fields.push_back({"object" + of, std::to_string(event.object)});
  fields.push_back({"begin" + of, textOf(event.since)});
  fields.push_back({"cause" + of, std::to_string(static_cast<int>(told.cause))});
  fields.push_back({"reason" + of, toString(event.reason)});
  fields.push_back({"mark" + of, event.isAssumed ? "true" : "false"});
  fields.push_back({"separation" + of, numberText(event.separation)});
  fields.push_back({"penetration" + of, numberText(event.penetration)});
  fields.push_back({"normal" + of, textOf(event.nhat_BA_W)});
  fields.push_back({"velocity" + of, textOf(event.velocity_W)});
  fields.push_back({"approach" + of, numberText(event.approachSpeed)});
}

/// All fields but the tolerance. What says more comes first.
Fields answerOf(const EventsMessage& message) {
  Fields fields{{"begin of the window", std::to_string(message.fromUs)},
                {"end of the window", std::to_string(message.toUs)},
                {"number of bodies", std::to_string(message.bodies.size())}};
  for (const ToldBody& body : message.bodies) {
    const std::string of = fmt::format(" of body {}", body.body);
    fields.push_back({"last pose" + of, std::to_string(body.knownUntilUs)});
    fields.push_back({"waiting" + of, body.isWaitedFor ? "true" : "false"});
  }
  fields.push_back({"number of what is unknown", std::to_string(message.unknown.size())});
  for (const UnknownPart& part : message.unknown) {
    fields.push_back({fmt::format("unknown part of body {}", part.body),
                      fmt::format("link {}, {} to {} us, {}", part.link, part.fromUs, part.toUs,
                                  toString(part.reason))});
  }
  fields.push_back({"number of events", std::to_string(message.events.size())});
  for (std::size_t i = 0; i < message.events.size(); ++i) addEvent(i, message.events[i], fields);
  return fields;
}

}  // namespace

std::string firstDifference(const EventsMessage& recorded, const EventsMessage& replayed) {
  const std::string options = differenceIn({{"tolerance", numberText(recorded.tolerance)}},
                                           {{"tolerance", numberText(replayed.tolerance)}});
  if (!options.empty()) return options;
  const std::string difference = differenceIn(answerOf(recorded), answerOf(replayed));
  return fmt::format("{}, in the window from {} to {} us",
                     difference.empty() ? "their bytes alone differ" : difference, replayed.fromUs,
                     replayed.toUs);
}

std::string firstDifference(const PushesMessage& recorded, const PushesMessage& replayed) {
  const std::string difference = differenceIn(answerOf(recorded), answerOf(replayed));
  return fmt::format("{}, at {} us", difference.empty() ? "their bytes alone differ" : difference,
                     replayed.utimeUs);
}

std::string firstDifference(const SolidMessage& recorded, const SolidMessage& replayed) {
  const std::string options = differenceIn(optionsOf(recorded), optionsOf(replayed));
  if (!options.empty()) return options;
  const std::string difference = differenceIn(answerOf(recorded), answerOf(replayed));
  return fmt::format("{}, at {} us", difference.empty() ? "their bytes alone differ" : difference,
                     replayed.utimeUs);
}

std::string firstDifference(const PersonMessage& recorded, const PersonMessage& replayed) {
  const std::string options = differenceIn(optionsOf(recorded), optionsOf(replayed));
  if (!options.empty()) return options;
  const std::string difference = differenceIn(answerOf(recorded), answerOf(replayed));
  return fmt::format("{}, at {} us", difference.empty() ? "their bytes alone differ" : difference,
                     replayed.utimeUs);
}

std::string firstDifference(const ContactsMessage& recorded, const ContactsMessage& replayed) {
  const std::string options = differenceIn(optionsOf(recorded), optionsOf(replayed));
  if (!options.empty()) return options;
  LinkNames names;
  for (const ContactsMessage* message : {&recorded, &replayed}) {
    for (const AnsweredContact& answered : message->contacts) {
      names.emplace(answered.contact.link, answered.linkName);
    }
  }
  const std::string difference = differenceIn(answerOf(recorded, names), answerOf(replayed, names));
  return fmt::format("{}, in the step from {} to {} us",
                     difference.empty() ? "their bytes alone differ" : difference,
                     replayed.utimeFromUs, replayed.utimeToUs);
}

}  // namespace foretouch::tools
