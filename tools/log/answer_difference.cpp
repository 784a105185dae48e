#include "tools/log/answer_difference.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/quoted.h"
#include "network/wire/world_message_fields.h"

namespace foretouch::tools {
namespace {

/// What people read in place of a name in lines of JSON; they read blanks in place of "_".
std::string wordsOf(std::string_view name) {
  static const std::map<std::string_view, const char*> kWords = {
      {"ahead_us", "horizon"},
      {"appeared", "break of the way"},
      {"assumed", "mark"},
      {"between", "motion between poses"},
      {"bounds_hash", "hash of the bounds"},
      {"catch_up", "catch-up"},
      {"certain_from", "certain begin"},
      {"certain_until", "certain end"},
      {"certified", "certificate"},
      {"free_until", "toi"},
      {"known_until", "last pose"},
      {"link_feature", "feature of the link"},
      {"link_triangle", "triangle of the link"},
      {"lost", "number of lost poses"},
      {"lss", "LSS"},
      {"on_link", "point on the link"},
      {"possible_from", "begin"},
      {"possible_until", "end"},
      {"queries", "number of queries"},
      {"scene_feature", "feature of the scene"},
      {"sequence_from", "sequence that it begins with"},
      {"sequence_to", "sequence that it ends with"},
      {"since", "begin"},
      {"slip", "slip speed"},
      {"snap_in_us", "time until it snaps"},
      {"step_us", "length of the step"},
      {"utime_from", "utime that it begins with"},
      {"utime_to", "utime that it ends with"},
      {"window_from", "begin of the window"},
      {"window_to", "end of the window"}};
  const auto found = kWords.find(name);
  if (found != kWords.end()) return found->second;
  std::string words(name);
  std::replace(words.begin(), words.end(), '_', ' ');
  return words;
}

/// The text of a number; not in JSON's words: a depth may be NaN, which stands for unknown.
std::string textOf(double value) {
  return std::isnan(value) ? "unknown" : fmt::format("{}", value);
}
std::string textOf(const std::string& text) {
  return inQuotes(text);
}
std::string textOf(const Eigen::Vector3d& v) {
  return fmt::format("[{}, {}, {}]", textOf(v.x()), textOf(v.y()), textOf(v.z()));
}
std::string textOf(const WorldTime& time) {
  return fmt::format("{} us and {}", time.us, textOf(time.fraction));
}
template <typename Value>
std::enable_if_t<std::is_integral_v<Value>, std::string> textOf(Value value) {
  if constexpr (std::is_same_v<Value, bool>) return value ? "true" : "false";
  return std::to_string(value);
}
template <typename Value>
std::enable_if_t<std::is_enum_v<Value>, std::string> textOf(Value value) {
  if constexpr (std::is_same_v<Value, ToldCause>)
    return std::to_string(static_cast<int>(value));
  else
    return toString(value);
}

/// What a message says, in the order in which it is compared: its options first. Values with equal
/// text are equal, bit for bit.
class SaidFields {
 public:
  void add(std::string name, std::string value) {
    fields_.emplace_back(std::move(name), std::move(value));
  }
  void addNumber(const char* what, std::size_t number) {
    add(fmt::format("number of {}", what), std::to_string(number));
  }
  /// All that the lists have a name for.
  template <typename Record, typename... Lists>
  void addAll(const Record& record, const std::string& of, const Lists&... lists) {
    const auto addOne = [&](const auto& field) {
      if (field.name[0] == '\0') return;
      add(wordsOf(field.name) + of, textOf(wire::at(record, field.member)));
    };
    (std::apply([&](const auto&... each) { (addOne(each), ...); }, lists), ...);
  }
  /// What comes now is the answer.
  void endOptions() { numOptions_ = fields_.size(); }

  /// Both have the same fields up to the first that differs. `where`: for what is not an option.
  [[nodiscard]] std::string differenceTo(const SaidFields& replayed,
                                         const std::string& where) const {
    for (std::size_t i = 0; i < std::min(fields_.size(), replayed.fields_.size()); ++i) {
      const auto& [name, value] = fields_[i];
      if (value == replayed.fields_[i].second) continue;
      return fmt::format("the {} is {} in the log, {} here{}", name, value,
                         replayed.fields_[i].second, i < numOptions_ ? "" : where);
    }
    return "their bytes alone differ" + where;
  }

