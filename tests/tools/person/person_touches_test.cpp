// Oracle: a ball that flies through a wall at 1 m/s, of which closed forms say when it may touch.
#include "tools/person/person_touches.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assets/bvh/bvh_reader.h"
#include "tests/tools/report/view_reading.h"
#include "tests/tools/small_inputs.h"
#include "tools/report/view_person.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;

constexpr double kStepS = 0.1, kMost = 0.02, kRadius = 0.1;

/// From 0.55 m before the wall on, `count` poses ten times a second.
ReplayInputs flight(int count) {
  std::vector<double> places;
  for (int i = 0; i < count; ++i) places.push_back(-0.55 + kStepS * i);
  return test::smallInputs(places);
}

/// The hips are within `most` of the model; of the arm nothing is claimed.
LinkBounds boundsOfHips(double most, double stepS) {
  LinkBounds bounds;
  bounds.bounds.resize(2);
  bounds.bounds[0].acceleration = 8.0 * most / (stepS * stepS);
  bounds.entryOf = {0, -1};
  return bounds;
}

PersonRequest request() {
  return {"some/anna.bounds.json", MotionModel::ConstantRate};
}

/// How far the ball of the model, at `t` seconds, is from the wall, and the person from the ball.
double gapAt(double t) {
  return std::abs(-0.55 + t) - kRadius;
}
double growthAt(double t) {
  const double u = std::fmod(t, kStepS) / kStepS;
  return 4.0 * kMost * u * (1.0 - u);
}

/// The first instant, of a million steps, at which something is so.
template <typename Is>
double firstAt(double from, double to, const Is& is) {
  constexpr int kSteps = 1000000;
  for (int i = 0; i <= kSteps; ++i) {
    const double t = from + (to - from) * i / kSteps;
    if (is(t)) return t;
  }
  ADD_FAILURE() << "never";
  return to;
}

TEST(PersonTouches, AreOneOverAllStepsThatItGoesOnIn) {
  const ReplayInputs inputs = flight(12);
  const auto told = personTouches(inputs, request(), boundsOfHips(kMost, kStepS));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  const PersonAnswer& answer = told.value();
  ASSERT_EQ(answer.touches.size(), 1u);
  const PersonTouch& touch = answer.touches[0];
  EXPECT_EQ(touch.link, 0);
  EXPECT_TRUE(touch.isCertain);
  EXPECT_FALSE(touch.beginsBefore);
  EXPECT_FALSE(touch.endsAfter);
  EXPECT_NEAR(touch.growth, kMost, 1e-9);
  const auto mayTouch = [](double t) { return gapAt(t) <= growthAt(t); };
  const auto touches = [](double t) { return gapAt(t) <= -growthAt(t); };
  EXPECT_NEAR(touch.beginsS[0], firstAt(0.0, 1.0, mayTouch), 1e-4);
  EXPECT_NEAR(touch.beginsS[1], firstAt(0.0, 1.0, touches), 1e-4);
  EXPECT_NEAR(touch.endsS[0], firstAt(1.1, 0.0, touches), 1e-4);
  EXPECT_NEAR(touch.endsS[1], firstAt(1.1, 0.0, mayTouch), 1e-4);
  EXPECT_EQ(answer.counts.intervals, 22);
  EXPECT_EQ(answer.counts.unclaimed, 11);
  EXPECT_EQ(answer.unclaimed, std::vector<LinkId>{1});
  EXPECT_EQ(answer.counts.excluded + answer.counts.possible + answer.counts.certain, 11);
  EXPECT_EQ(answer.counts.broken, 0);
}

TEST(PersonTouches, GoOnWhereTheClipEnds) {
  const ReplayInputs inputs = flight(7);
  const auto told = personTouches(inputs, request(), boundsOfHips(kMost, kStepS));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  ASSERT_EQ(told.value().touches.size(), 1u);
  EXPECT_TRUE(told.value().touches[0].endsAfter);
  EXPECT_EQ(told.value().touches[0].endsS[1], inputs.timeOfStep(6));
}

