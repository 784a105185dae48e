#include "assets/bvh/bvh_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/bvh/bvh_hierarchy.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_text.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch {
namespace {

using internal::BvhChannel;
using internal::bvhError;
using internal::bvhExpected;
using internal::BvhHierarchy;
using internal::BvhNumber;
using internal::BvhScanner;
using internal::BvhWord;
using internal::ClipNotes;
using internal::isKeyword;

/// "Frames: 10", "Frames :10", "Frame Time:0.03", "FrameTime : .03": a colon, or none.
BvhWord wordAfterColon(BvhScanner& scanner) {
  constexpr auto kSeparate = BvhScanner::Colon::Separate;
  if (scanner.peek(kSeparate).text == ":") static_cast<void>(scanner.next(kSeparate));
  return scanner.peek();
}

Result<std::size_t> frameCount(BvhScanner& scanner, std::size_t valuesPerFrame) {
  const BvhWord word = wordAfterColon(scanner);
  const auto number = internal::nextNumber(scanner, "the number of frames");
  if (!number.ok()) return number.error();
  const double count = number.value();
  if (count == 0.0) {
    return bvhError(ErrorCode::Empty, word.line,
                    "the file declares 0 frames, expected one or more");
  }
  if (count < 0.0 || count != std::floor(count)) {
    return bvhError(ErrorCode::OutOfRange, word.line,
                    "expected a whole number of frames, found " + inQuotes(word.text));
  }
  if (count > static_cast<double>(kMaxBvhValues / valuesPerFrame)) {
    return bvhError(ErrorCode::LimitExceeded, word.line,
                    "expected at most " + std::to_string(kMaxBvhValues / valuesPerFrame) +
                        " frames of this skeleton, found " + inQuotes(word.text));
  }
  return static_cast<std::size_t>(count);
}

Result<double> frameTime(BvhScanner& scanner) {
  const BvhWord word = wordAfterColon(scanner);
  const auto number = internal::nextNumber(scanner, "the frame time");
  if (!number.ok()) return number.error();
  if (number.value() >= kMinFrameTimeS && number.value() <= kMaxFrameTimeS) return number;
  return bvhError(ErrorCode::OutOfRange, word.line,
                  "expected a frame time of 1e-6 to 3600 seconds, found " + inQuotes(word.text));
}

}  // namespace

Result<internal::BvhMotionHeader> internal::readBvhMotionHeader(BvhScanner& scanner,
                                                                std::size_t valuesPerFrame) {
  constexpr auto kSeparate = BvhScanner::Colon::Separate;
  std::optional<std::size_t> frames;
  std::optional<double> timeS;
  while (!frames || !timeS) {
    const BvhWord word = scanner.next(kSeparate);
    const bool isTime =
        isKeyword(word.text, "frametime") || isKeyword(word.text, "frame_time") ||
        (isKeyword(word.text, "frame") && isKeyword(scanner.peek(kSeparate).text, "time"));
    if (isKeyword(word.text, "frames") && !frames) {
      FORETOUCH_TRY(frames, frameCount(scanner, valuesPerFrame));
    } else if (isTime && !timeS) {
      if (isKeyword(word.text, "frame")) static_cast<void>(scanner.next(kSeparate));
      FORETOUCH_TRY(timeS, frameTime(scanner));
    } else {
      return bvhExpected(frames ? "Frame Time" : timeS ? "Frames" : "Frames or Frame Time", word);
    }
  }
  return BvhMotionHeader{*frames, *timeS};
}

namespace {

/// The rotation of one Euler angle. Half the angle in radians is off by at most 2 unit roundoffs of
/// itself (one for the constant, one for the product), so the turn is by 4.4e-16 of the angle:
/// 1e-15 rad at half a turn, 8e-12 rad at kMaxBvhAngleDeg. Files write 1e-6 degrees at best.
Quaternion turnAbout(int axis, double angleDeg) {
  constexpr double kHalfRadiansPerDegree = 3.14159265358979323846 / 360.0;
  const double half = angleDeg * kHalfRadiansPerDegree;
  Quaternion q(std::cos(half), 0.0, 0.0, 0.0);
  q.vec()[axis] = std::sin(half);
  return q;
}

/// Turns rows of numbers into poses.
class MotionReader {
 public:
  MotionReader(BvhScanner& scanner, const BvhHierarchy& hierarchy, double scale, Clip& clip)
      : scanner_(scanner),
        hierarchy_(hierarchy),
        scale_(scale),
        clip_(clip),
        rest_(restPose(clip.skeleton)),
        row_(hierarchy.numChannels) {}

  /// Counts frames by values; notes if lines and frames disagree.
  std::optional<Error> read(std::size_t maxFrames, ClipNotes& notes);

 private:
  std::optional<Error> addFrame();
  [[nodiscard]] Error truncated(std::size_t found) const;