 private:
  std::vector<std::pair<std::string, std::string>> fields_;
  std::size_t numOptions_ = 0;
};

using LinkNames = std::map<LinkId, std::string>;

/// Verdicts come before contacts, so that the lists of contacts have the same links when their
/// fields are compared.
SaidFields fieldsOf(const ContactsMessage& message, const LinkNames& names) {
  SaidFields said;
  said.addAll(message, "", wire::kContactsTolerance);
  said.add("fidelity", toString(message.fidelity));
  said.addAll(message, "", wire::kContactsOptions);
  said.addNumber("links", message.verdicts.size());
  said.endOptions();
  said.addAll(message, "", wire::kContactsStep);
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    const auto name = names.find(static_cast<LinkId>(i));
    said.add(
        "verdict of " + (name == names.end() ? fmt::format("link {}", i) : inQuotes(name->second)),
        toString(message.verdicts[i]));
  }
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    said.addAll(message.contacts[i], fmt::format(" of contact {}", i), wire::kContactLink);
  }
  for (const AnsweredContact& answered : message.contacts) {
    said.addAll(answered, " of " + inQuotes(answered.linkName), wire::kContact);
  }
  return said;
}

void addPose(std::size_t place, double time, const Pose& pose, SaidFields& said) {
  said.add(fmt::format("time of pose {} on the way", place), textOf(time));
  for (std::size_t joint = 0; joint < pose.rotations.size(); ++joint) {
    const std::string of = fmt::format(" of joint {} in pose {} on the way", joint, place);
    const Quaternion& q = pose.rotations[joint];
    said.add("rotation" + of, fmt::format("[{}, {}, {}, {}]", textOf(q.w()), textOf(q.x()),
                                          textOf(q.y()), textOf(q.z())));
    said.add("translation" + of, textOf(pose.translations[joint]));
  }
}

/// What says more comes first.
SaidFields fieldsOf(const SolidMessage& message) {
  SaidFields said;
  said.addAll(message, "", wire::kSolidOptions);
  said.addNumber("joints", message.joints.size());
  said.endOptions();
  said.addAll(message, "", wire::kSolidState);
  said.addNumber("poses on the way", message.way.size());
  for (std::size_t i = 0; i < message.way.size(); ++i) {
    addPose(i, message.times[i], message.way[i], said);
  }
  said.addAll(message, "", wire::kSolidLengths);
  for (std::size_t i = 0; i < message.joints.size(); ++i) {
    said.add(fmt::format("state of joint {}", i), toString(message.joints[i]));
    said.add(fmt::format("deviation of link {}", i), textOf(message.linkDeviation[i]));
  }
  said.addNumber("contacts", message.contacts.size());
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    const std::string of = fmt::format(" of contact {}", i);
    said.addAll(message.contacts[i], of, wire::kShownSides);
    said.add("other side" + of, inQuotes(message.contacts[i].otherName));
    said.addAll(message.contacts[i], of, wire::kShownPush);
  }
  said.addAll(message, "", wire::solidCounters(&SolidMessage::counters));
  return said;
}

SaidFields fieldsOf(const PersonMessage& message) {
  SaidFields said;
  said.addAll(message, "", wire::kPersonOptions);
  said.addNumber("links", message.verdicts.size());
  said.endOptions();
  said.addAll(message, "", wire::kPersonStep, wire::kPersonAhead);
  for (std::size_t i = 0; i < message.verdicts.size(); ++i) {
    const std::string of = fmt::format(" of link {}", i);
    said.add("verdict" + of, toString(message.verdicts[i]));
    said.add("instant until which nothing is touched" + of, std::to_string(message.notBeforeUs[i]));
  }
  said.addNumber("brackets", message.brackets.size());
  for (std::size_t i = 0; i < message.brackets.size(); ++i) {
    const ToldBracket& bracket = message.brackets[i];
    const std::string of = fmt::format(" of bracket {}", i);
    said.addAll(bracket, of, wire::kBracketSides);
    said.add("other side" + of, inQuotes(bracket.otherName));
    said.addAll(bracket, of, wire::kBracketPossible, wire::kBracketCertain, wire::kBracketGrowth);
  }
  said.addNumber("broken bounds", message.broken.size());
  for (const BrokenBound& broken : message.broken) {
    said.add(fmt::format("broken bound of link {}", broken.link),
             fmt::format("{}, {}", toString(broken.claim), textOf(broken.beyond)));
  }
  return said;
}

