#include "assets/clip/acclaim.h"

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/bvh/bvh_limits.h"
#include "assets/bvh/bvh_text.h"
#include "assets/clip/asf_skeleton.h"
#include "lss/index.h"

namespace foretouch {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using internal::AcclaimDof;
using internal::AcclaimLine;
using internal::AcclaimLines;
using internal::AsfBone;
using internal::AsfSkeleton;
using internal::bvhError;

constexpr double kMetresPerInch = 0.0254;
constexpr double kDegree = 3.14159265358979323846 / 180.0;

bool isTurn(AcclaimDof dof) {
  return dof >= AcclaimDof::Rx;
}
Vector3d axisOf(AcclaimDof dof) {
  return Vector3d::Unit(static_cast<int>(dof) % 3);
}

/// The skeleton at rest, whose frames are the world's: only places differ.
RawSkeleton rawOf(const AsfSkeleton& asf, double metresPerUnit) {
  RawSkeleton raw;
  for (std::size_t i = 0; i < asf.bones.size(); ++i) {
    const JointId parent = asf.parents[i];
    const Vector3d offset =
        parent == kNoParent ? asf.rootPosition : asf.bones[slotOf(parent)].direction;
    raw.joints.push_back(
        {asf.bones[i].name, parent, offset * metresPerUnit, Quaternion::Identity()});
  }
  return raw;
}

class AmcReader {
 public:
  AmcReader(const AsfSkeleton& asf, std::string_view text, double metresPerUnit, Clip& clip)
      : asf_(asf), lines_(text), metresPerUnit_(metresPerUnit), clip_(clip) {}

  Result<Done> read() {
    advance();
    for (; !line_.words.empty() && line_.words[0][0] == ':'; advance()) {
      if (internal::isKeyword(line_.words[0], ":radians")) unit_ = 1.0;
    }
    while (!line_.words.empty()) FORETOUCH_CHECK(readFrame());
    if (!clip_.frames.empty()) return Done{};
    return bvhError(ErrorCode::Empty, line_.number, "expected at least one frame");
  }

 private:
  void advance() { line_ = lines_.next(); }
  [[nodiscard]] Error wrong(const std::string& message, ErrorCode code = ErrorCode::Syntax) const {
    return bvhError(code, line_.number, message);
  }

  /// Its number, and a line for every bone that moves.
  Result<Done> readFrame() {
    const std::int64_t begin = line_.number;
    if (line_.words.size() != 1) return wrong("expected the number of a frame alone");
    const internal::BvhNumber number = internal::readBvhNumber(line_.words[0]);
    if (number.problem != nullptr) {
      return wrong("expected the number of a frame, found " +
                   inQuotes(std::string(line_.words[0])));
    }
    if (!clip_.frames.empty() && number.value != lastNumber_ + 1.0) {
      return wrong("expected frame " + inDigits(lastNumber_ + 1.0, 17) + ", found " +
                       inQuotes(std::string(line_.words[0])) +
                       "; frames that are missing would shift those behind them in time",
                   ErrorCode::OutOfRange);
    }
    lastNumber_ = number.value;
    constexpr std::size_t kLeastChannels = 3;
    if ((clip_.frames.size() + 1) * asf_.bones.size() * kLeastChannels > kMaxBvhValues) {
      return wrong("expected at most 2^26 values", ErrorCode::LimitExceeded);
    }
    Pose pose = restPose(clip_.skeleton);
    std::vector<bool> isSaid(asf_.bones.size(), false);
    for (advance(); line_.words.size() > 1; advance()) FORETOUCH_CHECK(readBone(pose, isSaid));
    for (std::size_t i = 0; i < isSaid.size(); ++i) {
      if (isSaid[i] || asf_.bones[i].dofs.empty()) continue;
      return bvhError(ErrorCode::Empty, begin,
                      "the frame says nothing of bone " + inQuotes(asf_.bones[i].name) +
                          "; expected every bone that moves (:FULLY-SPECIFIED)");
    }
    FORETOUCH_TRY(auto checked, validatedPose(clip_.skeleton, pose));
    clip_.frames.push_back(std::move(checked));
    return Done{};
  }

