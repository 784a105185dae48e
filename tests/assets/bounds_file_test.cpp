// Files of bounds: what they say survives, what they cannot say is refused by name.
#include "assets/bounds/bounds_file.h"

#include <cmath>

#include <gtest/gtest.h>

#include "assets/bounds/bound_presets.h"

namespace foretouch {
namespace {

Skeleton person() {
  RawSkeleton raw;
  const auto add = [&raw](const char* name, JointId parent) {
    raw.joints.push_back({name, parent, Eigen::Vector3d(0.1, 0.2, 0.0), Quaternion::Identity()});
  };
  add("Hips", kNoParent);
  add("Head", 0);
  add("LeftHand", 0);
  add("RightHand", 0);
  add("widget", 0);
  return Skeleton::build(raw).value();
}

std::string fileWith(const std::string& entries) {
  return R"({"format": "foretouch-bounds", "version": 1, "bounds": [)" + entries + "]}";
}

std::string errorOf(const std::string& text) {
  const auto parsed = parseBounds(text, "b.json");
  return parsed.ok() ? "" : describe(parsed.error());
}

TEST(BoundsFile, SurvivesWritingBitForBit) {
  BoundsFile file;
  file.name = "Anna \"A\"";
  file.source = "learned";
  BoundEntry hand;
  hand.part = "hand";
  hand.model = MotionModel::CubicLate;
  hand.rateHz = 30.0;
  hand.bound.error = 0.1 + 0.2;
  hand.bound.acceleration = 1.0 / 3.0;
  hand.bound.followFloor = 1e-5;
  hand.bound.followShare = 0.0;
  hand.quantile = 0.999;
  hand.count = 12345;
  BoundEntry gap;
  gap.part = "all";
  gap.bound.speed = 7.0;
  file.entries = {hand, gap};
  const auto read = parseBounds(formatBounds(file), "b.json");
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_EQ(formatBounds(read.value()), formatBounds(file));
  EXPECT_EQ(read.value().entries[0].bound.error, hand.bound.error);
  EXPECT_EQ(read.value().entries[0].bound.followShare, 0.0);
  EXPECT_TRUE(std::isinf(read.value().entries[1].bound.acceleration));
}

TEST(BoundsFile, ANameCountsBeforeAPartAndAPartBeforeAll) {
  const auto file = parseBounds(fileWith(R"({"part": "all", "gap_speed_m_s": 9},
                  {"part": "all", "model": "cubic", "acceleration_m_s2": 1},
                  {"part": "hand", "model": "cubic", "acceleration_m_s2": 2, "error_m": 0.1},
                  {"link": "LeftHand", "model": "cubic", "acceleration_m_s2": 3})"),
                                "b.json");
  ASSERT_TRUE(file.ok()) << describe(file.error());
  const auto bounds = boundsOf(file.value(), person(), MotionModel::Cubic, 30.0);
  ASSERT_TRUE(bounds.ok()) << describe(bounds.error());
  const auto& of = bounds.value().bounds;
  EXPECT_EQ(of[1].acceleration, 1.0);
  EXPECT_EQ(of[2].acceleration, 3.0);
  EXPECT_EQ(of[2].error, 0.1);  // which its name does not say
  EXPECT_EQ(of[3].acceleration, 2.0);
  EXPECT_EQ(of[4].acceleration, 1.0);
  EXPECT_EQ(of[4].speed, 9.0);
}

TEST(BoundsFile, ARateOrAModelThatItIsNotAboutClaimsNothing) {
  const auto file = parseBounds(
      fileWith(R"({"part": "hand", "model": "cubic", "rate_hz": 30, "acceleration_m_s2": 2})"),
      "b.json");
  ASSERT_TRUE(file.ok());
  const auto near = boundsOf(file.value(), person(), MotionModel::Cubic, 29.0);
  ASSERT_TRUE(near.ok());
  EXPECT_EQ(near.value().bounds[2].acceleration, 2.0);
  EXPECT_TRUE(std::isinf(near.value().bounds[0].acceleration));
  EXPECT_EQ(near.value().entryOf[0], -1);
  for (const auto& [model, rate] :
       {std::pair{MotionModel::Cubic, 10.0}, std::pair{MotionModel::CubicLate, 30.0}}) {
    const auto none = boundsOf(file.value(), person(), model, rate);
    ASSERT_FALSE(none.ok());
    EXPECT_NE(describe(none.error()).find("cubic at 30 Hz"), std::string::npos);
  }
}

TEST(BoundsFile, RefusesWhatItCannotMean) {
  const auto refuses = [](const std::string& text, const std::string& says) {
    const std::string error = errorOf(text);
    EXPECT_NE(error.find(says), std::string::npos) << text << "\n" << error;
    EXPECT_NE(error.find("b.json"), std::string::npos) << error;
  };
  refuses("", "expected JSON");
  refuses("[]", "expected an object");
  refuses(R"({"format": "foretouch-avatar", "version": 1, "bounds": []})", "foretouch-bounds");
  refuses(R"({"format": "foretouch-bounds", "version": 2, "bounds": []})", "version");
  refuses(fileWith(""), "not empty");
  refuses(fileWith(R"({"acceleration_m_s2": 1})"), "either \"link\" or \"part\"");
  refuses(fileWith(R"({"part": "hnad"})"), "did you mean 'head', 'hand'");
  refuses(fileWith(R"({"part": "all", "aceleration_m_s2": 1})"), "unknown key");
  refuses(fileWith(R"({"part": "all", "error_m": -1})"), "bounds[0]: expected a number");
  refuses(fileWith(R"({"part": "all", "error_m": "1"})"), "expected a number");
  refuses(fileWith(R"({"part": "all", "error_m": 1, "error_m": 2})"), "appears twice");
  refuses(fileWith(R"({"part": "all", "acceleration_m_s2": 1})"), "expected \"model\"");
  refuses(fileWith(R"({"part": "all", "model": "cubic", "follow_floor_m": 1})"), "together");
  refuses(fileWith(R"({"part": "all", "model": "spline"})"), "constant-rate, cubic or cubic-late");
  refuses(fileWith(R"({"part": "all", "quantile": 1.5})"), "quantile");
  refuses(fileWith(R"({"part": "all", "error_m": 11})"), "from 0 to 10 for \"error_m\"");
  refuses(fileWith(R"({"part": "all", "gap_speed_m_s": 1001})"), "from 0 to 1000");
  refuses(fileWith(R"({"part": "all", "model": "cubic", "acceleration_m_s2": 2e6})"), "to 1e+06");
  refuses(fileWith(R"({"part": "all", "model": "cubic", "rate_hz": 10,
                       "acceleration_m_s2": 8001})"),
          "within 10 m of the model at 10 Hz, found 10 m");
  refuses(fileWith(R"([[[[1]]]])"), "brackets");
  refuses(std::string(std::size_t{5} << 20, ' '), "at most");
}

TEST(BoundsFile, NamesALinkThatTheAvatarDoesNotHave) {
  const auto file = parseBounds(
      fileWith(R"({"link": "LeftHnad", "model": "cubic", "acceleration_m_s2": 3})"), "b.json");
  ASSERT_TRUE(file.ok());
  const auto bounds = boundsOf(file.value(), person(), MotionModel::Cubic, 30.0);
  ASSERT_FALSE(bounds.ok());
  EXPECT_NE(describe(bounds.error()).find("did you mean 'LeftHand'"), std::string::npos);
}

TEST(BoundPresets, StandForAFile) {
  const auto file = readBounds("preset:sara-shield");
  ASSERT_TRUE(file.ok()) << describe(file.error());
  EXPECT_FALSE(file.value().source.empty());
  const auto known = boundsOf(file.value(), person(), MotionModel::ConstantRate, 30.0);
  ASSERT_TRUE(known.ok()) << describe(known.error());
  const std::vector<LinkBound>& bounds = known.value().bounds;
  // Twice 25 m/s^2 of trunk and head, twice 50 of hands, and of what has no known name.
  const double wanted[] = {50.0, 50.0, 100.0, 100.0, 100.0};
  for (std::size_t link = 0; link < bounds.size(); ++link) {
    EXPECT_EQ(bounds[link].acceleration, wanted[link]) << link;
    EXPECT_EQ(bounds[link].aheadAcceleration, wanted[link]) << link;
    EXPECT_EQ(bounds[link].aheadSpeed, 0.1);
    EXPECT_EQ(bounds[link].speed, 2.0);
    EXPECT_EQ(bounds[link].error, 0.0);
  }
  EXPECT_FALSE(boundsOf(file.value(), person(), MotionModel::Cubic, 30.0).ok());
}

TEST(BoundPresets, ClaimNothingOfWhatIsNotTracked) {
  const auto file = readBounds("preset:vr-trackers");
  ASSERT_TRUE(file.ok());
  const auto bounds = boundsOf(file.value(), person(), MotionModel::ConstantRate, 90.0).value();
  EXPECT_EQ(bounds.bounds[2].error, 0.042);
  EXPECT_EQ(bounds.bounds[2].aheadAcceleration, LinkBound::kNone);
  EXPECT_EQ(bounds.bounds[0].acceleration, LinkBound::kNone);
  EXPECT_EQ(bounds.entryOf[4], -1);
  EXPECT_EQ(readBounds("preset:optical").value().entries.back().bound.error, 0.002);
  const auto suit = readBounds("preset:inertial-suit");
  ASSERT_TRUE(suit.ok());
  const auto arms = boundsOf(suit.value(), person(), MotionModel::ConstantRate, 60.0).value();
  EXPECT_EQ(arms.bounds[2].error, 0.07);
  EXPECT_EQ(arms.bounds[0].acceleration, LinkBound::kNone);
}

TEST(BoundPresets, SayAtWhatQuantileTheirErrorHolds) {
  const auto file = readBounds("preset:markerless");
  ASSERT_TRUE(file.ok());
  for (const BoundEntry& entry : file.value().entries) {
    EXPECT_EQ(entry.quantile, 0.9);
    EXPECT_EQ(entry.bound.error, 0.04);
  }
}

TEST(BoundPresets, AreRefusedByNameWithThoseThatThereAre) {
  const auto none = readBounds("preset:optcal");
  ASSERT_FALSE(none.ok());
  const std::string said = describe(none.error());
  for (const char* const word :
       {"preset:sara-shield", "preset:optical", "preset:markerless", "preset:inertial-suit",
        "preset:vr-trackers", "'preset:optcal'", "did you mean"}) {
    EXPECT_NE(said.find(word), std::string::npos) << said;
  }
}

TEST(BoundPresets, SurviveWriting) {
  for (const char* const name : {"preset:sara-shield", "preset:optical", "preset:markerless",
                                 "preset:inertial-suit", "preset:vr-trackers"}) {
    const BoundsFile preset = readBounds(name).value();
    const std::string text = formatBounds(preset);
    const auto read = parseBounds(text, name);
    ASSERT_TRUE(read.ok()) << describe(read.error());
    EXPECT_EQ(formatBounds(read.value()), text);
  }
}

}  // namespace
}  // namespace foretouch
