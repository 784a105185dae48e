#include "tools/settings/project_file.h"

#include <set>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/temp_folder.h"
#include "tools/settings/clip_settings.h"
#include "tools/settings/file_mark.h"
#include "tools/settings/world_settings.h"
#include "tools/stream/serve_config.h"

namespace foretouch::tools {
namespace {

/// The settings of a command that plays a clip, and what a user typed of them.
struct Asked {
  WorldRequest world;
  ClipRequest clip;
  Settings settings;
  std::set<std::string> typed;

  Asked() {
    addSceneSettings(settings, world);
    addAvatarSetting(settings, clip);
    addMotionSetting(settings, clip, "--motion", "CLIP");
    addRateSetting(settings, clip);
    addClipSettings(settings, clip);
    addQuerySettings(settings, world);
    addReplayQuerySettings(settings, world);
  }

  Result<std::vector<std::string>> take(const std::string& path) {
    return takeFromProject(
        path, settings, [this](const Setting& setting) { return typed.count(setting.name()) > 0; });
  }
};

class ProjectFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("room.obj", "o a\n");
    folder_.write("man.json", "{}");
    folder_.write("walk.bvh", "HIERARCHY\n");
  }

  std::string write(const std::string& more = "") const {
    return folder_.write("foretouch.toml",
                         "[scene]\nfile = \"room.obj\"\nscale = 0.01\nup = \"z\"\n"
                         "[[avatar]]\nfile = \"man.json\"\n"
                         "[clip]\nfile = \"walk.bvh\"\nscale = 0.0564\nplace = \"1,2,3,90\"\n"
                         "rate = 10\n[query]\ntolerance = 0.002\nself = true\n" +
                             more);
  }

  std::string errorOf(const std::string& more) const {
    Asked asked;
    const auto taken = asked.take(write(more));
    return taken.ok() ? "accepted" : describe(taken.error());
  }

  test::TempFolder folder_;
};

