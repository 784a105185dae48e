// Touches from hand-made answers, rule by rule, and from random ones against their definition.
#include "tools/touches/touch_tracker.h"

#include <algorithm>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/random_geometry.h"

namespace foretouch::tools {
namespace {

constexpr LinkId kHand = 0, kFoot = 1;

/// A contact of a step of one second.
struct Said {
  LinkId link = kHand;
  std::string object = "wall";
  Verdict verdict = Verdict::Contact;
  double at = 0.0;  ///< toi, or free until.
  bool isMissed = false;
  bool isGround = false;
  LinkId other = -1;
};

Said contact(double toi, const std::string& object = "wall", LinkId link = kHand) {
  return {link, object, Verdict::Contact, toi};
}
Said starts(const std::string& object = "wall", LinkId link = kHand) {
  return {link, object, Verdict::StartsInContact, 0.0};
}
Said undecided(double freeUntil, LinkId link = kHand) {
  return {link, "", Verdict::Undecided, freeUntil};
}
Said own(Said said) {
  said.other = 7;
  said.object = "other hand";
  return said;
}
Said missed(Said said) {
  said.isMissed = true;
  return said;
}
Said ground(Said said) {
  said.isGround = true;
  return said;
}

using Answers = std::vector<std::vector<Said>>;

/// The rows of one step, with the contacts that they point to.
struct Rows {
  TouchStep step;
  std::deque<LinkContact> contacts;

  Rows(std::int64_t number, const std::vector<Said>& answer) {
    step.step = number;
    for (const Said& said : answer) {
      LinkContact& contact = contacts.emplace_back();
      contact.link = said.link;
      contact.verdict = said.verdict;
      contact.toi = contact.freeUntil = said.at;
      contact.separation = 1e-3 * said.at;
      contact.penetration = said.verdict == Verdict::StartsInContact ? 0.01 : 0.0;
      step.rows.push_back({&contact, said.other, said.object, static_cast<double>(number) + said.at,
                           1'000'000 * number, said.isMissed, said.isGround});
    }
  }
};

std::vector<Touch> touchesOf(const Answers& answers, TouchScope scope = TouchScope::FirstOfLink,
                             std::size_t* begun = nullptr) {
  TouchTracker tracker(scope);
  std::vector<Touch> ended;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < answers.size(); ++i) {
    tracker.addStep(Rows(static_cast<std::int64_t>(i), answers[i]).step, ended, places);
  }
  tracker.breakOff(ended);
  EXPECT_EQ(tracker.open(), 0u);
  std::sort(ended.begin(), ended.end(), isListedBefore);
  if (begun != nullptr) *begun = places.size();
  return ended;
}

/// "wall 0.5-2 left" in short: object, begin, end, and how.
std::string inShort(const Touch& touch) {
  const auto number = [](double x) {
    std::string text = std::to_string(x);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.back() == '.') text.pop_back();
    return text;
  };
  return touch.object + " " + number(touch.beginS) + "-" + number(touch.endS) +
         (touch.beginsInside ? " inside" : "") + (touch.isOpen ? " open" : " left") +
         (touch.isMissed ? " missed" : "") + (touch.isGround ? " ground" : "");
}

std::vector<std::string> inShort(const Answers& answers,
                                 TouchScope scope = TouchScope::FirstOfLink) {
  std::vector<std::string> texts;
  for (const Touch& touch : touchesOf(answers, scope)) texts.push_back(inShort(touch));
  return texts;
}

using Texts = std::vector<std::string>;

TEST(TouchTracker, EndsATouchWhereThePoseAfterItIsFree) {
  EXPECT_EQ(inShort({{contact(0.5)}, {starts()}, {starts()}, {}}), Texts{"wall 0.5-2 left"});
  const std::vector<Touch> touches = touchesOf({{}, {contact(0.5)}, {starts()}, {starts()}, {}});
  ASSERT_EQ(touches.size(), 1u);
  EXPECT_EQ(touches[0].firstStep, 1);
  EXPECT_EQ(touches[0].lastStep, 3);
  EXPECT_EQ(touches[0].contacts, 3);
  EXPECT_EQ(touches[0].separation, 0.0);
  EXPECT_EQ(touches[0].penetration, 0.01);
}

TEST(TouchTracker, CountsAContactThatIsGoneByTheNextPoseAsATouch) {
  EXPECT_EQ(inShort({{contact(0.25)}, {contact(0.5)}, {}, {contact(0.75)}, {}}),
            (Texts{"wall 0.25-0.25 left missed", "wall 1.5-1.5 left missed",
                   "wall 3.75-3.75 left missed"}));
}

