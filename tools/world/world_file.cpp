#include "tools/world/world_file.h"

#include <algorithm>
#include <set>
#include <utility>

#include "articulated/quoted.h"
#include "articulated/try.h"
#include "assets/text_file.h"
#include "middleware/world/world.h"
#include "tools/microseconds.h"
#include "tools/settings/config_reading.h"
#include "tools/settings/toml_section.h"
#include "tools/world/body_section.h"

namespace foretouch::tools {
namespace {

constexpr char kFormat[] = "foretouch-world";
constexpr std::int64_t kVersion = 1;
constexpr double kMostSpeed = 1e3;
constexpr double kMostMassKg = 1e9;
/// The scene's word where a group of bodies is named, in [[ask]].
constexpr char kSceneWord[] = "scene";

class WorldReading {
 public:
  WorldReading(const std::string& path, const toml::table& tables)
      : reading_{path, std::nullopt}, root_(reading_, tables, "the file") {
    world_.path = path;
  }

  Result<WorldFile> read() {
    readHead();
    for (TomlSection& section : root_.tables("body", "[[body]]", kMaxFileBodies)) {
      world_.bodies.push_back(readBody(section));
      if (reading_.error) break;
    }
    for (TomlSection& section : root_.tables("trigger", "[[trigger]]", kMaxFileTriggers)) {
      if (reading_.error) break;
      world_.bodies.push_back(readTrigger(section));
    }
    readAsks();
    checkNames();
    if (reading_.error) return *reading_.error;
    return std::move(world_);
  }

 private:
  [[nodiscard]] std::string beside(const std::string& path) const {
    return besideFile(path, reading_.file);
  }
  void readPath(TomlSection& section, const char* key, std::string& path) {
    section.text(key, path, false);
    path = beside(path);
  }

  void readHead();
  FileBody readBody(TomlSection& section);
  FileBody readTrigger(TomlSection& section);
  void readNameAndShape(TomlSection& section, FileBody& body);
  static void readSilence(TomlSection& section, FileBody& body);
  void readMotion(TomlSection& section, FileBody& body);
  void readClip(TomlSection& section, FileBody& body);
  void readTiming(TomlSection& section, ClipTiming& timing);
  void readPoses(TomlSection& section, FileBody& body);
  void readBounds(TomlSection& section, FileBody& body);
  void readChanges(TomlSection& section, FileBody& body);
  void readAsks();
  void checkNames();
  template <typename Legal>
  static bool readTime(TomlSection& section, const char* key, const char* inWords, Legal legal,
                       std::int64_t& utimeUs);
  static std::int64_t readTime(TomlSection& section);

