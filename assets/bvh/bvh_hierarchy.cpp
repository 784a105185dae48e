#include "assets/bvh/bvh_hierarchy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <unordered_set>
#include <utility>

#include "articulated/try.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr int kMaxChannels = 6;
constexpr char kBlockWords[] = "OFFSET, CHANNELS, JOINT, End Site or '}'";

/// A joint or End Site whose closing brace has not come yet.
struct Block {
  JointId joint = kNoParent;  ///< The joint, or the one that the End Site ends.
  bool isEndSite = false;
  bool hasOffset = false;
  bool hasChannels = false;
  bool hasChild = false;
  std::int64_t line = 0;
};

/// The reader's stack is a vector: a file's nesting costs no machine stack.
class HierarchyReader {
 public:
  HierarchyReader(BvhScanner& scanner, double scale, ClipNotes& notes)
      : scanner_(scanner), scale_(scale), notes_(notes) {}

  Result<BvhHierarchy> read();

 private:
  using Outcome = std::optional<Error>;  ///< Nothing: continue.

  Outcome readOutside(const BvhWord& word);
  Outcome readInside(const BvhWord& word);
  Outcome openJoint(const BvhWord& name);
  Outcome openEndSite(std::int64_t line);
  Outcome openBlock(Block block);
  Outcome readOffset(const BvhWord& word);
  Outcome readChannels(const BvhWord& word);
  void closeBlock();
  std::string legibleName(std::string_view raw, std::int64_t line);
  void makeNamesUnique();
  void noteSilentJoints();

  BvhScanner& scanner_;
  double scale_;
  ClipNotes& notes_;
  std::vector<Block> open_;
  BvhHierarchy hierarchy_;
  bool notedLatin1_ = false;
};

std::optional<BvhChannel> channelOf(std::string_view word) {
  constexpr std::array<std::string_view, 6> kNames = {"xposition", "yposition", "zposition",
                                                      "xrotation", "yrotation", "zrotation"};
  for (int i = 0; i < 6; ++i) {
    if (isKeyword(word, kNames[slotOf(i)])) return BvhChannel{i >= 3, i % 3};
  }
  return std::nullopt;
}

/// "End Site", "END SITE", "End_Site", "EndSite", and "End <anything>".
bool startsEndSite(std::string_view word) {
  return isKeyword(word, "end") || isKeyword(word, "end_site") || isKeyword(word, "endsite") ||
         isKeyword(word, "end-site");
}

Result<BvhHierarchy> HierarchyReader::read() {
  const BvhWord first = scanner_.peek();
  if (isKeyword(first.text, "hierarchy")) {
    static_cast<void>(scanner_.next());
  } else if (isKeyword(first.text, "root")) {
    notes_.add("the keyword HIERARCHY is missing");
  } else {
    return first.text.empty() ? bvhError(ErrorCode::Empty, first.line, "the file is empty")
                              : bvhExpected("HIERARCHY", first);
  }
  for (;;) {
    const BvhWord word = scanner_.next();
    if (open_.empty() && isKeyword(word.text, "motion")) break;
    if (word.text.empty() && !open_.empty()) {
      return bvhError(ErrorCode::Syntax, word.line,
                      "expected '}', found the end of the file; the block of line " +
                          std::to_string(open_.back().line) + " is not closed");
    }
    if (auto error = open_.empty() ? readOutside(word) : readInside(word)) return *std::move(error);
  }
  if (hierarchy_.skeleton.joints.empty()) {
    return bvhError(ErrorCode::Empty, first.line, "expected at least one ROOT before MOTION");
  }
  makeNamesUnique();
  noteSilentJoints();
  return std::move(hierarchy_);
}

HierarchyReader::Outcome HierarchyReader::readOutside(const BvhWord& word) {
  if (isKeyword(word.text, "root")) return openJoint(scanner_.nextName());
  if (isKeyword(word.text, "joint")) {
    notes_.add("line " + std::to_string(word.line) + ": a root starts with JOINT instead of ROOT");
    return openJoint(scanner_.nextName());
  }
  // A root may lack its keyword. Its name is then the word before the brace; a word without a brace
  // is something else.
  if (word.text.empty() || word.text == "{" || word.text == "}" || scanner_.peek().text != "{") {
    return bvhExpected("ROOT or MOTION", word);
  }
  notes_.add("line " + std::to_string(word.line) + ": a root lacks the keyword ROOT");
  return openJoint(word);
}