  BvhScanner& scanner_;
  const BvhHierarchy& hierarchy_;
  double scale_;
  Clip& clip_;
  Pose rest_;
  std::vector<double> row_;
  std::int64_t line_ = 0;          // of the last value read
  std::int64_t lastFrameEnd_ = 0;  // line
  std::int64_t oddLine_ = 0;       // the first line that does not hold exactly one frame
};

std::optional<Error> MotionReader::read(std::size_t maxFrames, ClipNotes& notes) {
  for (std::size_t i = 0;; i = (i + 1) % row_.size()) {
    const BvhWord word = scanner_.next();
    if (word.text.empty()) {
      if (i != 0) return truncated(i);
      break;
    }
    const BvhNumber number = internal::readBvhNumber(word.text);
    if (number.problem != nullptr) {
      return bvhError(number.code, word.line,
                      "expected a number in the motion, found " + inQuotes(word.text) + ", which " +
                          number.problem);
    }
    // A frame starts on a line of its own and stays there.
    const bool isOdd = i == 0 ? word.line == lastFrameEnd_ : word.line != line_;
    if (isOdd && oddLine_ == 0) oddLine_ = word.line;
    line_ = word.line;
    row_[i] = number.value;
    if (i + 1 < row_.size()) continue;
    if (clip_.frames.size() == maxFrames) {
      return bvhError(ErrorCode::LimitExceeded, line_,
                      "expected at most " + std::to_string(maxFrames) + " frames of this skeleton");
    }
    if (auto error = addFrame()) return error;
    lastFrameEnd_ = line_;
  }
  if (oddLine_ != 0) {
    notes.add("line " + std::to_string(oddLine_) +
              ": lines do not hold one frame each; frames are counted by their values");
  }
  return std::nullopt;
}

Error MotionReader::truncated(std::size_t found) const {
  std::string message = "the last frame has " + std::to_string(found) + " of " +
                        std::to_string(row_.size()) + " values";
  if (oddLine_ != 0) {
    message += "; line " + std::to_string(oddLine_) + " is the first that does not hold one frame";
  }
  return bvhError(ErrorCode::Syntax, line_, std::move(message));
}

std::optional<Error> MotionReader::addFrame() {
  Pose pose = rest_;
  std::size_t column = 0;
  for (std::size_t j = 0; j < hierarchy_.channels.size(); ++j) {
    for (const BvhChannel& channel : hierarchy_.channels[j]) {
      const double value = row_[column++];
      if (!channel.isRotation) {
        pose.translations[j][channel.axis] = value * scale_;
      } else if (std::abs(value) > kMaxBvhAngleDeg) {
        return bvhError(ErrorCode::OutOfRange, line_,
                        "expected angles of at most 1e6 degrees, found " + std::to_string(value));
      } else {
        pose.rotations[j] = pose.rotations[j] * turnAbout(channel.axis, value);
      }
    }
  }
  auto validated = validatedPose(clip_.skeleton, std::move(pose));
  if (!validated.ok()) {
    Error error = validated.error();
    error.line = line_;
    return error;
  }
  clip_.frames.push_back(std::move(validated).value());
  return std::nullopt;
}

Result<Clip> emptyClip(const BvhHierarchy& hierarchy) {
  auto skeleton = Skeleton::build(hierarchy.skeleton);
  if (!skeleton.ok()) {
    Error error = skeleton.error();
    if (error.index >= 0) error.line = hierarchy.lines[slotOf(error.index)];
    return error;
  }
  Clip clip;
  clip.skeleton = std::move(skeleton).value();
  clip.endSites = hierarchy.endSites;
  for (const auto& channels : hierarchy.channels) {
    const auto rotates = [](const BvhChannel& channel) { return channel.isRotation; };
    const auto rotations = std::count_if(channels.begin(), channels.end(), rotates);
    clip.hasRotation.push_back(rotations > 0);
    clip.hasTranslation.push_back(static_cast<std::size_t>(rotations) < channels.size());
  }
  return clip;
}

Result<Clip> readClip(std::string_view text, double scale) {
  if (auto error = internal::binaryContent(text)) return *std::move(error);
  BvhScanner scanner(text);
  ClipNotes notes;
  FORETOUCH_TRY(const auto hierarchy, internal::readBvhHierarchy(scanner, scale, notes));
  auto result = emptyClip(hierarchy);
  if (!result.ok()) return result;
  Clip& clip = result.value();
  const std::size_t channels = hierarchy.numChannels;
  if (channels == 0) {
    return bvhError(ErrorCode::Empty, scanner.peek().line, "no joint has channels, nothing moves");
  }
  const std::size_t valuesPerFrame = std::max(channels, 3 * clip.endSites.size());
  FORETOUCH_TRY(const auto header, internal::readBvhMotionHeader(scanner, valuesPerFrame));
  clip.frameTimeS = header.frameTimeS;

  MotionReader motion(scanner, hierarchy, scale, clip);
  if (auto error = motion.read(kMaxBvhValues / valuesPerFrame, notes)) return *std::move(error);
  if (clip.frames.empty()) {
    return bvhExpected("a row of " + std::to_string(channels) + " numbers", scanner.peek());
  }
  if (clip.frames.size() != header.declaredFrames) {
    notes.add("the file declares " + std::to_string(header.declaredFrames) + " frames and holds " +
              std::to_string(clip.frames.size()) + "; these are used");
  }
  clip.notes = notes.take();
  return result;
}

}  // namespace

Result<Clip> parseBvh(std::string_view text, const std::string& name, const BvhOptions& options) {
  if (!(options.scale > 0.0) || !std::isfinite(options.scale)) {
    return Error::in(name, ErrorCode::OutOfRange,
                     "expected a scale above 0 and finite, found " + std::to_string(options.scale));
  }
  if (text.size() > kMaxBvhFileBytes) {
    return Error::in(name, ErrorCode::LimitExceeded,
                     "expected at most " + std::to_string(kMaxBvhFileBytes) + " bytes");
  }
  try {
    return inFile(readClip(text, options.scale), name);
  } catch (const std::bad_alloc&) {
    return Error::in(name, ErrorCode::LimitExceeded, "does not fit into memory");
  }
}

Result<Clip> readBvhFile(const std::string& path, const BvhOptions& options) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxBvhFileBytes));
  return parseBvh(text, path, options);
}

}  // namespace foretouch