  Result<Done> readBone(Pose& pose, std::vector<bool>& isSaid) {
    const auto found = asf_.placeOf.find(line_.words[0]);
    if (found == asf_.placeOf.end()) {
      return wrong("the skeleton has no bone " + inQuotes(std::string(line_.words[0])),
                   ErrorCode::UnknownName);
    }
    const std::size_t place = found->second;
    const AsfBone& bone = asf_.bones[place];
    if (isSaid[place]) {
      return wrong("bone " + inQuotes(bone.name) + " is in the frame twice",
                   ErrorCode::DuplicateName);
    }
    isSaid[place] = true;
    if (line_.words.size() != bone.dofs.size() + 1) {
      return wrong("expected " + std::to_string(bone.dofs.size()) + " numbers for bone " +
                       inQuotes(bone.name) + ", found " + std::to_string(line_.words.size() - 1),
                   ErrorCode::Mismatch);
    }
    Quaternion turn = Quaternion::Identity();
    for (std::size_t i = 0; i < bone.dofs.size(); ++i) {
      const internal::BvhNumber number = internal::readBvhNumber(line_.words[i + 1]);
      if (number.problem != nullptr) {
        return bvhError(number.code, line_.number,
                        "expected a number, found " + inQuotes(std::string(line_.words[i + 1])) +
                            ", which is " + number.problem);
      }
      const Vector3d axis = axisOf(bone.dofs[i]);
      if (isTurn(bone.dofs[i])) {
        turn = Quaternion(Eigen::AngleAxisd(number.value * unit_, axis)) * turn;
      } else {
        pose.translations[place] += axis * (number.value * metresPerUnit_);
      }
    }
    pose.rotations[place] = (bone.axis * turn * bone.axis.conjugate()).normalized();
    return Done{};
  }

  const AsfSkeleton& asf_;
  AcclaimLines lines_;
  AcclaimLine line_;
  double metresPerUnit_, unit_ = kDegree;
  double lastNumber_ = 0.0;  // of a frame
  Clip& clip_;
};

void describeChannels(const AsfSkeleton& asf, double metresPerUnit, Clip& clip) {
  clip.endSites.resize(asf.bones.size());
  std::vector<bool> isLeaf(asf.bones.size(), true);
  for (const JointId parent : asf.parents) {
    if (parent != kNoParent) isLeaf[slotOf(parent)] = false;
  }
  for (std::size_t i = 0; i < asf.bones.size(); ++i) {
    const auto& dofs = asf.bones[i].dofs;
    clip.hasRotation.push_back(std::any_of(dofs.begin(), dofs.end(), isTurn));
    clip.hasTranslation.push_back(!std::all_of(dofs.begin(), dofs.end(), isTurn));
    if (isLeaf[i] && i > 0) clip.endSites[i].push_back(asf.bones[i].direction * metresPerUnit);
  }
}

}  // namespace

Result<Clip> parseAcclaim(std::string_view asfText, const std::string& asfName,
                          std::string_view amcText, const std::string& amcName,
                          const AcclaimOptions& options) {
  FORETOUCH_TRY(const auto asf, inFile(internal::parseAsf(asfText), asfName));
  const double metresPerUnit = options.metresPerUnit.value_or(kMetresPerInch / asf.length);
  Clip clip;
  FORETOUCH_TRY(clip.skeleton, inFile(Skeleton::build(rawOf(asf, metresPerUnit)), asfName));
  clip.frameTimeS = 1.0 / options.rateHz.value_or(kAcclaimRateHz);
  if (const auto binary = internal::binaryContent(amcText)) return inFile(*binary, amcName);
  const auto read = AmcReader(asf, amcText, metresPerUnit, clip).read();
  if (!read.ok()) return inFile(read.error(), amcName);
  describeChannels(asf, metresPerUnit, clip);
  if (!options.metresPerUnit) {
    clip.notes.push_back("its lengths are taken as inches over the skeleton's 'length' of " +
                         inDigits(asf.length) + ", as CMU's are: " + inDigits(metresPerUnit, 4) +
                         " m per unit");
  }
  if (!options.rateHz) {
    clip.notes.push_back(
        "it says no rate; it is taken as recorded at 120 Hz, as most of CMU's are");
  }
  return clip;
}

Result<std::string> skeletonBeside(const std::string& amcPath) {
  const fs::path path(amcPath);
  const std::string stem = path.stem().string();
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  std::vector<fs::path> others;
  std::error_code unreadable;
  for (fs::directory_iterator entry(folder, unreadable), end; !unreadable && entry != end;
       entry.increment(unreadable)) {
    std::string ending = entry->path().extension().string();
    std::transform(ending.begin(), ending.end(), ending.begin(), [](char c) {
      return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
    });
    if (ending == ".asf") others.push_back(entry->path());
  }
  std::sort(others.begin(), others.end());
  for (const std::string& wanted : {stem, stem.substr(0, stem.rfind('_'))}) {
    for (const fs::path& other : others) {
      if (other.stem().string() == wanted) return other.string();
    }
  }
  if (others.size() == 1) return others.front().string();
  return Error::in(amcPath, others.empty() ? ErrorCode::FileNotFound : ErrorCode::Mismatch,
                   "an AMC is about a skeleton: expected its ASF beside it, called " +
                       inQuotes(stem + ".asf") + ", or to be told it (--skeleton), found " +
                       std::to_string(others.size()) + " others");
}

}  // namespace foretouch