HierarchyReader::Outcome HierarchyReader::readInside(const BvhWord& word) {
  if (word.text == "}") {
    closeBlock();
    return std::nullopt;
  }
  if (isKeyword(word.text, "offset")) return readOffset(word);
  if (isKeyword(word.text, "channels")) return readChannels(word);
  if (open_.back().isEndSite) return bvhExpected("OFFSET or '}' in an End Site", word);
  if (isKeyword(word.text, "joint")) {
    open_.back().hasChild = true;
    return openJoint(scanner_.nextName());
  }
  if (startsEndSite(word.text)) return openEndSite(word.line);
  return bvhExpected(kBlockWords, word);
}

HierarchyReader::Outcome HierarchyReader::openJoint(const BvhWord& name) {
  if (name.text.empty()) return bvhExpected("a joint's name", scanner_.peek());
  if (name.text.size() > kMaxNameBytes) {
    return bvhError(ErrorCode::LimitExceeded, name.line,
                    "expected a name of at most " + std::to_string(kMaxNameBytes) + " bytes");
  }
  if (hierarchy_.skeleton.joints.size() == countOf(kMaxJoints)) {
    return bvhError(ErrorCode::LimitExceeded, name.line,
                    "expected at most " + std::to_string(kMaxJoints) + " joints");
  }
  if (open_.size() == static_cast<std::size_t>(kMaxChainDepth)) {
    return bvhError(ErrorCode::LimitExceeded, name.line,
                    "expected joints nested at most " + std::to_string(kMaxChainDepth) + " deep");
  }
  RawJoint joint;
  joint.name = legibleName(name.text, name.line);
  joint.parent = open_.empty() ? kNoParent : open_.back().joint;
  Block block;
  block.joint = static_cast<JointId>(hierarchy_.skeleton.joints.size());
  block.line = name.line;
  hierarchy_.skeleton.joints.push_back(std::move(joint));
  hierarchy_.lines.push_back(name.line);
  hierarchy_.channels.emplace_back();
  hierarchy_.endSites.emplace_back();
  return openBlock(block);
}

HierarchyReader::Outcome HierarchyReader::openEndSite(std::int64_t line) {
  if (scanner_.peek().text != "{") static_cast<void>(scanner_.nextName());  // "Site", or a name
  Block block;
  block.joint = open_.back().joint;
  block.isEndSite = true;
  block.line = line;
  auto& sites = hierarchy_.endSites[slotOf(block.joint)];
  if (sites.size() == countOf(kMaxJoints)) {
    return bvhError(ErrorCode::LimitExceeded, line,
                    "expected at most " + std::to_string(kMaxJoints) + " End Sites of one joint");
  }
  sites.emplace_back(Eigen::Vector3d::Zero());
  return openBlock(block);
}

HierarchyReader::Outcome HierarchyReader::openBlock(Block block) {
  const BvhWord brace = scanner_.next();
  if (brace.text != "{") return bvhExpected("'{'", brace);
  open_.push_back(block);
  return std::nullopt;
}

HierarchyReader::Outcome HierarchyReader::readOffset(const BvhWord& word) {
  Block& block = open_.back();
  if (block.hasOffset) {
    return bvhError(ErrorCode::DuplicateName, word.line, "a second OFFSET in one block");
  }
  block.hasOffset = true;
  Eigen::Vector3d offset;
  for (int axis = 0; axis < 3; ++axis) {
    FORETOUCH_TRY(const auto number, nextNumber(scanner_, "a number of the OFFSET"));
    offset[axis] = number * scale_;
    if (!(std::abs(offset[axis]) <= kMaxCoordinate)) {
      return bvhError(ErrorCode::OutOfRange, word.line,
                      "expected an OFFSET of at most 1e7 m; is the scale right?");
    }
  }
  const auto joint = slotOf(block.joint);
  if (block.isEndSite) {
    hierarchy_.endSites[joint].back() = offset;
  } else {
    hierarchy_.skeleton.joints[joint].offset = offset;
  }
  return std::nullopt;
}