TEST(PersonTouches, NameTheFrameThatBreaksItsBoundAndByHowMuch) {
  ReplayInputs inputs = test::smallInputs({-9.0, -8.9, -8.8, -8.67, -8.6});
  inputs.steps = selectSteps(inputs.clip, 5.0).value();
  const auto told = personTouches(inputs, request(), boundsOfHips(kMost, 2 * kStepS));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  const PersonCounts& counts = told.value().counts;
  EXPECT_EQ(counts.broken, 1);
  EXPECT_EQ(counts.worstLink, 0);
  EXPECT_NEAR(counts.worstS, 0.3, 1e-9);
  EXPECT_NEAR(counts.worstM, 0.03 - kMost, 1e-6);
  const auto notes = personNotes(inputs, told.value());
  ASSERT_EQ(notes.size(), 2u);
  EXPECT_NE(notes[1].find("Hips at 0.300 s by 10.0 mm"), std::string::npos) << notes[1];
}

/// `flight(12)` of which frames 3 to 6 are made up, of `joint` or of all: nonsense stands there.
/// From pose 2 to pose 7, half a second, the person is only known to be no faster than `speed`.
ReplayInputs flightWithGap(JointId joint = kNoParent) {
  std::vector<double> places;
  for (int i = 0; i < 12; ++i) {
    places.push_back(joint == kNoParent && i >= 3 && i <= 6 ? 50.0 + i : -0.55 + kStepS * i);
  }
  ReplayInputs inputs = test::smallInputs(places);
  inputs.clip.gaps = {{3, 4, joint}, {5, 6, joint}};
  return inputs;
}
LinkBounds boundsWithSpeed(double speed) {
  LinkBounds bounds = boundsOfHips(kMost, kStepS);
  bounds.bounds[0].speed = speed;
  return bounds;
}

TEST(PersonTouches, AcrossAGapOnlyTheSpeedCounts) {
  const ReplayInputs inputs = flightWithGap();
  const auto told = personTouches(inputs, request(), boundsWithSpeed(1.2));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  const PersonAnswer& answer = told.value();
  ASSERT_EQ(answer.touches.size(), 1u);
  EXPECT_TRUE(answer.touches[0].isCertain);  // there is no way around the wall so fast
  EXPECT_FALSE(answer.touches[0].beginsBefore);
  EXPECT_FALSE(answer.touches[0].endsAfter);
  EXPECT_LT(answer.touches[0].endsS[0], answer.touches[0].beginsS[1]);
  // 0.25 m before the wall at 0.2 s, 0.05 m behind it at 0.7 s.
  EXPECT_NEAR(answer.touches[0].beginsS[0], 0.2 + 0.25 / 1.2, 1e-4);
  EXPECT_NEAR(answer.touches[0].endsS[1], 0.7 - 0.05 / 1.2, 1e-4);
  EXPECT_EQ(answer.counts.intervals, 22);
  EXPECT_EQ(answer.counts.inGaps, 10);
  EXPECT_EQ(answer.counts.unclaimed, 11);
  EXPECT_EQ(answer.counts.certain, 5);
  EXPECT_EQ(answer.counts.excluded, 6);
  EXPECT_EQ(answer.counts.broken, 0);
  EXPECT_NE(personText(inputs, request(), answer).find("The clip has gaps: of 10 of"),
            std::string::npos);
  EXPECT_NE(personLines(inputs, request(), answer).find("\"in_gaps\":10"), std::string::npos);
}

TEST(PersonTouches, AcrossAGapNothingIsClaimedWithoutASpeed) {
  const auto told = personTouches(flightWithGap(), request(), boundsOfHips(kMost, kStepS));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  EXPECT_TRUE(told.value().touches.empty());
  EXPECT_EQ(told.value().counts.unclaimed, 11 + 5);
  EXPECT_EQ(told.value().counts.excluded, 6);
}

TEST(PersonTouches, AGapThatTheSpeedCannotCrossIsTold) {
  const ReplayInputs inputs = flightWithGap();
  const auto told = personTouches(inputs, request(), boundsWithSpeed(0.9));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  EXPECT_EQ(told.value().counts.broken, 1);
  EXPECT_NEAR(told.value().counts.worstM, 0.5 - 0.45, 1e-6);
  EXPECT_NEAR(told.value().counts.worstS, 0.7, 1e-9);
}

