// Acclaim's ASF and AMC: a small body whose places are known by hand, every refusal by file and
// line, and a take of CMU's beside its conversion to BVH by another program.
#include "assets/clip/acclaim.h"

#include <algorithm>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "assets/avatar/humanoid_rest.h"
#include "assets/bvh/bvh_reader.h"
#include "assets/clip/clip_file.h"
#include "assets/human_bones.h"
#include "tests/support/holds.h"
#include "tests/support/shared_data.h"
#include "tests/support/temp_folder.h"

namespace foretouch::test {
namespace {

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kDegree = 3.14159265358979323846 / 180.0;

const std::string kAsf = R"(# a comment
:version 1.10
:name small
:units
  mass 1.0
  length 0.5
  angle deg
:documentation
   .ast/.asf made by hand
:root
   order TX TY TZ RX RY RZ
   axis XYZ
   position 0 0 0
   orientation 0 0 0
:bonedata
  begin
     id 1
     name thigh
     direction 0 -2 0
     length 4
     axis 0 0 20 XYZ
    dof rx ry rz
    limits (-160.0 20.0)
           (-70.0 70.0)
           (-60.0 70.0)
  end
  begin
     id 2
     name shin
     direction 0 -1 0
     length 3
     axis 10 20 30 XYZ
    dof rx
    limits (-10.0 170.0)
  end
  begin
     id 3
     name plate
     direction 1 0 0
     length 2
     axis 0 0 0 XYZ
  end
:hierarchy
  begin
    root thigh plate
    thigh shin
  end
)";
const std::string kAmc = R"(#!OML:ASF
:FULLY-SPECIFIED
:DEGREES
1
root 1 2 3 10 20 30
thigh 40 50 60
shin 70
2
root 0 0 0 0 0 0
thigh 0 0 0
shin 90
)";

/// About fixed axes, x first: the specification's words.
Matrix3d xyz(double x, double y, double z) {
  return (AngleAxisd(z * kDegree, Vector3d::UnitZ()) * AngleAxisd(y * kDegree, Vector3d::UnitY()) *
          AngleAxisd(x * kDegree, Vector3d::UnitX()))
      .toRotationMatrix();
}

TEST(Acclaim, PutsBonesWhereTheSpecificationDoes) {
  const auto read = parseAcclaim(kAsf, "s.asf", kAmc, "s.amc", {0.1, 60.0});
  ASSERT_TRUE(read.ok()) << describe(read.error());
  const Clip& clip = read.value();
  ASSERT_EQ(clip.frames.size(), 2u);
  EXPECT_EQ(clip.frameTimeS, 1.0 / 60.0);
  EXPECT_TRUE(clip.notes.empty());
  const Skeleton& body = clip.skeleton;
  const auto at = [&](const char* name) {
    return static_cast<std::size_t>(body.find(name).value());
  };
  const std::vector<RigidPose> places = placesIn(body, clip.frames[0]);
  const Matrix3d root = xyz(10, 20, 30), c = xyz(0, 0, 20), shinC = xyz(10, 20, 30);
  const Matrix3d thigh = root * c * xyz(40, 50, 60) * c.transpose();
  const Matrix3d shin = thigh * shinC * xyz(70, 0, 0) * shinC.transpose();
  const Vector3d hip(0.1, 0.2, 0.3);
  EXPECT_LT((places[at("root")].translation - hip).norm(), 1e-12);
  EXPECT_LT((places[at("thigh")].translation - hip).norm(), 1e-12);
  const Vector3d knee = hip + thigh * Vector3d(0, -0.4, 0);
  EXPECT_LT((places[at("shin")].translation - knee).norm(), 1e-12);
  EXPECT_LT((places[at("shin")].rotation.toRotationMatrix() - shin).norm(), 1e-12);
  ASSERT_EQ(clip.endSites[at("shin")].size(), 1u);
  EXPECT_LT((clip.endSites[at("shin")][0] - Vector3d(0, -0.3, 0)).norm(), 1e-12);
  EXPECT_TRUE(clip.hasRotation[at("thigh")]);
  EXPECT_FALSE(clip.hasRotation[at("plate")]);
  EXPECT_TRUE(clip.hasTranslation[at("root")]);
}

