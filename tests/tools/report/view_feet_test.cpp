// Oracle: a planted walk, whose feet are where plain arithmetic puts them.
#include "tools/report/view_feet.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/support/temp_folder.h"
#include "tests/tools/feet/planted_walk.h"
#include "tests/tools/report/view_reading.h"

namespace foretouch::tools {
namespace {

using nlohmann::json;
using test::Place;
using test::PlantedFoot;

/// The left foot stands and slides by 20 mm; the right one steps, and sinks in by 8 mm.
nlohmann::json feetOfAWalk() {
  PlantedFoot left, right;
  left.stances = {{{0, 0, 0}, {0, 0, 0.02}, 0.0, 1.6}};
  right.stances = {{{0, 0, 0.2}, {0, 0, 0.2}, 0.0, 0.6},
                   {{0.5, -0.008, 0.2}, {0.5, -0.008, 0.2}, 1.0, 1.6}};
  std::vector<Place> leftSoles, rightSoles;
  for (int frame = 0; frame <= 160; ++frame) {
    leftSoles.push_back(left.soleAt(0.01 * frame));
    rightSoles.push_back(right.soleAt(0.01 * frame));
  }
  const test::TempFolder folder;
  ReplayRequest request;
  request.motionPath = folder.write("walk.bvh", test::walkBvh(leftSoles, rightSoles, 0.01));
  request.avatarPath = folder.write("walker.json", test::kWalkerAvatar);
  request.scenePath = folder.write(
      "floor.obj", "o floor\nv -9 0 -9\nv 9 0 -9\nv 9 0 9\nv -9 0 9\nf 1 2 3\nf 1 3 4\n");
  const auto inputs = loadReplayInputs(request);
  EXPECT_TRUE(inputs.ok()) << describe(inputs.error());
  ViewDocument document;
  addFeet(inputs.value(), inputs.value().steps.count, document);
  EXPECT_TRUE(document.notes.empty()) << document.notes.front();
  return json::parse(test::textOf(document))["feet"];
}

TEST(ViewFeet, HoldTheTouchesOfWholeFeetWithSlideDepthAndTrace) {
  const json feet = feetOfAWalk();
  ASSERT_EQ(feet.size(), 2u);
  ASSERT_EQ(feet[0]["stances"].size(), 1u) << "heel, ball and toe are one touch";
  const json& slides = feet[0]["stances"][0];
  EXPECT_EQ(slides["kind"], "touches");
  EXPECT_EQ(slides["began_before"], true);
  EXPECT_NEAR(slides["slide"].get<double>(), 0.02, 0.001);
  EXPECT_NEAR(slides["depth"].get<double>(), 0.0, 0.001);
  const json& trace = slides["trace"];
  EXPECT_NEAR(trace.back()[2].get<double>() - trace.front()[2].get<double>(), 0.02, 0.001);
  EXPECT_NEAR(trace.back()[0].get<double>() - trace.front()[0].get<double>(), 0.0, 0.001);
  EXPECT_NEAR(trace.front()[1].get<double>(), 0.0, 0.001) << "on the floor";

  ASSERT_EQ(feet[1]["stances"].size(), 2u);
  const json& sinks = feet[1]["stances"][1];
  EXPECT_NEAR(sinks["depth"].get<double>(), 0.008, 0.001);
  EXPECT_GE(sinks["depth_at"].get<double>(), 1.0);
  EXPECT_EQ(sinks.count("trace"), 0u) << "it does not slide";
  EXPECT_EQ(sinks["goes_on"], true);
}

}  // namespace
}  // namespace foretouch::tools
