// The corpora of messages and configurations, with any compiler.
#include <gtest/gtest.h>

#include "tests/fuzz/config_inputs.h"
#include "tests/fuzz/http_inputs.h"
#include "tests/fuzz/message_inputs.h"
#include "tests/fuzz/replay_corpus.h"
#include "tests/fuzz/shown_inputs.h"
#include "tests/fuzz/text_inputs.h"
#include "tests/fuzz/world_inputs.h"

namespace foretouch::fuzz {
namespace {

TEST(FuzzCorpus, MessagesKeepThePromises) {
  EXPECT_GE(
      replayCorpus("skeleton_message", feedSkeletonMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(replayCorpus("pose_message", feedPoseMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(
      replayCorpus("contacts_message", feedContactsMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(replayCorpus("solid_message", feedSolidMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(replayCorpus("person_message", feedPersonMessage, AlsoFeed::LastByteMissing).accepted,
            3);
  EXPECT_GE(replayCorpus("speaker_message", feedSpeakerMessage, AlsoFeed::EveryBeginning).accepted,
            3);
  EXPECT_GE(replayCorpus("status_message", feedStatusMessage, AlsoFeed::LastByteMissing).accepted,
            3);
  EXPECT_GE(replayCorpus("body_message", feedBodyMessage, AlsoFeed::LastByteMissing).accepted, 3);
  EXPECT_GE(
      replayCorpus("rigid_pose_message", feedRigidPoseMessage, AlsoFeed::LastByteMissing).accepted,
      3);
  EXPECT_GE(replayCorpus("events_message", feedEventsMessage, AlsoFeed::LastByteMissing).accepted,
            3);
  EXPECT_GE(replayCorpus("pushes_message", feedPushesMessage, AlsoFeed::LastByteMissing).accepted,
            3);
}

TEST(FuzzCorpus, ConfigurationsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("config", feedConfig, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 3);
}

TEST(FuzzCorpus, TextsOfPeopleKeepThePromises) {
  const CorpusCounts tables = replayCorpus("csv", feedJointTable, AlsoFeed::EveryBeginning);
  EXPECT_GE(tables.accepted, 3);
  EXPECT_GE(tables.refused, 4);
  const CorpusCounts arrays = replayCorpus("npz", feedNpz, AlsoFeed::EveryBeginning);
  EXPECT_GE(arrays.accepted, 2);
  EXPECT_GE(arrays.refused, 2);
  const CorpusCounts maps = replayCorpus("joint_map", feedJointMap, AlsoFeed::EveryBeginning);
  EXPECT_GE(maps.accepted, 2);
  EXPECT_GE(maps.refused, 3);
  const CorpusCounts urls = replayCorpus("url", feedUrl, AlsoFeed::EveryBeginning);
  EXPECT_GE(urls.accepted, 4);
  EXPECT_GE(urls.refused, 3);
  const CorpusCounts projects = replayCorpus("project", feedProject, AlsoFeed::LastByteMissing);
  EXPECT_GE(projects.accepted, 1);
  EXPECT_GE(projects.refused, 3);
}

TEST(FuzzCorpus, WorldsKeepThePromises) {
  const CorpusCounts worlds = replayCorpus("world_file", feedWorldFile, AlsoFeed::EveryBeginning);
  EXPECT_GE(worlds.accepted, 4);
  EXPECT_GE(worlds.refused, 5);
  const CorpusCounts poses = replayCorpus("rigid_poses", feedRigidPoses, AlsoFeed::EveryBeginning);
  EXPECT_GE(poses.accepted, 3);
  EXPECT_GE(poses.refused, 5);
}

TEST(FuzzCorpus, ShownPosesKeepThePromises) {
  const CorpusCounts counts =
      replayCorpus("shown_poses", feedShownPoses, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 3);
  EXPECT_GE(counts.refused, 5);
}

TEST(FuzzCorpus, RequestsKeepThePromises) {
  const CorpusCounts counts = replayCorpus("http", feedHttp, AlsoFeed::LastByteMissing);
  EXPECT_GE(counts.accepted, 1);
  EXPECT_GE(counts.refused, 5);
}

}  // namespace
}  // namespace foretouch::fuzz