TEST(Acclaim, SaysWhatItTakesForGranted) {
  const auto read = parseAcclaim(kAsf, "s.asf", kAmc, "s.amc");
  ASSERT_TRUE(read.ok());
  const Clip& clip = read.value();
  EXPECT_EQ(clip.frameTimeS, 1.0 / kAcclaimRateHz);
  EXPECT_NEAR(clip.frames[0].translations[0].x(), 0.0254 / 0.5, 1e-12);
  ASSERT_EQ(clip.notes.size(), 2u);
  EXPECT_TRUE(holds(clip.notes[0], "0.0508 m per unit")) << clip.notes[0];
  EXPECT_TRUE(holds(clip.notes[1], "120 Hz"));
}

TEST(Acclaim, NamesFileLineAndExpectation) {
  const auto with = [](std::string text, const std::string& from, const std::string& to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
  };
  struct Case {
    bool isAsf;
    const char *from, *to, *expected;
  };
  const std::vector<Case> cases{
      {true, ":root", ":boot", "s.asf:47: expected a section ':root'"},
      {true, ":hierarchy", ":heritage", "expected a section ':hierarchy'"},
      {true, "length 0.5", "length 0", "s.asf:6: expected a length above 0"},
      {true, "length 0.5", "length x", "s.asf:6: expected a number, found 'x'"},
      {true, "angle deg", "angle grad", "s.asf:7: expected 'deg' or 'rad'"},
      {true, "dof rx ry rz", "dof rx l", "s.asf:22: bone 'thigh' has a degree of freedom 'l'"},
      {true, "dof rx ry rz", "dof rx rx", "s.asf:22: bone 'thigh' has a degree of freedom twice"},
      {true, "axis 0 0 20 XYZ", "axis 0 0 20 XYY", "s.asf:21: expected three angles and an order"},
      {true, "name shin", "name thigh", "s.asf:27: two bones are called 'thigh'"},
      {true, "name shin", "name", "s.asf:29: expected one word after 'name'"},
      {true, "thigh shin", "thigh chin", "s.asf:46: no bone is called 'chin'"},
      {true, "thigh shin", "thigh plate", "s.asf:46: bone 'plate' has a parent already"},
      {true, "thigh shin", "shin thigh", "s.asf:46: bone 'thigh' has a parent already"},
      {true, "thigh plate\n", "thigh\n", "s.asf:36: bone 'plate' does not hang on the root"},
      {false, "thigh 40 50 60", "thigh 40 50",
       "s.amc:6: expected 3 numbers for bone 'thigh', found 2"},
      {false, "thigh 40 50 60\n", "", "s.amc:4: the frame says nothing of bone 'thigh'"},
      {false, "thigh 40 50 60", "shin 70", "s.amc:7: bone 'shin' is in the frame twice"},
      {false, "thigh 40", "tail 40", "s.amc:6: the skeleton has no bone 'tail'"},
      {false, "thigh 40", "thigh 4x", "s.amc:6: expected a number, found '4x'"},
      {false, "thigh 40", "thigh nan", "s.amc:6: expected a number, found 'nan'"},
      {false, "\n1\n", "\none\n", "s.amc:4: expected the number of a frame, found 'one'"},
      {false, "\n2\n", "\n4\n", "s.amc:8: expected frame 2, found '4'; frames that are missing"},
  };
  for (const Case& each : cases) {
    const std::string asf = each.isAsf ? with(kAsf, each.from, each.to) : kAsf;
    const std::string amc = each.isAsf ? kAmc : with(kAmc, each.from, each.to);
    const auto read = parseAcclaim(asf, "s.asf", amc, "s.amc");
    ASSERT_FALSE(read.ok()) << each.expected;
    EXPECT_TRUE(holds(describe(read.error()), each.expected)) << describe(read.error());
  }
}