/// What says more comes first.
SaidFields fieldsOf(const PushesMessage& message) {
  SaidFields said;
  said.add("end of the tick", std::to_string(message.utimeUs));
  said.add("length of the tick", std::to_string(message.stepUs));
  said.addAll(message, "", wire::kPushes);
  said.addNumber("contacts", message.contacts.size());
  said.addNumber("crushes", message.crushes.size());
  for (std::size_t i = 0; i < message.contacts.size(); ++i) {
    said.addAll(message.contacts[i], fmt::format(" of contact {}", i), wire::kPush);
  }
  for (std::size_t i = 0; i < message.crushes.size(); ++i) {
    said.addAll(message.crushes[i], fmt::format(" of crush {}", i), wire::kCrush);
  }
  return said;
}

/// What says more comes first.
SaidFields fieldsOf(const EventsMessage& message) {
  SaidFields said;
  said.addAll(message, "", wire::kEventsOptions);
  said.endOptions();
  said.addAll(message, "", wire::kEventsWindow);
  said.addNumber("bodies", message.bodies.size());
  for (const ToldBody& body : message.bodies) {
    said.addAll(body, fmt::format(" of body {}", body.body), wire::kToldBody);
  }
  said.addNumber("what is unknown", message.unknown.size());
  for (const UnknownPart& part : message.unknown) {
    said.add(fmt::format("unknown part of body {}", part.body),
             fmt::format("link {}, {} to {} us, {}", part.link, part.fromUs, part.toUs,
                         toString(part.reason)));
  }
  said.addNumber("events", message.events.size());
  for (std::size_t i = 0; i < message.events.size(); ++i) {
    const ToldEvent& event = message.events[i];
    const std::string of = fmt::format(" of event {}", i);
    said.addAll(event, of, wire::kEventKind);
    said.add("time" + of, textOf(event.event.time));
    said.addAll(event, of + ", one side", wire::kEventA);
    said.addAll(event, of + ", other side", wire::kEventB);
    said.addAll(event, of, wire::kEventObject);
    said.add("begin" + of, textOf(event.event.since));
    said.addAll(event, of, wire::kEvent);
  }
  return said;
}

template <typename Message>
std::string differenceAtInstant(const Message& recorded, const Message& replayed) {
  return fieldsOf(recorded).differenceTo(fieldsOf(replayed),
                                         fmt::format(", at {} us", replayed.utimeUs));
}

}  // namespace

std::string firstDifference(const EventsMessage& recorded, const EventsMessage& replayed) {
  return fieldsOf(recorded).differenceTo(
      fieldsOf(replayed),
      fmt::format(", in the window from {} to {} us", replayed.fromUs, replayed.toUs));
}

std::string firstDifference(const PushesMessage& recorded, const PushesMessage& replayed) {
  return differenceAtInstant(recorded, replayed);
}

std::string firstDifference(const SolidMessage& recorded, const SolidMessage& replayed) {
  return differenceAtInstant(recorded, replayed);
}

std::string firstDifference(const PersonMessage& recorded, const PersonMessage& replayed) {
  return differenceAtInstant(recorded, replayed);
}

std::string firstDifference(const ContactsMessage& recorded, const ContactsMessage& replayed) {
  LinkNames names;
  for (const ContactsMessage* message : {&recorded, &replayed}) {
    for (const AnsweredContact& answered : message->contacts) {
      names.emplace(answered.contact.link, answered.linkName);
    }
  }
  return fieldsOf(recorded, names)
      .differenceTo(
          fieldsOf(replayed, names),
          fmt::format(", in the step from {} to {} us", replayed.utimeFromUs, replayed.utimeToUs));
}

}  // namespace foretouch::tools