TEST(TouchTracker, EndsATouchWhereTheLinkTouchesTheSameAgainWithinTheStep) {
  EXPECT_EQ(inShort({{starts()}, {contact(0.5)}, {starts()}, {}}),
            (Texts{"wall 0-0 inside left", "wall 1.5-2 left"}));
}

TEST(TouchTracker, CountsWhatIsWithinTheToleranceAtAPoseAsThereAlready) {
  EXPECT_EQ(inShort({{contact(0.5)}, {contact(0.0)}, {contact(0.0)}, {}}),
            Texts{"wall 0.5-2 left missed"});
  EXPECT_EQ(inShort({{contact(0.0)}, {}}), Texts{"wall 0-0 inside left missed"});
}

TEST(TouchTracker, SaysInsideAtTheBeginningAndAfterWhatIsUndecided) {
  EXPECT_EQ(inShort({{starts()}, {starts()}, {}}), Texts{"wall 0-1 inside left"});
  EXPECT_EQ(inShort({{undecided(0.0)}, {starts()}, {}}), Texts{"wall 1-1 inside left"});
  EXPECT_EQ(inShort({{undecided(0.5)}, {starts()}, {}}), Texts{"wall 1-1 inside left"});
}

TEST(TouchTracker, LeavesATouchOpenAtTheEndAndBeforeWhatIsUndecidedFromThePoseOn) {
  EXPECT_EQ(inShort({{}, {contact(0.5)}}), Texts{"wall 1.5-1.5 open"});
  EXPECT_EQ(inShort({{contact(0.5)}, {starts()}, {undecided(0.0)}, {starts()}, {}}),
            (Texts{"wall 0.5-1 open", "wall 3-3 inside left"}));
}

TEST(TouchTracker, EndsATouchBeforeWhatIsFreeAtThePoseAndUndecidedLater) {
  EXPECT_EQ(inShort({{contact(0.5)}, {undecided(0.1)}, {}}), Texts{"wall 0.5-0.5 left missed"});
}

TEST(TouchTracker, KeepsWhatAnotherObjectHidesUntilTheLinkIsFree) {
  EXPECT_EQ(inShort({{contact(0.5, "floor")},
                     {starts("floor")},
                     {starts("box")},
                     {starts("floor")},
                     {starts("box")},
                     {starts("box")},
                     {}}),
            (Texts{"floor 0.5-3 left", "box 2-5 inside left"}));
  EXPECT_EQ(inShort({{starts("floor")}, {starts("box")}, {undecided(0.0)}, {}}),
            (Texts{"floor 0-0 inside open", "box 1-1 inside open"}));
  // Its last contact was within a step, at whose end the link touched another object: seen.
  EXPECT_EQ(inShort({{contact(0.5, "floor")}, {starts("box")}, {}}),
            (Texts{"floor 0.5-0.5 left", "box 1-1 inside left"}));
}

TEST(TouchTracker, EndsEveryTouchOfALinkThatTouchesOnlyLaterInTheStep) {
  EXPECT_EQ(inShort({{starts("floor")}, {starts("box")}, {contact(0.5, "floor")}, {}}),
            (Texts{"floor 0-0 inside left", "box 1-1 inside left", "floor 2.5-2.5 left missed"}));
}

TEST(TouchTracker, KeepsObjectsApartWhereEachIsAnswered) {
  const Answers answers{{starts("floor"), contact(0.5, "box")},
                        {starts("floor"), starts("box")},
                        {starts("box")},
                        {contact(0.25, "floor")},
                        {}};
  EXPECT_EQ(inShort(answers, TouchScope::EveryObject),
            (Texts{"floor 0-1 inside left", "box 0.5-2 left", "floor 3.25-3.25 left missed"}));
  // What is undecided of the link is so of all objects that are not listed.
  EXPECT_EQ(inShort({{starts("floor"), starts("box")}, {starts("floor"), undecided(0.0)}, {}},
                    TouchScope::EveryObject),
            (Texts{"box 0-0 inside open", "floor 0-1 inside left"}));
  EXPECT_EQ(inShort({{starts("box")}, {undecided(0.5)}, {}}, TouchScope::EveryObject),
            Texts{"box 0-0 inside left"});
}

TEST(TouchTracker, TakesObjectsOfOneNameAsOne) {
  EXPECT_EQ(inShort({{contact(0.25, "box"), contact(0.75, "box")},
                     {starts("box"), contact(0.5, "box")},
                     {contact(0.5, "box")},
                     {}},
                    TouchScope::EveryObject),
            (Texts{"box 0.25-1.5 left", "box 2.5-2.5 left missed"}));
}

TEST(TouchTracker, KeepsLinksApart) {
  EXPECT_EQ(inShort({{starts(), starts("wall", kFoot)}, {starts()}, {}}),
            (Texts{"wall 0-1 inside left", "wall 0-0 inside left"}));
}