  TomlReading reading_;
  TomlSection root_;
  WorldFile world_;
};

void WorldReading::readHead() {
  root_.allowOnly({"format", "version", "scene", "query", "body", "trigger", "ask", "ask_meshes"});
  std::string format;
  root_.word<std::string>("format", {kFormat}, {kFormat}, format);
  if (format.empty()) {
    reading_.fail(ErrorCode::Empty, -1, std::string("expected format = \"") + kFormat + '"');
  }
  std::int64_t version = 0;
  root_.integer("version", kVersion, kVersion, version);
  if (version == 0) reading_.fail(ErrorCode::Empty, -1, "expected version = 1");
  std::optional<bool> askMeshes;
  root_.truth("ask_meshes", askMeshes);
  world_.askMeshes = askMeshes.value_or(false);
  Settings settings;
  addSceneSettings(settings, world_.scene);
  addWorldTolerance(settings, world_.tolerance);
  for (const char* const table : {"scene", "query"}) {
    readWholeTable(root_, table, reading_, settings);
  }
  if (hasKey(root_, "scene") && world_.scene.scenePath.empty()) {
    root_.table("scene").fail(ErrorCode::Empty, "expected a file");
  }
}

FileBody WorldReading::readBody(TomlSection& section) {
  FileBody body;
  body.line = section.line();
  section.allowOnly({"name",   "avatar",   "mesh",   "node",     "scale", "up",       "sphere",
                     "lss",    "box",      "group",  "mass",     "self",  "pairs",    "when_silent",
                     "clip",   "poses",    "pose",   "position", "yaw",   "rotation", "attach",
                     "detach", "fidelity", "bounds", "between"});
  readNameAndShape(section, body);
  section.text("group", body.group, false);
  if (body.group == kSceneWord) {
    section.outOfRange("group", "another word, as this one means the scene", inQuotes(body.group),
                       *section.find("group"));
  }
  if (hasKey(section, "mass")) {
    section.number(
        "mass", "a finite number of kilograms greater than 0, at most 1e9",
        [](double kg) { return kg > 0.0 && kg <= kMostMassKg; }, body.massKg.emplace());
  }
  readSilence(section, body);
  section.word<Fidelity>("fidelity", {"link", "exact"}, {Fidelity::Link, Fidelity::Exact},
                         body.fidelity);
  if (body.fidelity == Fidelity::Exact && body.shape.avatarPath.empty()) {
    section.fail(
        ErrorCode::Mismatch,
        "expected an avatar beside fidelity = \"exact\": props touch by what they are made "
        "of");
  }
  std::optional<bool> self;
  section.truth("self", self);
  body.asksSelf = self.value_or(false);
  readPath(section, "pairs", body.pairsPath);
  if (!body.pairsPath.empty() && !body.asksSelf) {
    section.fail(ErrorCode::Mismatch, "expected self = true beside pairs");
  }
  if (body.asksSelf && body.shape.avatarPath.empty()) {
    section.fail(ErrorCode::Mismatch, "expected an avatar beside self: a prop has no own links");
  }
  readMotion(section, body);
  readChanges(section, body);
  readBounds(section, body);
  return body;
}

void WorldReading::readBounds(TomlSection& section, FileBody& body) {
  if (hasKey(section, "between")) {
    section.word<MotionModel>(
        "between", {"constant-rate", "cubic", "cubic-late"},
        {MotionModel::ConstantRate, MotionModel::Cubic, MotionModel::CubicLate}, body.between);
  }
  std::string word;
  section.text("bounds", word, false);
  body.isExact = word == "exact";
  if (!body.isExact) readPath(section, "bounds", body.boundsPath);
  if (hasKey(section, "between") && body.boundsPath.empty()) {
    section.fail(ErrorCode::Mismatch, "expected a file of bounds beside between");
  }
  if (!hasKey(section, "bounds")) return;
  if (!body.shape.meshPath.empty() || body.shape.box) {
    section.fail(ErrorCode::Mismatch,
                 "expected an avatar, a sphere or lss beside bounds: meshes are not asked");
  }
  if (!body.changes.empty()) {
    section.fail(ErrorCode::Mismatch,
                 "expected no attach or detach beside bounds: who is carried is not asked");
  }
}

/// A trigger moves as a prop does; when its sender falls silent, it is taken to stand still.
FileBody WorldReading::readTrigger(TomlSection& section) {
  FileBody body;
  body.line = section.line();
  body.trigger.emplace();
  body.whenSilent = WhenSilent::HoldStill;
  section.allowOnly({"name", "mesh", "node", "scale", "up", "sphere", "lss", "box", "when_silent",
                     "clip", "poses", "pose", "position", "yaw", "rotation", "attach", "detach",
                     "by_link", "watches"});
  readNameAndShape(section, body);
  readSilence(section, body);
  std::optional<bool> byLink;
  section.truth("by_link", byLink);
  body.trigger->byLink = byLink.value_or(false);
  for (TomlSection& one : section.tables("watches", body.title("watches"), kMaxFileBodies)) {
    one.allowOnly({"body", "link"});
    FileWatch watch;
    watch.line = one.line();
    one.text("body", watch.body, false);
    if (watch.body.empty()) one.fail(ErrorCode::Empty, "expected a body");
    one.text("link", watch.link, false);
    body.trigger->watched.push_back(std::move(watch));
  }
  if (hasKey(section, "watches") && body.trigger->watched.empty()) {
    section.fail(ErrorCode::Empty, "expected somebody in watches");
  }
  readMotion(section, body);
  readChanges(section, body);
  return body;
}

void WorldReading::readNameAndShape(TomlSection& section, FileBody& body) {
  section.text("name", body.name, false);
  if (body.name.empty()) section.fail(ErrorCode::Empty, "expected a name");
  readShape(section, reading_.file, body.trigger.has_value(), body.shape);
}

void WorldReading::readSilence(TomlSection& section, FileBody& body) {
  section.word<WhenSilent>("when_silent", {"wait", "hold-still", "undecided"},
                           {WhenSilent::Wait, WhenSilent::HoldStill, WhenSilent::Undecided},
                           body.whenSilent);
}

/// False if it is not there.
template <typename Legal>
bool WorldReading::readTime(TomlSection& section, const char* key, const char* inWords, Legal legal,
                            std::int64_t& utimeUs) {
  if (!hasKey(section, key)) return false;
  double seconds = 0.0;
  section.number(key, inWords, legal, seconds);
  utimeUs = inMicroseconds(seconds);
  return true;
}

std::int64_t WorldReading::readTime(TomlSection& section) {
  std::int64_t utimeUs = 0;
  if (readTime(section, "time", kTimeInWords, isTime, utimeUs)) return utimeUs;
  section.fail(ErrorCode::Empty, "expected a time");
  return utimeUs;
}

void WorldReading::readMotion(TomlSection& section, FileBody& body) {
  readClip(section, body);
  readPath(section, "poses", body.posesPath);
  readPoses(section, body);
  body.place = readPlace(section);
  const int given =
      static_cast<int>(!body.clip.motionPath.empty()) + static_cast<int>(!body.posesPath.empty()) +
      static_cast<int>(!body.poses.empty()) + static_cast<int>(body.place.has_value());
  if (given > 1) {
    section.fail(ErrorCode::Mismatch,
                 "expected one of clip, poses, pose and position (with rotation or yaw), found " +
                     std::to_string(given));
  }
  const bool isAvatar = !body.shape.avatarPath.empty();
  if (isAvatar && (!body.posesPath.empty() || !body.poses.empty())) {
    section.fail(ErrorCode::Mismatch,
                 "expected a clip for an avatar: poses are those of a prop, which has no joints");
  }
  if (isAvatar && !body.joint.empty()) {
    section.fail(ErrorCode::Mismatch,
                 "expected no joint in clip: an avatar follows all that the clip has");
  }
}

void WorldReading::readClip(TomlSection& section, FileBody& body) {
  if (!hasKey(section, "clip")) return;
  TomlSection clip = section.table("clip");
  body.clipLine = clip.line();
  Settings settings;
  addMotionSetting(settings, body.clip, "--motion", "CLIP");
  addRateSetting(settings, body.clip);
  addClipSettings(settings, body.clip);
  addSkipTPose(settings, body.clip);
  std::vector<std::string> keys{"joint", "start", "from", "until", "speed"};
  for (const Setting& setting : settings) keys.push_back(setting.key);
  clip.allowOnly(keys);
  readTable(section, "clip", reading_, settings, [](const Setting&) { return true; });
  if (body.clip.motionPath.empty()) clip.fail(ErrorCode::Empty, "expected a file");
  clip.text("joint", body.joint, false);
  readTiming(clip, body.timing);
}

void WorldReading::readTiming(TomlSection& section, ClipTiming& timing) {
  readTime(section, "start", kTimeInWords, isTime, timing.startUs);
  const auto isOfClip = [](double seconds) { return seconds >= 0.0 && isTime(seconds); };
  const char* const ofClip = "a number of seconds of the clip, at least 0";
  readTime(section, "from", ofClip, isOfClip, timing.fromUs);
  std::int64_t untilUs = 0;
  if (readTime(section, "until", ofClip, isOfClip, untilUs)) timing.untilUs = untilUs;
  if (timing.untilUs && *timing.untilUs < timing.fromUs) {
    section.fail(ErrorCode::OutOfRange, "expected until at or after from");
  }
  section.number(
      "speed", "a finite number from 0.001 to 1000",
      [](double speed) { return speed >= 1.0 / kMostSpeed && speed <= kMostSpeed; }, timing.speed);
}

void WorldReading::readPoses(TomlSection& section, FileBody& body) {
  for (TomlSection& one : section.tables("pose", body.title("pose"), kMaxFilePoses)) {
    one.allowOnly({"time", "position", "rotation", "yaw"});
    const std::int64_t utimeUs = readTime(one);
    if (!body.poses.empty() && utimeUs <= body.poses.back().utimeUs) {
      one.fail(ErrorCode::OutOfRange, "expected a time after that of the pose before it");
    }
    const auto pose = readPlace(one);
    if (!pose) one.fail(ErrorCode::Empty, "expected a position, rotation or yaw");
    if (reading_.error) return;
    body.poses.push_back({utimeUs, *pose, one.line()});
  }
}

void WorldReading::readChanges(TomlSection& section, FileBody& body) {
  for (TomlSection& one : section.tables("attach", body.title("attach"), kMaxFileChanges)) {
    one.allowOnly({"time", "to", "link", "moves", "position", "rotation", "yaw"});
    FileChange change;
    change.isAttached = true;
    change.line = one.line();
    change.utimeUs = readTime(one);
    one.text("to", change.carrier, false);
    if (change.carrier.empty()) one.fail(ErrorCode::Empty, "expected to, the name of a body");
    one.text("link", change.link, false);
    std::optional<bool> moves;
    one.truth("moves", moves);
    change.movesInFrame = moves.value_or(false);
    change.pose = readPlace(one);
    body.changes.push_back(std::move(change));
  }
  for (TomlSection& one : section.tables("detach", body.title("detach"), kMaxFileChanges)) {
    one.allowOnly({"time", "position", "rotation", "yaw"});
    FileChange change;
    change.line = one.line();
    change.utimeUs = readTime(one);
    change.pose = readPlace(one);
    body.changes.push_back(std::move(change));
  }
  std::stable_sort(body.changes.begin(), body.changes.end(),
                   [](const FileChange& x, const FileChange& y) { return x.utimeUs < y.utimeUs; });
  const auto twice = std::adjacent_find(
      body.changes.begin(), body.changes.end(),
      [](const FileChange& x, const FileChange& y) { return x.utimeUs == y.utimeUs; });
  if (twice == body.changes.end()) return;
  reading_.fail(ErrorCode::DuplicateName, std::next(twice)->line,
                body.title() + ": expected one attach or detach at an instant, found two");
}

void WorldReading::readAsks() {
  constexpr std::size_t kMost = 1024;  // of 32 groups, and the scene: all pairs
  for (TomlSection& one : root_.tables("ask", "[[ask]]", kMost)) {
    one.allowOnly({"group", "with", "asked"});
    FileAsk ask;
    ask.line = one.line();
    one.text("group", ask.group, false);
    one.text("with", ask.with, false);
    std::optional<bool> isAsked;
    one.truth("asked", isAsked);
    if (ask.group.empty() || ask.with.empty() || !isAsked) {
      one.fail(ErrorCode::Empty, "expected group, with and asked");
      return;
    }
    if (ask.with == kSceneWord) ask.with.clear();
    ask.isAsked = *isAsked;
    world_.asks.push_back(std::move(ask));
  }
}

void WorldReading::checkNames() {
  const bool isNobodyThere = world_.bodies.empty() || world_.bodies.front().trigger;
  if (isNobodyThere) reading_.fail(ErrorCode::Empty, -1, "expected at least one [[body]]");
  std::set<std::string> names;
  for (const FileBody& body : world_.bodies) {
    if (names.insert(body.name).second) continue;
    reading_.fail(
        ErrorCode::DuplicateName, body.line,
        body.title() + " name: expected one that no other body has, found " + inQuotes(body.name));
  }
}

}  // namespace

std::string FileBody::title(const std::string& inner) const {
  return (trigger ? "[[trigger" : "[[body") + (inner.empty() ? "" : "." + inner) + "]]";
}

Error named(Error error, const WorldFile& file) {
  constexpr std::string_view kBody = "body ";
  const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
  std::string& text = error.message;
  for (std::size_t at = text.find(kBody); at != std::string::npos; at = text.find(kBody, at + 1)) {
    const std::size_t first = at + kBody.size();
    std::size_t end = first;
    while (end < text.size() && isDigit(text[end]) && end < first + 6) ++end;
    if (end == first) continue;
    const auto body = static_cast<std::size_t>(std::stoul(text.substr(first, end - first)));
    if (body >= file.bodies.size()) continue;
    const std::string name = inQuotes(file.bodies[body].name);
    text.replace(at, end - at, name);
    at += name.size() - 1;
  }
  return error;
}

Setting& addWorldTolerance(Settings& settings, double& tolerance) {
  static constexpr NumberRange kRange{kMinWorldTolerance, kMaxTolerance, "metres", "m"};
  return settings
      .number("--tolerance", "M", tolerance, kRange, "Largest separation (m) of a reported contact")
      .in(kTouchGroup)
      .inConfig("query", "tolerance")
      .inHeader("tolerance")
      .inReport("tolerance");
}

Result<WorldFile> parseWorldFile(std::string_view text, const std::string& file) {
  FORETOUCH_TRY(const auto parsed, parseToml(text, file));
  return WorldReading(file, parsed).read();
}

Result<WorldFile> readWorldFile(const std::string& path) {
  FORETOUCH_TRY(const auto text, readWholeFile(path, kMaxTomlBytes));
  return parseWorldFile(text, path);
}

}  // namespace foretouch::tools
