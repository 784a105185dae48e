// Xsens' MVNX: the segments of a body, where they are and how they are turned in every frame, in
// the world (metres, z up). They become nodes in the order of the file's joints, and keys of an
// animation relative to what carries each. Source: MVN User Manual, "MVNX file format".
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tinyxml.h>
#include <utility>
#include <vector>

#include "articulated/skeleton.h"
#include "assets/decimal.h"
#include "assets/import/failure.h"
#include "assets/import/memory_budget.h"
#include "assets/import/model.h"
#include "assets/import/text.h"
#include "assets/import/xml_document.h"
#include "assets/text_file.h"
#include "lss/index.h"

namespace foretouch::internal {
namespace {

constexpr std::size_t kMaxMvnxBytes = std::size_t{512} << 20;
constexpr std::size_t kMaxSegments = 256;

[[noreturn]] void refuseIn(const TiXmlElement& element, const std::string& what) {
  refuse("line " + std::to_string(element.Row()) + ": " + what);
}

const TiXmlElement& childOf(const TiXmlElement& parent, const char* name) {
  const TiXmlElement* const child = parent.FirstChildElement(name);
  if (child == nullptr) {
    refuseIn(parent, "expected a <" + std::string(name) + "> in <" + parent.ValueStr() + ">");
  }
  return *child;
}

/// `count` finite numbers.
std::vector<double> numbersOf(const TiXmlElement& element, std::size_t count) {
  std::vector<double> numbers;
  const char* at = element.GetText() == nullptr ? "" : element.GetText();
  const char* const end = at + std::char_traits<char>::length(at);
  for (;;) {
    while (at != end && (*at == ' ' || *at == '\t' || *at == '\n' || *at == '\r')) ++at;
    if (at == end) break;
    double number = 0.0;
    const auto [rest, problem] = readDecimal(at, end, number);
    if (problem != std::errc() || !std::isfinite(number)) {
      refuseIn(element, "expected finite numbers in <" + element.ValueStr() + ">");
    }
    numbers.push_back(number);
    at = rest;
  }
  if (numbers.size() != count) {
    refuseIn(element, "expected " + std::to_string(count) + " numbers in <" + element.ValueStr() +
                          ">, found " + std::to_string(numbers.size()));
  }
  return numbers;
}

class MvnxReader {
 public:
  explicit MvnxReader(const TiXmlElement& root) : subject_(childOf(root, "subject")) {}

  Model read() {
    readSegments();
    readJoints();
    const TiXmlElement& frames = childOf(subject_, "frames");
    addNodes(restOf(frames));
    addFrames(frames);
    if (subject_.NextSiblingElement("subject") != nullptr) {
      builder_.note("only the first of its subjects is read");
    }
    builder_.model.frame.declared = {1.0, UpAxis::Z, true};
    return builder_.take();
  }

 private:
  void readSegments() {
    const TiXmlElement& segments = childOf(subject_, "segments");
    for (const TiXmlElement* one = segments.FirstChildElement("segment"); one != nullptr;
         one = one->NextSiblingElement("segment")) {
      const std::string label = attributeOf(*one, "label");
      if (label.empty()) refuseIn(*one, "expected a label");
      if (!indexOf_.emplace(label, labels_.size()).second) {
        refuseIn(*one, "two segments are called " + quotedName(label));
      }
      labels_.push_back(label);
      if (labels_.size() > kMaxSegments) refuseIn(*one, "expected at most 256 segments");
    }
    if (labels_.empty()) refuseIn(segments, "expected segments");
    carrier_.assign(labels_.size(), -1);
  }

  /// "Pelvis/jL5S1": the segment.
  int segmentOf(const TiXmlElement& joint, const char* connector) const {
    const TiXmlElement& at = childOf(joint, connector);
    const std::string text = at.GetText() == nullptr ? "" : at.GetText();
    const auto found = indexOf_.find(text.substr(0, text.find('/')));
    if (found == indexOf_.end()) refuseIn(at, quotedName(text) + " is at no segment");
    return static_cast<int>(found->second);
  }

  void readJoints() {
    const TiXmlElement* const joints = subject_.FirstChildElement("joints");
    if (joints == nullptr) {
      builder_.note("it has no joints: every segment moves by itself");
      return;
    }
    for (const TiXmlElement* joint = joints->FirstChildElement("joint"); joint != nullptr;
         joint = joint->NextSiblingElement("joint")) {
      const int carrier = segmentOf(*joint, "connector1"),
                carried = segmentOf(*joint, "connector2");
      if (carrier_[static_cast<std::size_t>(carried)] >= 0) {
        refuseIn(*joint, "segment " + quotedName(labels_[static_cast<std::size_t>(carried)]) +
                             " hangs on two joints");
      }
      carrier_[static_cast<std::size_t>(carried)] = carrier;
    }
  }

  [[nodiscard]] std::vector<RigidPose> placesIn(const TiXmlElement& frame) const {
    const auto turns = numbersOf(childOf(frame, "orientation"), 4 * labels_.size());
    const auto places = numbersOf(childOf(frame, "position"), 3 * labels_.size());
    std::vector<RigidPose> all;
    for (std::size_t i = 0; i < labels_.size(); ++i) {
      const auto turn =
          unitQuaternion({turns[4 * i], turns[4 * i + 1], turns[4 * i + 2], turns[4 * i + 3]});
      if (!turn) {
        refuseIn(frame, "segment " + quotedName(labels_[i]) + " is turned by no unit quaternion");
      }
      all.push_back({*turn, {places[3 * i], places[3 * i + 1], places[3 * i + 2]}});
    }
    return all;
  }

