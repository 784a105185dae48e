#include "assets/clip/clip_file.h"

#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"

namespace foretouch {
namespace {

TEST(ClipFormat, IsTheExtensions) {
  for (const char* path : {"a.glb", "a.GLTF", "b/c.Fbx", "a.dae", "a.bvh.x"}) {
    EXPECT_EQ(clipFormatOf(path), ClipFormat::Model) << path;
  }
  for (const char* path : {"a.csv", "a.CSV"}) {
    EXPECT_EQ(clipFormatOf(path), ClipFormat::JointTable) << path;
  }
  for (const char* path : {"a.bvh", "a", "", ".glb", "glb", "a.obj"}) {
    EXPECT_EQ(clipFormatOf(path), ClipFormat::Bvh) << path;
  }
}

TEST(ClipFile, ATableNamesItsRobot) {
  const auto clip = readClipFile("log.csv");
  ASSERT_FALSE(clip.ok());
  EXPECT_EQ(describe(clip.error()),
            "log.csv: joint positions are about a robot: expected its URDF");
}

TEST(ClipFile, ReadsBvhWithItsScale) {
  const test::TempFolder folder;
  const std::string path = folder.write(
      "a.bvh",
      "HIERARCHY\nROOT Hips\n{\nOFFSET 0 90 0\nCHANNELS 3 Xrotation Yrotation Zrotation\n"
      "End Site\n{\nOFFSET 0 10 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.01\n0 0 0\n");
  ClipFileOptions options;
  options.import.scale = 0.01;
  const auto read = readClipFile(path, options);
  ASSERT_TRUE(read.ok()) << describe(read.error());
  EXPECT_FALSE(read.value().isUpright);
  EXPECT_NEAR(read.value().clip.skeleton.restOffset(0).y(), 0.9, 1e-12);
}

}  // namespace
}  // namespace foretouch