HierarchyReader::Outcome HierarchyReader::readChannels(const BvhWord& word) {
  Block& block = open_.back();
  if (block.hasChannels) {
    return bvhError(ErrorCode::DuplicateName, word.line, "a second CHANNELS in one block");
  }
  if (block.hasChild) {  // the order of the columns would be unknown
    return bvhError(ErrorCode::Syntax, word.line, "expected CHANNELS before the first child JOINT");
  }
  block.hasChannels = true;
  const BvhWord countWord = scanner_.next();
  const BvhNumber count = readBvhNumber(countWord.text);
  const bool isCount = count.problem == nullptr && count.value >= 0 &&
                       count.value <= kMaxChannels && count.value == std::floor(count.value);
  if (!isCount || (block.isEndSite && count.value > 0)) {
    return bvhExpected(block.isEndSite ? "no channels in an End Site" : "0 to 6 channels",
                       countWord);
  }
  auto& channels = hierarchy_.channels[slotOf(block.joint)];
  for (int i = 0; i < static_cast<int>(count.value); ++i) {
    const BvhWord name = scanner_.next();
    const auto channel = channelOf(name.text);
    if (!channel) return bvhExpected("a channel, such as Xposition or Zrotation", name);
    const auto same = [&](const BvhChannel& other) {
      return other.axis == channel->axis && other.isRotation == channel->isRotation;
    };
    if (std::any_of(channels.begin(), channels.end(), same)) {
      return bvhError(ErrorCode::DuplicateName, name.line,
                      "the channel " + inQuotes(name.text) + " appears twice on one joint");
    }
    channels.push_back(*channel);
  }
  hierarchy_.numChannels += channels.size();
  return std::nullopt;
}

void HierarchyReader::closeBlock() {
  const Block& block = open_.back();
  if (!block.hasOffset) {
    notes_.add("line " + std::to_string(block.line) + ": no OFFSET; it counts as zero");
  }
  open_.pop_back();
}

/// A name as UTF-8. Older exporters write the code page of their machine: read as Latin-1, where 80
/// to 9f are control characters and become U+FFFD.
std::string HierarchyReader::legibleName(std::string_view raw, std::int64_t line) {
  std::string name;
  const bool isLatin1 = !isUtf8(raw);
  for (const char c : raw) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20) {
      name += ' ';  // a tab: binaryContent() refuses other control characters
    } else if (byte < 0x80 || !isLatin1) {
      name += c;
    } else if (byte < 0xa0) {
      name += "\xef\xbf\xbd";
    } else {
      name += {static_cast<char>(0xc0 | (byte >> 6)), static_cast<char>(0x80 | (byte & 0x3f))};
    }
  }
  if (isLatin1 && !notedLatin1_) {
    notedLatin1_ = true;
    notes_.add("line " + std::to_string(line) + ": names are not UTF-8; they are read as Latin-1");
  }
  return name;
}

/// The first joint of a name keeps it, later ones become name#2, name#3, ..., skipping names that
/// the file already has.
void HierarchyReader::makeNamesUnique() {
  auto& joints = hierarchy_.skeleton.joints;
  std::unordered_set<std::string> taken;
  for (const RawJoint& joint : joints) taken.insert(joint.name);
  std::unordered_map<std::string, int> copies;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    int& copy = copies[joints[i].name];
    if (++copy == 1) continue;
    std::string name = joints[i].name + "#" + std::to_string(copy);
    while (!taken.insert(name).second) name = joints[i].name + "#" + std::to_string(++copy);
    notes_.add("line " + std::to_string(hierarchy_.lines[i]) + ": another joint is called " +
               inQuotes(joints[i].name) + "; this one is now " + inQuotes(name));
    joints[i].name = std::move(name);
  }
}

void HierarchyReader::noteSilentJoints() {
  const auto count = std::count_if(hierarchy_.channels.begin(), hierarchy_.channels.end(),
                                   [](const auto& channels) { return channels.empty(); });
  if (count == 0) return;
  notes_.add(std::to_string(count) + " of " + std::to_string(hierarchy_.channels.size()) +
             " joints have no channels and keep their rest pose");
}

}  // namespace

Result<BvhHierarchy> readBvhHierarchy(BvhScanner& scanner, double scale, ClipNotes& notes) {
  return HierarchyReader(scanner, scale, notes).read();
}

}  // namespace foretouch::internal