  static bool isOf(const TiXmlElement& frame, const char* type) {
    return attributeOf(frame, "type") == type;
  }
  static const TiXmlElement* frameOf(const TiXmlElement& frames, const char* type) {
    const TiXmlElement* frame = frames.FirstChildElement("frame");
    while (frame != nullptr && !isOf(*frame, type)) frame = frame->NextSiblingElement("frame");
    return frame;
  }

  /// The T-pose if there is one.
  std::vector<RigidPose> restOf(const TiXmlElement& frames) {
    const TiXmlElement* rest = frameOf(frames, "tpose");
    if (rest == nullptr) {
      builder_.note("it has no T-pose: it rests as in its first frame");
      rest = frameOf(frames, "normal");
    }
    if (rest == nullptr) refuseIn(frames, "expected frames of the type 'normal'");
    return placesIn(*rest);
  }

  RigidPose relative(const std::vector<RigidPose>& places, std::size_t segment) const {
    const int carrier = carrier_[segment];
    if (carrier < 0) return places[segment];
    const RigidPose& above = places[static_cast<std::size_t>(carrier)];
    const Quaternion back = above.rotation.conjugate();
    return {(back * places[segment].rotation).normalized(),
            back * (places[segment].translation - above.translation)};
  }

  /// Carriers first.
  void addNodes(const std::vector<RigidPose>& rest) {
    node_.assign(labels_.size(), -1);
    for (std::size_t round = 0; order_.size() < labels_.size(); ++round) {
      if (round > labels_.size()) refuseIn(subject_, "its joints form a cycle");
      for (std::size_t i = 0; i < labels_.size(); ++i) {
        const int carrier = carrier_[i];
        const bool isReady = carrier < 0 || node_[static_cast<std::size_t>(carrier)] >= 0;
        if (node_[i] >= 0 || !isReady) continue;
        ModelSize more;
        more.nodes = 1;
        more.nameBytes = labels_[i].size();
        builder_.count(more);
        node_[i] = static_cast<std::int32_t>(builder_.model.nodes.size());
        order_.push_back(i);
        ModelNode node;
        node.name = labels_[i];
        node.parent = carrier < 0 ? -1 : node_[static_cast<std::size_t>(carrier)];
        const RigidPose local = relative(rest, i);
        node.toParent = {local.rotation.toRotationMatrix(), local.translation};
        builder_.model.nodes.push_back(std::move(node));
      }
    }
  }

  [[nodiscard]] double frameRate() const {
    double rateHz = 0.0;
    const std::string text = attributeOf(subject_, "frameRate");
    const auto [rest, problem] = readDecimal(text.data(), text.data() + text.size(), rateHz);
    const bool isRate = problem == std::errc() && rest == text.data() + text.size();
    if (!isRate || !(rateHz >= 1e-3 && rateHz <= 1e6)) {
      refuseIn(subject_, "expected a frameRate above 0, found " + quotedName(text));
    }
    return rateHz;
  }

  void addFrames(const TiXmlElement& frames) {
    const double rateHz = frameRate();
    ModelAnimation animation;
    animation.name = "mvnx";
    ModelSize more;
    more.animations = 1;
    more.tracks = labels_.size();
    more.nameBytes = animation.name.size();
    builder_.count(more);
    for (const std::size_t i : order_) {
      animation.tracks.emplace_back();
      animation.tracks.back().node = node_[i];
    }
    std::optional<int> first;
    int last = 0, count = 0;
    for (const TiXmlElement* frame = frameOf(frames, "normal"); frame != nullptr;
         frame = frame->NextSiblingElement("frame")) {
      if (!isOf(*frame, "normal")) continue;
      int index = count;
      if (frame->QueryIntAttribute("index", &index) == TIXML_WRONG_TYPE) {
        refuseIn(*frame, "expected a whole number as index");
      }
      if (first && index <= last) refuseIn(*frame, "expected an index above the one before");
      if (first && index != last + 1) builder_.note("frames are missing: it goes straight there");
      if (!first) first = index;
      last = index;
      ++count;
      addKeys(placesIn(*frame), (static_cast<double>(index) - *first) / rateHz, animation);
    }
    if (count < 2) refuseIn(frames, "expected at least two frames of the type 'normal'");
    builder_.model.animations.push_back(std::move(animation));
  }

  void addKeys(const std::vector<RigidPose>& places, double timeS, ModelAnimation& animation) {
    ModelSize more;
    more.keys = 2 * labels_.size();
    builder_.count(more);
    for (std::size_t k = 0; k < order_.size(); ++k) {
      const RigidPose local = relative(places, order_[k]);
      animation.tracks[k].positions.push_back({timeS, local.translation});
      animation.tracks[k].rotations.push_back({timeS, local.rotation});
    }
    animation.durationS = timeS;
  }

  const TiXmlElement& subject_;
  ModelBuilder builder_;
  std::vector<std::string> labels_;
  std::map<std::string, std::size_t> indexOf_;
  std::vector<int> carrier_;  // per segment; -1: none
  std::vector<std::int32_t> node_;
  std::vector<std::size_t> order_;  // of nodes: segments
};

}  // namespace

Model readMvnx(const ModelQuestion& question) {
  const auto text = readWholeFile(question.path, kMaxMvnxBytes);
  if (!text.ok()) {
    throw Failure{text.error().code == ErrorCode::LimitExceeded ? ImportFailure::TooLarge
                                                                : ImportFailure::Refused,
                  text.error().message};
  }
  grantMemoryFor(text.value().size());
  TiXmlDocument document;
  parseXml(text.value(), document);
  return MvnxReader(rootOf(document, "mvnx")).read();
}

}  // namespace foretouch::internal
