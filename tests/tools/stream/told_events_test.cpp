// events_t as lines, named by a world file; of messages that make no sense as well.
#include "tools/stream/told_events.h"

#include <string>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/holds.h"
#include "tests/tools/world/small_stage.h"

namespace foretouch::test {
namespace {

using nlohmann::json;
using tools::ToldEvents;

ToldEvents eventsOf(const SmallStage& stage) {
  auto world = stage.load("[scene]\nfile = \"wall.obj\"\n" + kManWalks +
                          sphereNamed("ball", "position = [0, 1, 0]\n"));
  EXPECT_TRUE(world.ok()) << describe(world.error());
  return ToldEvents(std::move(world).value());
}

ToldEvent event(EventKind kind, BodyNumber a, LinkId linkOfA, BodyNumber b) {
  ToldEvent told;
  told.event.kind = kind;
  told.event.time = told.event.since = {2'000'000, 0.25};
  told.event.a.body = a;
  told.event.a.link = linkOfA;
  told.event.b.body = b;
  told.event.b.link = 0;
  return told;
}

EventsMessage window(std::int64_t sequence, std::int64_t fromUs, std::int64_t toUs) {
  EventsMessage message;
  message.timeline = 1;
  message.sequence = sequence;
  message.fromUs = fromUs;
  message.toUs = toUs;
  message.tolerance = 0.001;
  return message;
}

std::vector<json> linesIn(const std::string& text) {
  std::vector<json> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(json::parse(line));
  return lines;
}

TEST(ToldEvents, AreLinesOfAnEventsFile) {
  const SmallStage stage;
  ToldEvents events = eventsOf(stage);
  EventsMessage message = window(7, 1'000'000, 3'000'000);
  message.events = {event(EventKind::Enter, 1, 0, 2), event(EventKind::Leave, 1, 0, kStillScene)};
  message.events[0].event.effectiveMass = 0.4;
  message.events[0].event.isAssumed = true;
  message.unknown = {{2, kEveryLink, UndecidedReason::Gap, 2'500'000, 3'000'000}};
  const ToldEvents::Lines told = events.take(message);
  const std::vector<json> lines = linesIn(told.json);
  ASSERT_EQ(lines.size(), 4U);
  EXPECT_EQ(lines[0]["format"], "foretouch-events");
  EXPECT_TRUE(lines[0]["until"].is_null());
  EXPECT_EQ(lines[0]["bodies"].size(), 2U);
  EXPECT_EQ(lines[1]["unknown"]["body"], "ball");
  EXPECT_EQ(lines[1]["unknown"]["reason"], "gap");
  EXPECT_EQ(lines[1]["unknown"]["from"]["utime"], 2'500'000);
  EXPECT_EQ(lines[2]["event"], "enter");
  EXPECT_EQ(lines[2]["a"]["body"], "man");
  EXPECT_EQ(lines[2]["a"]["link"], "Hips");
  EXPECT_EQ(lines[2]["b"]["body"], "ball");
  EXPECT_EQ(lines[2]["utime"], 2'000'000);
  EXPECT_EQ(lines[2]["fraction"], 0.25);
  EXPECT_EQ(lines[2]["assumed"], true);
  EXPECT_EQ(lines[3]["event"], "leave");
  EXPECT_EQ(lines[3]["b"].count("body"), 0U);
  EXPECT_TRUE(holds(told.text, "'man' Hips touches 'ball'")) << told.text;
  EXPECT_TRUE(holds(told.text, "'ball' is not known now")) << told.text;
  EXPECT_FALSE(told.missing.has_value());
  EXPECT_EQ(linesIn(events.summary())[0]["summary"]["events"]["enter"], 1);
  // The header comes once; what was unknown is known again.
  const ToldEvents::Lines next = events.take(window(8, 3'000'000, 4'000'000));
  EXPECT_EQ(next.json, "");
  EXPECT_TRUE(holds(next.text, "'ball' is known again")) << next.text;
}

TEST(ToldEvents, TellsWhatDidNotArriveAndWhoIsGone) {
  const SmallStage stage;
  ToldEvents events = eventsOf(stage);
  static_cast<void>(events.take(window(0, 1'000'000, 2'000'000)));
  EventsMessage message = window(3, 4'000'000, 5'000'000);
  message.timeline = 2;
  message.events = {event(EventKind::Leave, 2, kEveryLink, kEveryBody)};
  message.events[0].cause = ToldCause::BodyGone;
  const ToldEvents::Lines told = events.take(message);
  ASSERT_TRUE(told.missing.has_value());
  const std::vector<json> lines = linesIn(told.json);
  ASSERT_EQ(lines.size(), 3U);
  EXPECT_EQ(lines[0]["unknown"]["everybody"], true);
  EXPECT_EQ(lines[0]["unknown"]["from"]["utime"], 2'000'000);
  EXPECT_EQ(lines[0]["unknown"]["to"]["utime"], 5'000'000) << "a first part may be lost, too";
  EXPECT_EQ(lines[1]["timeline"]["from"]["utime"], 4'000'000);
  EXPECT_EQ(lines[2]["cause"], "body_gone");
  EXPECT_EQ(lines[2]["b"]["everybody"], true);
  EXPECT_TRUE(holds(told.text, "'ball' is gone")) << told.text;
}

TEST(ToldEvents, TellsThatAPartOfAWindowDidNotArrive) {
  const SmallStage stage;
  for (const bool isFirstLost : {false, true}) {
    ToldEvents events = eventsOf(stage);
    EventsMessage before = window(0, 1'000'000, 2'000'000);
    before.hasMore = !isFirstLost;
    static_cast<void>(events.take(before));
    const ToldEvents::Lines told = events.take(window(2, 2'000'000, 3'000'000));
    EXPECT_TRUE(told.missing.has_value());
    const std::vector<json> lines = linesIn(told.json);
    ASSERT_FALSE(lines.empty());
    EXPECT_EQ(lines[0]["unknown"]["everybody"], true);
    EXPECT_EQ(lines[0]["unknown"]["from"]["utime"], isFirstLost ? 2'000'000 : 1'000'000);
    EXPECT_EQ(lines[0]["unknown"]["to"]["utime"], 3'000'000);
  }
}

TEST(ToldEvents, NamesBodiesOfOtherNumbersByTheirShapes) {
  const SmallStage stage;
  ToldEvents events = eventsOf(stage);
  BodyMessage state;
  state.body = 77;
  state.shape = "ball";
  events.take(state);
  EventsMessage message = window(0, 1'000'000, 3'000'000);
  message.events = {event(EventKind::Enter, 1, 0, 77), event(EventKind::Enter, 1, 0, 78)};
  const std::vector<json> lines = linesIn(events.take(message).json);
  EXPECT_EQ(lines[1]["b"]["body"], "ball#77");
  EXPECT_EQ(lines[2]["b"]["body"], "#78");
  EXPECT_EQ(lines[0]["bodies"].size(), 2U) << "of the file";
}

TEST(ToldEvents, LooksNothingUpThatIsNotThere) {
  const SmallStage stage;
  ToldEvents events = eventsOf(stage);
  EventsMessage message = window(0, 1'000'000, 3'000'000);
  for (BodyNumber body = 0; body < 6000; ++body) {
    ToldEvent told = event(EventKind::Enter, body % 2 == 0 ? 1 : body, 1000, body);
    told.event.a.triangle = told.event.b.triangle = 1'000'000;
    told.event.object = 1'000'000;
    message.events.push_back(told);
  }
  message.events.push_back(event(EventKind::Enter, 1, 0, kStillScene));
  message.events.back().event.b.triangle = 1'000'000;
  message.events.back().event.object = 3;
  message.events.push_back(event(EventKind::UnresolvedFrom, 1, -5, kEveryBody));
  message.unknown = {{kEveryBody, 5, UndecidedReason::Gap, 0, 1},
                     {1, 1000, UndecidedReason::Gap, 0, 1}};
  const ToldEvents::Lines told = events.take(message);
  EXPECT_EQ(linesIn(told.json).size(), message.events.size() + 3);
  EXPECT_TRUE(holds(told.json, "\"another\""));
}

}  // namespace
}  // namespace foretouch::test