TEST_F(ProjectFile, FillsWhatIsNotTyped) {
  Asked asked;
  asked.typed = {"--clip-scale"};
  const auto notes = asked.take(write());
  ASSERT_TRUE(notes.ok()) << describe(notes.error());
  EXPECT_TRUE(notes.value().empty());
  EXPECT_EQ(asked.world.scenePath, folder_ / "room.obj");
  EXPECT_EQ(asked.world.sceneImport.scale, 0.01);
  EXPECT_EQ(asked.world.sceneImport.up, UpAxis::Z);
  EXPECT_EQ(asked.clip.avatarPath, folder_ / "man.json");
  EXPECT_EQ(asked.clip.motionPath, folder_ / "walk.bvh");
  EXPECT_FALSE(asked.clip.motionScale) << "typed: the command line's";
  EXPECT_EQ(asked.clip.placement.origin, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(asked.clip.placement.yawDeg, 90.0);
  EXPECT_EQ(asked.clip.rateHz, 10.0);
  EXPECT_EQ(asked.world.query.tolerance, 0.002);
  EXPECT_TRUE(asked.world.asksSelf);
}

TEST_F(ProjectFile, ATableAboutAnotherFileIsNotTakenAndSaid) {
  Asked asked;
  asked.typed = {"--motion"};
  const auto notes = asked.take(write());
  ASSERT_TRUE(notes.ok()) << describe(notes.error());
  EXPECT_FALSE(asked.clip.motionScale);
  EXPECT_EQ(asked.clip.placement.origin, Eigen::Vector3d::Zero());
  EXPECT_EQ(asked.world.sceneImport.scale, 0.01) << "another table";
  ASSERT_EQ(notes.value().size(), 1u);
  EXPECT_NE(notes.value()[0].find("[clip]"), std::string::npos) << notes.value()[0];
}

TEST_F(ProjectFile, ErrorsNameLineAndKey) {
  EXPECT_NE(errorOf("[clop]\n").find("unknown key 'clop'"), std::string::npos);
  EXPECT_NE(errorOf("[stream]\nconfirmation = 2\n").find("confirmations"), std::string::npos);
  const std::string wrong = errorOf("fidelity = \"exakt\"\n");
  EXPECT_NE(wrong.find("foretouch.toml:15: [query] fidelity"), std::string::npos) << wrong;
  EXPECT_NE(errorOf("[service]\nworkers = 0\n").find("workers"), std::string::npos)
      << "checked though this command does not need it";
}

TEST_F(ProjectFile, AFileThatIsGoneIsNamedWithItsLine) {
  const std::string path = write();
  std::filesystem::remove(folder_ / "walk.bvh");
  Asked asked;
  const auto taken = asked.take(path);
  ASSERT_FALSE(taken.ok());
  EXPECT_EQ(taken.error().line, 8);
  EXPECT_NE(describe(taken.error()).find("walk.bvh"), std::string::npos);
  asked.typed = {"--motion"};
  EXPECT_TRUE(asked.take(path).ok()) << "the command line names another one";
}

TEST_F(ProjectFile, AFileThatHasChangedIsSaid) {
  const std::string mark = markOfFile(folder_ / "room.obj").value();
  const std::string path = write("[made]\nscene = \"" + mark + "\"\n");
  Asked same;
  EXPECT_TRUE(same.take(path).value().empty());
  folder_.write("room.obj", "o b\n");
  Asked changed;
  const auto notes = changed.take(path);
  ASSERT_TRUE(notes.ok());
  ASSERT_EQ(notes.value().size(), 1u);
  EXPECT_NE(notes.value()[0].find("room.obj' has changed"), std::string::npos) << notes.value()[0];
}

TEST_F(ProjectFile, SeveralAvatarsAreForLogsAndServices) {
  Asked asked;
  const auto taken = asked.take(write("[[avatar]]\nid = 2\nfile = \"man.json\"\n"));
  ASSERT_FALSE(taken.ok());
  EXPECT_NE(describe(taken.error()).find("expected one, found 2"), std::string::npos);
}

TEST_F(ProjectFile, PoliciesAreTheProjectsOwn) {
  Asked asked;
  const std::string path = write("[[policy]]\nlinks = [\"*\"]\ntolerance = 0.01\n");
  ASSERT_TRUE(asked.take(path).ok());
  EXPECT_EQ(asked.world.policyPath, path);
}

TEST_F(ProjectFile, WhatSetupWritesIsReadBackAndServed) {
  Project project;
  project.scene = "room.obj";
  project.avatar = "man.json";
  project.clip = "walk.bvh";
  project.clipLines = "animation = \"a \\\"quoted\\\" name\"\n";
  project.robot = "g1.urdf";
  project.packages = {"a folder", "b"};
  project.sceneUp = UpAxis::Z;
  project.clipScale = 0.0564;
  project.place = "-1.5,0.071,2,270";
  const auto text = projectText(project, folder_.path());
  ASSERT_TRUE(text.ok()) << describe(text.error());
  const std::string path = folder_.write("foretouch.toml", text.value());
  Asked asked;
  const auto notes = asked.take(path);
  ASSERT_TRUE(notes.ok()) << describe(notes.error());
  EXPECT_TRUE(notes.value().empty());
  EXPECT_FALSE(asked.world.sceneImport.scale) << "as the file says";
  EXPECT_EQ(asked.world.sceneImport.up, UpAxis::Z);
  EXPECT_EQ(asked.clip.motionScale, 0.0564);
  EXPECT_EQ(asked.clip.animation, "a \"quoted\" name");
  EXPECT_EQ(asked.clip.robotPath, folder_ / "g1.urdf");
  EXPECT_EQ(asked.clip.packagePaths,
            (std::vector<std::string>{folder_ / "a folder", folder_ / "b"}));
  EXPECT_EQ(asked.clip.placement.origin, Eigen::Vector3d(-1.5, 0.071, 2));

  const auto served = readServeConfig(path);
  ASSERT_TRUE(served.ok()) << describe(served.error());
  EXPECT_EQ(served.value().world.scenePath, folder_ / "room.obj");
  EXPECT_EQ(served.value().avatars.size(), 1u);
}

}  // namespace
}  // namespace foretouch::tools