TEST(TouchTracker, FollowsOwnLinksPairByPair) {
  EXPECT_EQ(inShort({{starts(), own(contact(0.5))},
                     {starts(), own(starts())},
                     {own(undecided(0.5))},
                     {own(starts())},
                     {own(undecided(0.0))},
                     {}}),
            (Texts{"wall 0-1 inside left", "other hand 0.5-1 left", "other hand 3-3 inside open"}));
  // Nothing that the scene leaves undecided is a matter of own links.
  EXPECT_EQ(inShort({{own(starts())}, {undecided(0.0)}}), Texts{"other hand 0-0 inside left"});
}

TEST(TouchTracker, TakesTheWordOfAPoseCheckWhereTheAnswersEnd) {
  EXPECT_EQ(inShort({{missed(contact(0.5))}}), Texts{"wall 0.5-0.5 open missed"});
  EXPECT_EQ(inShort({{missed(contact(0.5))}, {undecided(0.0)}}), Texts{"wall 0.5-0.5 open missed"});
  EXPECT_EQ(inShort({{contact(0.5)}, {starts()}, {missed(contact(0.0))}}),
            Texts{"wall 0.5-2 open"});
}

TEST(TouchTracker, IsOfTheGroundOnlyWithEachOfItsContacts) {
  EXPECT_EQ(inShort({{ground(contact(0.5))}, {ground(starts())}, {}}),
            Texts{"wall 0.5-1 left ground"});
  EXPECT_EQ(inShort({{ground(contact(0.5))}, {starts()}, {ground(starts())}, {}}),
            Texts{"wall 0.5-2 left"});
}

TEST(TouchTracker, NamesTheRowsThatBeginATouch) {
  TouchTracker tracker(TouchScope::FirstOfLink);
  std::vector<Touch> ended;
  std::vector<std::size_t> begun;
  tracker.addStep(Rows(0, {starts("floor", kFoot), contact(0.5)}).step, ended, begun);
  EXPECT_EQ(begun, (std::vector<std::size_t>{0, 1}));
  begun.clear();
  tracker.addStep(Rows(1, {starts("floor", kFoot), starts(), undecided(0.0, 3)}).step, ended,
                  begun);
  EXPECT_TRUE(begun.empty());
  tracker.addStep(Rows(2, {starts("floor", kFoot), contact(0.5)}).step, ended, begun);
  EXPECT_EQ(begun, std::vector<std::size_t>{1});
  EXPECT_EQ(ended.size(), 1u);
  EXPECT_EQ(tracker.open(), 2u);
}

TEST(TouchCounts, HoldTheGroundAndOwnLinksApart) {
  TouchCounts counts;
  const Answers answers{{ground(starts("floor", kFoot)), contact(0.5), own(starts())}, {}};
  for (const Touch& touch : touchesOf(answers)) counts.add(touch);
  EXPECT_EQ(counts.touches, 1);
  EXPECT_EQ(counts.missed, 1);
  EXPECT_EQ(counts.ground, 1);
  EXPECT_EQ(counts.own, 1);
}

// The definition, from all answers at once: what a pair's state is at each pose, and which of its
// contacts are of one touch.

enum class State { Touching, Hidden, Free, Unknown };

using Pair = std::tuple<LinkId, LinkId, std::string>;

Pair pairOf(const Said& said) {
  return {said.link, said.other, said.object};
}

bool isTouching(const Said& said) {
  return said.verdict != Verdict::Undecided;
}

/// Of the pair at the pose from which the step goes on.
State stateAt(const std::vector<Said>& answer, const Pair& pair, TouchScope scope) {
  const auto [link, other, object] = pair;
  const bool isOwn = other >= 0;
  std::optional<double> unknownFrom, ofPair, ofLink;
  for (const Said& said : answer) {
    if (said.link != link || said.other != other) continue;
    if (!isTouching(said)) {
      unknownFrom = said.at;
    } else {
      if (!ofLink) ofLink = said.at;
      if (!ofPair && pairOf(said) == pair) ofPair = said.at;
    }
  }
  if (ofPair) return *ofPair > 0.0 ? State::Free : State::Touching;
  if (!isOwn && scope == TouchScope::FirstOfLink && ofLink) {
    return *ofLink > 0.0 ? State::Free : State::Hidden;
  }
  return unknownFrom && !(*unknownFrom > 0.0) ? State::Unknown : State::Free;
}

struct Placed {
  std::size_t step;
  Said said;
};