TEST(PersonTouches, AtTheClipsBeginAndEndNoSpeedHelps) {
  ReplayInputs inputs = flight(12);
  inputs.clip.gaps = {{0, 1}, {11, 11}};
  const auto told = personTouches(inputs, request(), boundsWithSpeed(1.2));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  EXPECT_EQ(told.value().counts.unclaimed, 11 + 3);
  EXPECT_EQ(told.value().counts.inGaps, 6);
}

TEST(PersonTouches, AJointThatIsLostLeavesWhatDoesNotHangOnIt) {
  LinkBounds bounds = boundsWithSpeed(1.2);
  bounds.bounds[1] = bounds.bounds[0];
  bounds.entryOf = {0, 0};
  const PersonAnswer whole = personTouches(flight(12), request(), bounds).value();
  const PersonAnswer lost = personTouches(flightWithGap(1), request(), bounds).value();
  const auto ofHips = [](const PersonAnswer& answer) {
    for (const PersonTouch& touch : answer.touches) {
      if (touch.link == 0) return touch;
    }
    ADD_FAILURE() << "none";
    return PersonTouch{};
  };
  EXPECT_TRUE(ofHips(whole).isCertain);
  EXPECT_TRUE(ofHips(lost).isCertain);
  EXPECT_EQ(ofHips(lost).beginsS[1], ofHips(whole).beginsS[1]);
  EXPECT_EQ(ofHips(lost).endsS[0], ofHips(whole).endsS[0]);
  // The arm, of which the step behind the gap has no earlier pose to bend it: to pose 8.
  EXPECT_EQ(lost.counts.inGaps, 6);
  const PersonTouch& arm = lost.touches[0].link == 1 ? lost.touches[0] : lost.touches[1];
  EXPECT_LT(arm.endsS[0], arm.beginsS[1]);  // it passed, at no instant that is known
  EXPECT_NEAR(arm.beginsS[0], 0.2 + 0.3 / 1.2, 1e-4);
  // Who carries the arm takes it along.
  EXPECT_EQ(personTouches(flightWithGap(0), request(), bounds).value().counts.inGaps, 10);
}

/// The page's document of an answer, of which the first `poses` poses are shown.
json personOf(const ReplayInputs& inputs, const PersonAnswer& answer, int poses) {
  ViewDocument document;
  ViewAvatar avatar;
  avatar.avatar = &inputs.avatar;
  ViewTrack track;
  for (int i = 0; i < poses; ++i) track.poseTimesS.push_back(inputs.timeOfStep(i));
  track.rotations.assign(static_cast<std::size_t>(poses) * 8, 0.0);
  track.offsets.assign(6, 0.0);
  avatar.track = std::move(track);
  document.avatars.push_back(std::move(avatar));
  addPerson(inputs, request(), answer, document);
  return json::parse(test::textOf(document))["person"];
}

TEST(PersonTouches, StandInThePageAsFarAsItShowsPoses) {
  const ReplayInputs inputs = flight(12);
  const auto told = personTouches(inputs, request(), boundsOfHips(kMost, kStepS));
  ASSERT_TRUE(told.ok()) << describe(told.error());
  const PersonTouch& touch = told.value().touches[0];
  const json whole = personOf(inputs, told.value(), 12);
  EXPECT_EQ(whole["bounds"], "anna.bounds.json");
  EXPECT_EQ(whole["between"], "constant-rate");
  const json& shown = whole["touches"][0];
  EXPECT_EQ(shown["verdict"], "certain");
  EXPECT_EQ(shown["object"], "wall");
  EXPECT_EQ(shown["begins"], json({touch.beginsS[0], touch.beginsS[1]}));
  EXPECT_EQ(shown["ends"], json({touch.endsS[0], touch.endsS[1]}));
  EXPECT_FALSE(shown.contains("goes_on"));

  const json cut = personOf(inputs, told.value(), 7)["touches"][0];
  EXPECT_EQ(cut["goes_on"], true);
  EXPECT_EQ(cut["ends"][1], inputs.timeOfStep(6));
  EXPECT_TRUE(personOf(inputs, told.value(), 3)["touches"].empty());
}

}  // namespace
}  // namespace foretouch::tools