TEST(Acclaim, BreaksOffAnywhereWithAnErrorOrAClip) {
  int clips = 0;
  for (std::size_t n = 0; n < kAsf.size(); ++n) {
    const auto read = parseAcclaim(kAsf.substr(0, n), "s.asf", kAmc, "s.amc");
    EXPECT_TRUE(read.ok() || !read.error().message.empty());
    clips += read.ok() ? 1 : 0;
  }
  EXPECT_GT(clips, 0);  // without the last 'end'
  for (std::size_t n = 0; n < kAmc.size(); ++n) {
    const auto read = parseAcclaim(kAsf, "s.asf", kAmc.substr(0, n), "s.amc");
    EXPECT_TRUE(read.ok() || read.error().file == "s.amc");
  }
}

TEST(Acclaim, FindsTheSkeletonBesideAMotion) {
  const TempFolder folder;
  const std::string amc = folder.write("01_02.amc", kAmc);
  const auto none = readClipFile(amc);
  ASSERT_FALSE(none.ok());
  EXPECT_TRUE(holds(describe(none.error()), "expected its ASF beside it"))
      << describe(none.error());
  static_cast<void>(folder.write("other.ASF", kAsf));
  EXPECT_TRUE(readClipFile(amc).ok());  // the only one
  static_cast<void>(folder.write("third.asf", kAsf));
  EXPECT_FALSE(readClipFile(amc).ok());
  EXPECT_EQ(skeletonBeside(amc).ok(), false);
  static_cast<void>(folder.write("01.asf", kAsf));
  EXPECT_EQ(skeletonBeside(amc).value(), folder / "01.asf");
  ClipFileOptions options;
  options.skeleton = folder / "none.asf";
  EXPECT_FALSE(readClipFile(amc, options).ok());
}

/// CMU's take 01_01, and its conversion by cgspeed (MotionBuilder): a frame more at the front,
/// where the BVH has a T-pose, and other lengths of bones. Turns of the limbs in the world agree.
TEST(Acclaim, AgreesWithAConversionOfTheSameTake) {
  FORETOUCH_REQUIRE_SHARED(amcPath, "mocap/cmu_01_01.amc");
  FORETOUCH_REQUIRE_SHARED(bvhPath, "mocap/cmu_01_01_playground_jumps.bvh");
  const auto amc = readClipFile(*amcPath);
  ASSERT_TRUE(amc.ok()) << describe(amc.error());
  const Clip& clip = amc.value().clip;
  const Clip bvh = readBvhFile(*bvhPath, {0.0254 / 0.45}).value();
  EXPECT_EQ(clip.frames.size(), 2751u);
  ASSERT_EQ(bvh.frames.size(), clip.frames.size() + 1);
  const std::vector<std::array<const char*, 4>> limbs{
      {"lfemur", "ltibia", "LeftUpLeg", "LeftLeg"},
      {"ltibia", "lfoot", "LeftLeg", "LeftFoot"},
      {"rfemur", "rtibia", "RightUpLeg", "RightLeg"},
      {"rtibia", "rfoot", "RightLeg", "RightFoot"},
      {"lhumerus", "lradius", "LeftArm", "LeftForeArm"},
      {"rhumerus", "rradius", "RightArm", "RightForeArm"}};
  double worstDeg = 0.0, worstHips = 0.0;
  for (std::size_t f = 0; f < clip.frames.size(); f += 50) {
    const auto a = placesIn(clip.skeleton, clip.frames[f]);
    const auto b = placesIn(bvh.skeleton, bvh.frames[f + 1]);
    const auto of = [](const std::vector<RigidPose>& places, const Skeleton& skeleton,
                       const char* name) {
      return places[static_cast<std::size_t>(skeleton.find(name).value())].translation;
    };
    worstHips =
        std::max(worstHips, (of(a, clip.skeleton, "root") - of(b, bvh.skeleton, "Hips")).norm());
    for (const auto& [from, to, bvhFrom, bvhTo] : limbs) {
      worstDeg =
          std::max(worstDeg, angleDeg(of(a, clip.skeleton, to) - of(a, clip.skeleton, from),
                                      of(b, bvh.skeleton, bvhTo) - of(b, bvh.skeleton, bvhFrom)));
    }
  }
  EXPECT_LT(worstHips, 0.001);
  EXPECT_LT(worstDeg, 1.0);
  EXPECT_FALSE(humanBonesOf(clip.skeleton).empty());
}

}  // namespace
}  // namespace foretouch::test