/// The touch of these contacts, which are all of one.
std::string defined(const std::vector<Placed>& contacts, const Answers& answers,
                    const std::vector<State>& states) {
  Touch touch;
  touch.object = contacts.front().said.object;
  touch.beginsInside = !(contacts.front().said.at > 0.0);
  touch.isGround = true;
  touch.beginS = static_cast<double>(contacts.front().step) + contacts.front().said.at;
  bool starts = false;
  for (const Placed& placed : contacts) {
    touch.endS = std::max(touch.endS, static_cast<double>(placed.step) + placed.said.at);
    touch.isGround = touch.isGround && placed.said.isGround;
    starts = starts || placed.said.verdict == Verdict::StartsInContact;
  }
  const std::size_t last = contacts.back().step;
  std::size_t after = last + 1;
  while (after < answers.size() && states[after] == State::Hidden) ++after;
  const State end = after < answers.size() ? states[after] : State::Unknown;
  touch.isOpen = end == State::Unknown;
  const bool isFreeAtOnce = after == last + 1 && after < answers.size() && end != State::Unknown;
  touch.isMissed = !starts && (isFreeAtOnce || contacts.back().said.isMissed);
  return inShort(touch);
}

std::multiset<std::string> definedTouches(const Answers& answers, TouchScope scope) {
  std::map<Pair, std::vector<Placed>> rows;
  for (std::size_t step = 0; step < answers.size(); ++step) {
    for (const Said& said : answers[step]) {
      if (isTouching(said)) rows[pairOf(said)].push_back({step, said});
    }
  }
  std::multiset<std::string> touches;
  for (const auto& [pair, contacts] : rows) {
    std::vector<State> states;
    for (const auto& answer : answers) states.push_back(stateAt(answer, pair, scope));
    std::vector<Placed> together;
    for (const Placed& placed : contacts) {
      bool isOfThis = !together.empty();
      for (std::size_t pose = isOfThis ? together.back().step + 1 : 0;
           isOfThis && pose <= placed.step; ++pose) {
        isOfThis = states[pose] == State::Touching || states[pose] == State::Hidden;
      }
      if (!isOfThis && !together.empty()) {
        touches.insert(defined(together, answers, states));
        together.clear();
      }
      together.push_back(placed);
    }
    touches.insert(defined(together, answers, states));
  }
  return touches;
}

/// Answers of a few links and objects that often go on as they were, earliest first.
Answers randomAnswers(std::uint64_t seed, TouchScope scope) {
  test::Random random(seed);
  const auto some = [&](LinkId link, const std::string& object) {
    const int kind = random.below(8);
    Said said{link, object, kind < 5 ? Verdict::StartsInContact : Verdict::Contact,
              kind < 6 ? 0.0 : random.uniform(0.01, 1.0)};
    said.isMissed = said.verdict == Verdict::Contact && random.below(3) == 0;
    said.isGround = random.below(4) > 0;
    return said;
  };
  const std::vector<std::string> objects{"a", "b", "c"};
  Answers answers(static_cast<std::size_t>(1 + random.below(12)));
  for (auto& answer : answers) {
    for (LinkId link = 0; link < 3; ++link) {
      const int kind = random.below(6);
      if (kind == 0) continue;
      if (kind == 1) answer.push_back(undecided(random.below(2) * 0.5, link));
      if (scope == TouchScope::FirstOfLink && kind > 1) {
        answer.push_back(some(link, objects[static_cast<std::size_t>(random.below(3))]));
      }
      if (scope == TouchScope::EveryObject) {
        for (const std::string& object : objects) {
          for (int i = random.below(3); i > 0; --i) answer.push_back(some(link, object));
        }
      }
    }
    if (random.below(3) > 0)
      answer.push_back(random.below(5) > 0 ? own(some(0, "")) : own(undecided(0.0)));
    std::stable_sort(answer.begin(), answer.end(),
                     [](const Said& x, const Said& y) { return x.at < y.at; });
  }
  return answers;
}

TEST(TouchTracker, FindsTheTouchesOfTheDefinitionInRandomAnswers) {
  int touches = 0, open = 0, several = 0;
  for (int i = 0; i < 4000; ++i) {
    const TouchScope scope = i % 2 == 0 ? TouchScope::FirstOfLink : TouchScope::EveryObject;
    const Answers answers = randomAnswers(static_cast<std::uint64_t>(i), scope);
    std::multiset<std::string> found;
    std::size_t begun = 0;
    for (const Touch& touch : touchesOf(answers, scope, &begun)) {
      found.insert(inShort(touch));
      ++touches;
      open += touch.isOpen ? 1 : 0;
      several += touch.contacts > 1 ? 1 : 0;
    }
    EXPECT_EQ(found, definedTouches(answers, scope)) << "seed " << i;
    EXPECT_EQ(found.size(), begun) << "seed " << i;
  }
  EXPECT_GT(touches, 20'000);
  EXPECT_GT(open, touches / 10);
  EXPECT_GT(several, touches / 10);
  EXPECT_LT(several, touches);
}

}  // namespace
}  // namespace foretouch::tools
