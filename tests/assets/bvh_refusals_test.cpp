// What is refused: each with the code, the line and a word of what was expected.
#include <string>

#include <gtest/gtest.h>

#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_reader.h"
#include "tests/assets/bvh_samples.h"

namespace foretouch {
namespace {

using test::edited;
using test::editedAll;
using test::plainBvh;

void expectRefusal(const std::string& text, ErrorCode code, std::int64_t line,
                   const std::string& about) {
  const auto clip = parseBvh(text, "bad.bvh");
  ASSERT_FALSE(clip.ok()) << about;
  const Error& error = clip.error();
  EXPECT_STREQ(toString(error.code), toString(code)) << describe(error);
  EXPECT_EQ(error.line, line) << describe(error);
  EXPECT_EQ(error.file, "bad.bvh");
  EXPECT_NE(error.message.find(about), std::string::npos) << describe(error);
}

/// The plain sample with one place changed.
void expectRefusal(const std::string& from, const std::string& to, ErrorCode code,
                   std::int64_t line, const std::string& about) {
  expectRefusal(edited(plainBvh(), from, to), code, line, about);
}

TEST(ParseBvhRefuses, NumbersThatAreNotFinite) {
  for (const char* bad : {"nan", "NaN", "-nan", "inf", "-Infinity", "1e400", "-1e400",
                          "1e99999999999", "1.#QNAN", "-1.#IND00", "1.#INF"}) {
    SCOPED_TRACE(bad);
    const std::string word(bad);
    expectRefusal("OFFSET 0 2 0.5", "OFFSET 0 " + word + " 0.5", ErrorCode::NonFinite, 8, "OFFSET");
    expectRefusal("OFFSET 0 3 0", "OFFSET 0 3 " + word, ErrorCode::NonFinite, 12, "not finite");
    expectRefusal("-10 -20", "-10 " + word, ErrorCode::NonFinite, 20, "motion");
    expectRefusal("Time: 0.025", "Time: " + word, ErrorCode::NonFinite, 18, "frame time");
    expectRefusal("Frames: 2", "Frames: " + word, ErrorCode::NonFinite, 17, "number of frames");
  }
  const std::string long400 = "1" + std::string(400, '0');
  expectRefusal("-10 -20", "-10 " + long400, ErrorCode::NonFinite, 20, "not finite");
}

TEST(ParseBvhRefuses, WordsThatAreNotNumbers) {
  for (const char* bad :
       {"x", "0,5", "1e", "--1", "+-1", "+", "-", "0x10", "1.2.3", "1d5", "10%"}) {
    SCOPED_TRACE(bad);
    const std::string word(bad);
    expectRefusal("OFFSET 0 2 0.5", "OFFSET 0 " + word + " 0.5", ErrorCode::Syntax, 8, "OFFSET");
    expectRefusal("-10 -20", "-10 " + word, ErrorCode::Syntax, 20, "not a number");
  }
}

TEST(ParseBvhRefuses, FrameTimesThatAreNone) {
  for (const char* bad : {"0", "-0.025", "1e-9", "1e9", "-0"}) {
    expectRefusal("Time: 0.025", std::string("Time: ") + bad, ErrorCode::OutOfRange, 18,
                  "frame time");
  }
}

TEST(ParseBvhRefuses, FrameCountsThatAreNone) {
  expectRefusal("Frames: 2", "Frames: 0", ErrorCode::Empty, 17, "0 frames");
  expectRefusal("Frames: 2", "Frames: -5", ErrorCode::OutOfRange, 17, "whole number");
  expectRefusal("Frames: 2", "Frames: 1.5", ErrorCode::OutOfRange, 17, "whole number");
  expectRefusal("Frames: 2", "Frames: 2000000000", ErrorCode::LimitExceeded, 17, "at most");
  expectRefusal("Frames: 2", "Frames: 99999999999999999999", ErrorCode::LimitExceeded, 17,
                "at most");
  expectRefusal("Frames: 2", "Frames: two", ErrorCode::Syntax, 17, "number of frames");
}

TEST(ParseBvhRefuses, NoRows) {
  const std::string text = plainBvh();
  expectRefusal(text.substr(0, text.find("1 2 3")), ErrorCode::Syntax, 19, "row of 9 numbers");
}

TEST(ParseBvhRefuses, TruncatedLastRow) {
  expectRefusal(" -50 -60", "", ErrorCode::Syntax, 20, "7 of 9 values");
}

TEST(ParseBvhRefuses, ARowTooLongOrShortAndSaysWhereItBegan) {
  expectRefusal("1 2 3 10 20 30 40 50 60", "1 2 3 10 20 30 40 50 60 70", ErrorCode::Syntax, 20,
                "line 19 is the first");
  expectRefusal("1 2 3 10 20 30 40 50 60", "1 2 3 10 20 30 40 50", ErrorCode::Syntax, 20,
                "line 20 is the first");
}

TEST(ParseBvhRefuses, MissingMotion) {
  const std::string text = plainBvh();
  expectRefusal(text.substr(0, text.find("MOTION")), ErrorCode::Syntax, 16, "ROOT or MOTION");
  expectRefusal("MOTION\n", "", ErrorCode::Syntax, 16, "ROOT or MOTION");
  expectRefusal(text.substr(0, text.find("Frames")), ErrorCode::Syntax, 17, "Frames or Frame Time");
  expectRefusal("Frames: 2\n", "", ErrorCode::Syntax, 18, "expected Frames");
  expectRefusal("Frame Time: 0.025\n", "", ErrorCode::Syntax, 18, "expected Frame Time");
  expectRefusal("Frames: 2\n", "Frames: 2\nFrames: 2\n", ErrorCode::Syntax, 18,
                "expected Frame Time");
}

TEST(ParseBvhRefuses, EmptyAndForeignFiles) {
  expectRefusal("", ErrorCode::Empty, 1, "empty");
  expectRefusal(" \n\n\t", ErrorCode::Empty, 3, "empty");
  expectRefusal("\xef\xbb\xbf", ErrorCode::Empty, 1, "empty");
  expectRefusal("#!OML:ASF F:\n:FULLY-SPECIFIED\n", ErrorCode::Syntax, 1, "HIERARCHY");
  expectRefusal("HIERARCHY MOTION Frames: 1 Frame Time: 1 1", ErrorCode::Empty, 1, "ROOT");
  expectRefusal("ROOT Hips", "Hello there", ErrorCode::Syntax, 2, "ROOT or MOTION");
}

TEST(ParseBvhRefuses, BinaryContent) {
  std::string text = plainBvh();
  text[text.find("Spine")] = '\0';
  expectRefusal(text, ErrorCode::Syntax, 6, "control byte '\\x00'");
  expectRefusal("Spine", "Sp\x1b[31mine", ErrorCode::Syntax, 6, "control byte '\\x1b'");
  expectRefusal(std::string("H\0I\0", 4), ErrorCode::Syntax, 1, "UTF-16");
}

TEST(ParseBvhRefuses, LinesAreCountedAlikeInEveryEncoding) {
  const std::string bad = edited(plainBvh(), "-10 -20", "-10 oops");
  for (const char* end : {"\r\n", "\r"}) {
    expectRefusal(editedAll(bad, "\n", end), ErrorCode::Syntax, 20, "oops");
    expectRefusal(editedAll(edited(plainBvh(), "Spine", "\x01"), "\n", end), ErrorCode::Syntax, 6,
                  "control byte");
  }
}

TEST(ParseBvhRefuses, UnbalancedBraces) {
  expectRefusal("  }\n}\nMOTION", "  }\nMOTION", ErrorCode::Syntax, 15, "found 'MOTION'");
  expectRefusal("}\nMOTION", "}\n}\nMOTION", ErrorCode::Syntax, 16, "found '}'");
  const std::string text = plainBvh();
  expectRefusal(text.substr(0, text.find("  }\n}")), ErrorCode::Syntax, 14,
                "of line 6 is not closed");
  expectRefusal("ROOT Hips\n{", "ROOT Hips\n", ErrorCode::Syntax, 4, "expected '{'");
  expectRefusal("ROOT Hips\n{", "ROOT\n{", ErrorCode::Syntax, 3, "name");
}

TEST(ParseBvhRefuses, BadChannels) {
  const std::string good = "CHANNELS 3 Zrotation Xrotation Yrotation";
  expectRefusal(good, "CHANNELS 3 Zrotation Xrotation Zrotation", ErrorCode::DuplicateName, 9,
                "twice");
  expectRefusal(good, "CHANNELS 3 Zrotation Xrotation Wrotation", ErrorCode::Syntax, 9, "channel");
  expectRefusal(good, "CHANNELS 3 Xscale Yscale Zscale", ErrorCode::Syntax, 9, "Xposition");
  expectRefusal(good, "CHANNELS 2 Zrotation Xrotation Yrotation", ErrorCode::Syntax, 9,
                "Yrotation");
  expectRefusal(good, "CHANNELS 4 Zrotation Xrotation Yrotation", ErrorCode::Syntax, 10, "'End'");
  for (const char* count : {"7", "-1", "2.5", "nan", "x", "4000000000"}) {
    expectRefusal(good, std::string("CHANNELS ") + count, ErrorCode::Syntax, 9, "0 to 6 channels");
  }
  expectRefusal(good, good + "\n" + good, ErrorCode::DuplicateName, 10, "second CHANNELS");
  expectRefusal("OFFSET 0 3 0", "OFFSET 0 3 0 CHANNELS 1 Xrotation", ErrorCode::Syntax, 12,
                "no channels in an End Site");
}

TEST(ParseBvhRefuses, ChannelsAfterAChildJoint) {
  // Whose column comes first would be a guess.
  expectRefusal("}\nMOTION", "CHANNELS 1 Xposition\n}\nMOTION", ErrorCode::DuplicateName, 15,
                "second");
  const std::string channels =
      "  CHANNELS 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation\n";
  expectRefusal(
      edited(edited(plainBvh(), "}\nMOTION", channels + "}\nMOTION#"), "MOTION#", "MOTION")
          .replace(plainBvh().find(channels), channels.size(), ""),
      ErrorCode::Syntax, 14, "before the first child");
}

TEST(ParseBvhRefuses, NothingThatMoves) {
  std::string text = editedAll(plainBvh(), "CHANNELS", "CHANNELS 0 #");
  text = edited(text, " # 6 Xposition Yposition Zposition Zrotation Xrotation Yrotation", "");
  text = edited(text, " # 3 Zrotation Xrotation Yrotation", "");
  expectRefusal(text, ErrorCode::Empty, 17, "no joint has channels");
}

TEST(ParseBvhRefuses, MisplacedBlocks) {
  expectRefusal("OFFSET 0 3 0", "JOINT Deeper { OFFSET 0 0 0 }", ErrorCode::Syntax, 12, "End Site");
  expectRefusal("OFFSET 0 3 0", "OFFSET 0 3 0 OFFSET 0 3 0", ErrorCode::DuplicateName, 12,
                "second");
  expectRefusal("  JOINT Spine", "  ROOT Spine", ErrorCode::Syntax, 6, "JOINT");
  expectRefusal("OFFSET 0 2 0.5", "OFFSET 0 2", ErrorCode::Syntax, 9, "found 'CHANNELS'");
}

TEST(ParseBvhRefuses, TextAfterTheLastRow) {
  expectRefusal(plainBvh() + "MOTION\n", ErrorCode::Syntax, 21, "MOTION");
}

TEST(ParseBvhRefuses, ValuesOutOfRange) {
  expectRefusal("OFFSET 0 2 0.5", "OFFSET 0 2e7 0.5", ErrorCode::OutOfRange, 8, "1e7");
  expectRefusal("4 5 6 ", "4 5e8 6 ", ErrorCode::OutOfRange, 20, "1e7");
  expectRefusal("-10 -20", "-10 -1e7", ErrorCode::OutOfRange, 20, "degrees");
}

TEST(ParseBvhRefuses, ASkeletonTooDeep) {
  const auto nested = [](int depth) {
    std::string text = "HIERARCHY\nROOT r { OFFSET 0 0 0 CHANNELS 1 Xposition\n";
    for (int i = 1; i < depth; ++i) text += "JOINT j" + std::to_string(i) + " { OFFSET 0 1 0\n";
    for (int i = 0; i < depth; ++i) text += "}";
    return text + "\nMOTION\nFrames: 1\nFrame Time: 1\n0\n";
  };
  const auto deepest = parseBvh(nested(kMaxChainDepth), "t");
  ASSERT_TRUE(deepest.ok()) << describe(deepest.error());
  EXPECT_EQ(deepest.value().skeleton.numJoints(), kMaxChainDepth);
  expectRefusal(nested(kMaxChainDepth + 1), ErrorCode::LimitExceeded, kMaxChainDepth + 2, "deep");
  expectRefusal(nested(300000), ErrorCode::LimitExceeded, kMaxChainDepth + 2, "deep");
}

TEST(ParseBvhRefuses, TooManyJoints) {
  const auto wide = [](int joints) {
    std::string text = "HIERARCHY\nROOT r { OFFSET 0 0 0 CHANNELS 1 Xposition\n";
    for (int i = 1; i < joints; ++i) text += "JOINT j" + std::to_string(i) + " { OFFSET 0 1 0 }\n";
    return text + "}\nMOTION\nFrames: 1\nFrame Time: 1\n0\n";
  };
  const auto widest = parseBvh(wide(kMaxJoints), "t");
  ASSERT_TRUE(widest.ok()) << describe(widest.error());
  EXPECT_EQ(widest.value().skeleton.numJoints(), kMaxJoints);
  expectRefusal(wide(kMaxJoints + 1), ErrorCode::LimitExceeded, kMaxJoints + 2, "4096 joints");
}

TEST(ParseBvhRefuses, MoreJointPosesThanTheLimitThoughTheFileIsSmall) {
  // One channel moves 4096 joints: without counting every joint, 12 kB of rows would ask for 1.5
  // GB.
  std::string text = "HIERARCHY\nROOT r { OFFSET 0 0 0 CHANNELS 1 Xposition\n";
  for (int i = 1; i < kMaxJoints; ++i)
    text += "JOINT j" + std::to_string(i) + " { OFFSET 0 1 0 }\n";
  const std::size_t most = kMaxBvhValues / (3 * kMaxJoints);
  text += "}\nMOTION\nFrames: " + std::to_string(most + 1) + "\nFrame Time: 1\n0\n";
  expectRefusal(text, ErrorCode::LimitExceeded, kMaxJoints + 4, std::to_string(most) + " frames");
}

TEST(ParseBvhRefuses, WordsAndNamesWithoutEnd) {
  expectRefusal("-10 -20", "-10 " + std::string(kMaxBvhToken + 1, '1'), ErrorCode::LimitExceeded,
                20, "4096 bytes");
  expectRefusal("Spine", std::string(1u << 20, 'x'), ErrorCode::LimitExceeded, 6, "4096 bytes");
  std::string words;
  for (int i = 0; i < 1000; ++i) words += "word ";
  expectRefusal("Spine", words, ErrorCode::LimitExceeded, 6, "name of at most 1024");
}

TEST(ParseBvhRefuses, NamesWithControlCharacters) {
  expectRefusal("Spine",
                "S\xc2\x9b"
                "31m",
                ErrorCode::Syntax, 6, "control character");
}

TEST(ParseBvh, EveryTruncationIsAnsweredAndNoneCrashes) {
  const std::string text = plainBvh();
  int accepted = 0;
  for (std::size_t length = 0; length <= text.size(); ++length) {
    const auto clip = parseBvh(text.substr(0, length), "t");
    if (!clip.ok()) {
      EXPECT_FALSE(clip.error().message.empty());
      EXPECT_GE(clip.error().line, 1) << clip.error().message;
      continue;
    }
    ++accepted;
    EXPECT_GE(clip.value().frames.size(), 1u);
  }
  // The first frame from its last digits on (a shorter number is a number), up to the second's
  // first digit; and the second frame's end.
  EXPECT_GE(accepted, 4);
  EXPECT_LE(accepted, 8);
}

}  // namespace
}  // namespace foretouch
