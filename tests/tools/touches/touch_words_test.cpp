#include "tools/replay/touch_words.h"

#include <gtest/gtest.h>

#include "tests/support/holds.h"
#include "tests/tools/small_inputs.h"

namespace foretouch::tools {
namespace {

using test::holds;

class Headline : public testing::Test {
 protected:
  std::string of(std::int64_t touches, std::int64_t missed, std::int64_t ground = 0) {
    return touchHeadline(inputs_, {touches, missed, ground, 0});
  }

  ReplayInputs inputs_ = test::smallInputs({0, 1});
};

TEST_F(Headline, IsWhatAPersonSays) {
  EXPECT_EQ(of(137, 87),
            "The man touches the wall 137 times. Checking the poses alone would miss 87 of "
            "them.\n\n");
  EXPECT_EQ(of(1, 1), "The man touches the wall once. Checking the poses alone would miss it.\n\n");
  EXPECT_EQ(of(1, 0),
            "The man touches the wall once. Checking the poses alone would not miss it.\n\n");
  EXPECT_EQ(of(2, 2),
            "The man touches the wall twice. Checking the poses alone would miss both.\n\n");
  EXPECT_EQ(of(5, 5),
            "The man touches the wall 5 times. Checking the poses alone would miss all 5.\n\n");
  EXPECT_EQ(
      of(5, 0),
      "The man touches the wall 5 times. Checking the poses alone would miss none of them.\n\n");
  EXPECT_EQ(of(0, 0), "The man touches nothing of the wall.\n\n");
}

TEST_F(Headline, QuotesNamesThatAreNoWords) {
  inputs_.request.avatarPath = "some/pab_run 2.avatar.json";
  inputs_.request.scenePath = "some/\x1b[31m.obj";
  const std::string text = of(3, 1);
  EXPECT_TRUE(holds(text, "'pab_run 2' touches ")) << text;
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << text;
}

TEST_F(Headline, CountsTheGroundApartAndSaysWhatItHides) {
  const std::string hidden = "told by --scope objects only";
  EXPECT_TRUE(holds(of(3, 1, 12), "The ground is counted apart: 12 times.\n"));
  EXPECT_FALSE(holds(of(3, 1, 12), hidden)) << "followed from enter to leave";
  inputs_.query.passSeparating = true;
  EXPECT_TRUE(holds(of(3, 1, 12), hidden));
  EXPECT_TRUE(holds(of(0, 0, 1), "The man touches nothing but the ground of the wall.\n"));
  EXPECT_FALSE(holds(of(3, 1), hidden));
  inputs_.request.ground.use = GroundUse::Ignore;
  EXPECT_TRUE(holds(of(3, 1, 2), "The ground, which is not listed: twice.\n"));
  inputs_.query.scope = Scope::EveryObject;
  EXPECT_FALSE(holds(of(3, 1, 12), hidden));
}

TEST_F(Headline, TellsOfOwnLinksWhereTheyAreAsked) {
  EXPECT_FALSE(holds(of(1, 0), "own links"));
  inputs_.query.self = PairRules::leavingOut(inputs_.avatar, {}).value();
  EXPECT_TRUE(holds(of(1, 0), "Its own links touch each other never.\n"));
}

TEST(TouchTable, ListsLinksThatTouchByTheirTouches) {
  const ReplayInputs inputs = test::smallInputs({0, 1});
  std::vector<LinkTouches> rows(2);
  EXPECT_EQ(touchTable(inputs.avatar.skeleton(), rows), "");
  rows[0] = {{1, 0, 4, 0}, 0.25};
  rows[1] = {{2, 1, 0, 0}, 1.5};
  const std::string text = touchTable(inputs.avatar.skeleton(), rows);
  EXPECT_TRUE(holds(text,
                    "Arm                                      2                 1         0"
                    "       1.500\nHips"))
      << text;
}

}  // namespace
}  // namespace foretouch::tools
