#include "tools/ask/ask_command.h"

#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "articulated/skeleton.h"
#include "articulated/try.h"
#include "tools/ask/ask_text.h"
#include "tools/console.h"
#include "tools/settings/lists.h"
#include "tools/world/load_world.h"

namespace foretouch::tools {
namespace {

constexpr NumberRange kPlaces{-kMaxCoordinate, kMaxCoordinate, "metres", "m", true};
constexpr NumberRange kDirections{-1e300, 1e300, "", "", true};
constexpr NumberRange kRadii{0.0, kMaxCoordinate, "metres", "m", true};
constexpr NumberRange kHalfExtents{0.0, kMaxCoordinate, "metres", "m", true};
constexpr NumberRange kTurns{-1.0, 1.0, "", "", true};
/// How far from 1 the length of a typed quaternion may be.
constexpr double kTurnError = 1e-3;
constexpr NumberRange kReaches{0.0, kMostAskReach, "metres", "m"};

/// The values of all options.
struct AskedFile {
  std::string path;
  std::optional<std::int64_t> atUs;
  std::vector<double> from, to, along, box, turn, hull;
  double radius = 0.0, reach = 1000.0, within = 1.0;
  std::vector<std::string> only, without, seen;
  bool all = false, solids = false, asJson = false;
};

Result<Eigen::Vector3d> vectorOf(const std::vector<double>& numbers, const char* option) {
  if (numbers.size() == 3) return Eigen::Vector3d(numbers[0], numbers[1], numbers[2]);
  return Error::in(option, ErrorCode::Mismatch,
                   fmt::format("expected three numbers, X,Y,Z, found {}", numbers.size()));
}

/// The corners of a box or of a hull, from where it begins; empty: neither is asked about.
Result<std::vector<Eigen::Vector3d>> cornersOf(const AskedFile& asked, const Settings& given) {
  const bool isBox = given.isGiven("--box"), isHull = given.isGiven("--hull");
  const char* const option = isBox ? "--box" : "--hull";
  if ((isBox && isHull) || ((isBox || isHull) && given.isGiven("--to"))) {
    return Error::in(option, ErrorCode::Mismatch, "expected one of --box, --hull and --to");
  }
  if (given.isGiven("--turn") && !isBox) {
    return Error::in("--turn", ErrorCode::Mismatch, "expected --box beside it");
  }
  std::vector<Eigen::Vector3d> corners;
  if (isBox) {
    FORETOUCH_TRY(const auto half, vectorOf(asked.box, "--box"));
    if (!given.isGiven("--turn")) return boxCorners(half);
    const Eigen::Vector4d turn = Eigen::Map<const Eigen::Vector4d>(asked.turn.data());
    if (asked.turn.size() != 4 || !(std::abs(turn.norm() - 1.0) < kTurnError)) {
      return Error::in("--turn", ErrorCode::OutOfRange, "expected a unit quaternion, W,X,Y,Z");
    }
    const Eigen::Quaterniond axes(turn[0], turn[1], turn[2], turn[3]);
    return boxCorners(half, axes.normalized());
  }
  if (asked.hull.size() % 3 != 0) {
    return Error::in("--hull", ErrorCode::Mismatch,
                     fmt::format("expected three numbers per corner, X,Y,Z,X,Y,Z,..., found {}",
                                 asked.hull.size()));
  }
  for (std::size_t i = 0; i + 2 < asked.hull.size(); i += 3) {
    corners.emplace_back(asked.hull[i], asked.hull[i + 1], asked.hull[i + 2]);
  }
  return corners;
}

Result<BodyId> bodyNamed(const LoadedWorld& world, const std::string& name, const char* option) {
  for (std::size_t body = 0; body < world.numBodies(); ++body) {
    if (world.file.bodies[body].name == name) return static_cast<BodyId>(body);
  }
  std::string names;
  for (std::size_t body = 0; body < world.numBodies(); ++body) {
    names += (names.empty() ? "" : ", ") + world.file.bodies[body].name;
  }
  return Error::in(option, ErrorCode::UnknownName,
                   fmt::format("expected one of {}, found '{}'", names, name));
}

/// "scene", "Anna", "Anna/LeftHand".
Result<AskPart> partOf(const LoadedWorld& world, const std::string& text, const char* option) {
  if (text == "scene") return AskPart{};
  const std::size_t slash = text.find('/');
  FORETOUCH_TRY(const BodyId body, bodyNamed(world, text.substr(0, slash), option));
  if (slash == std::string::npos) return AskPart{body};
  const std::string link = text.substr(slash + 1);
  const Skeleton& skeleton = world.bodies[slotOf(body)].shape.skeleton;
  if (const auto found = skeleton.find(link)) return AskPart{body, *found};
  return Error::in(option, ErrorCode::UnknownName,
                   fmt::format("expected a link of {}, found '{}'", world.nameOf(body), link));
}

Result<Done> appendParts(const LoadedWorld& world, const std::vector<std::string>& texts,
                         const char* option, std::vector<AskPart>& parts) {
  for (const std::string& text : texts) {
    FORETOUCH_TRY(const AskPart part, partOf(world, text, option));
    parts.push_back(part);
  }
  return Done{};
}

/// "Anna=1.65": Anna as she was then.
Result<AskInstant> instantOf(const LoadedWorld& world, const std::string& text) {
  const std::size_t equals = text.find('=');
  double seconds = 0.0;
  if (equals == std::string::npos || !readNumber(text.substr(equals + 1), seconds) ||
      !isTime(seconds)) {
    return Error::in("--seen", ErrorCode::Syntax,
                     fmt::format("expected BODY=SECONDS, found '{}'", text));
  }
  FORETOUCH_TRY(const BodyId body, bodyNamed(world, text.substr(0, equals), "--seen"));
  return AskInstant{body, {inMicroseconds(seconds), 0.0}};
}

/// Triggers touch nothing.
void leaveOutTriggers(const LoadedWorld& world, WorldQuestion& question) {
  for (std::size_t body = world.numBodies(); body < world.bodies.size(); ++body) {
    question.without.push_back({static_cast<BodyId>(body)});
  }
}

Result<WorldQuestion> questionOf(const LoadedWorld& world, const AskedFile& asked,
                                 const Settings& given) {
  WorldQuestion question;
  FORETOUCH_TRY(question.shape.a, vectorOf(asked.from, "--from"));
  question.shape.b = question.shape.a;
  if (given.isGiven("--to")) {
    FORETOUCH_TRY(question.shape.b, vectorOf(asked.to, "--to"));
  }
  FORETOUCH_TRY(question.hull, cornersOf(asked, given));
  question.shape.radius = asked.radius;
  question.solids = asked.solids;
  question.time = {asked.atUs.value_or(world.beginUs), 0.0};
  const bool isCast = given.isGiven("--along"), isNear = given.isGiven("--within");
  if (isCast && isNear) {
    return Error::in("--within", ErrorCode::Mismatch, "expected --along or --within, found both");
  }
  if (given.isGiven("--reach") && !isCast) {
    return Error::in("--reach", ErrorCode::Mismatch, "expected --along beside it");
  }
  question.what = isCast ? AskWhat::Cast : isNear ? AskWhat::Nearest : AskWhat::Overlap;
  question.reach = isNear ? asked.within : asked.reach;
  if (isCast) {
    FORETOUCH_TRY(question.direction, vectorOf(asked.along, "--along"));
  }
  if (asked.all || question.what == AskWhat::Overlap) question.which = AskWhich::All;
  FORETOUCH_CHECK(appendParts(world, asked.only, "--only", question.only));
  FORETOUCH_CHECK(appendParts(world, asked.without, "--without", question.without));
  leaveOutTriggers(world, question);
  for (const std::string& text : asked.seen) {
    FORETOUCH_TRY(const AskInstant instant, instantOf(world, text));
    question.instants.push_back(instant);
  }
  return question;
}

ExitCode run(const AskedFile& asked, const Settings& given) {
  FORETOUCH_TRY_OR(failed, auto file, readWorldFile(asked.path));
  FORETOUCH_TRY_OR(failed, const auto world, loadWorld(std::move(file)));
  if (!asked.asJson) {
    for (const std::string& remark : world.remarks) printNote(remark);
  }
  FORETOUCH_TRY_OR(failed, const auto question, questionOf(world, asked, given));
  Scratch scratch;
  WorldAnswer answer;
  FORETOUCH_CHECK_OR(failed, askWorld(world.world, question, scratch, answer));
  printOut(asked.asJson ? answerLine(world, question, answer)
                        : answerText(world, question, answer));
  return ExitCode::Done;
}

void addShapeSettings(Settings& settings, AskedFile& asked) {
  addNumbers(settings, "--from", "X,Y,Z", asked.from, kPlaces, "Where the ray or the shape begins")
      .required();
  addNumbers(settings, "--to", "X,Y,Z", asked.to, kPlaces,
             "The other end of a capsule's axis; not given: a point, or a sphere");
  addNumbers(settings, "--box", "X,Y,Z", asked.box, kHalfExtents,
             "A box of these half extents around --from");
  addNumbers(settings, "--turn", "W,X,Y,Z", asked.turn, kTurns,
             "Of the box's own axes, as a unit quaternion; not given: those of the world");
  addNumbers(settings, "--hull", "X,Y,Z,...", asked.hull, kPlaces,
             "A convex solid: its corners, from --from");
  settings.number("--radius", "M", asked.radius, kRadii,
                  "Of the sphere or capsule; around the box or hull");
  addNumbers(settings, "--along", "X,Y,Z", asked.along, kDirections,
             "It moves in this direction: what does it hit? Not given: what does it overlap?");
  settings.number("--reach", "M", asked.reach, kReaches, "How far it moves");
  settings.number("--within", "M", asked.within, kReaches,
                  "Instead: what is nearest to it, up to so far?");
}

void addFilterSettings(Settings& settings, AskedFile& asked) {
  settings.flag("--solids", asked.solids,
                "Closed objects are solid: what begins inside one touches it");
  settings.flag("--all", asked.all, "All that is hit or near, in order, not the first alone");
  addWords(settings, "--only", "PART,...", asked.only, {},
           "Nothing but these: 'scene', a body, or BODY/LINK");
  addWords(settings, "--without", "PART,...", asked.without, {}, "Not these");
  addWords(settings, "--seen", "BODY=S,...", asked.seen, {},
           "These bodies as they were at instants of their own (s): as a player saw them who sees "
           "others late");
}

}  // namespace

Command askCommand() {
  const auto asked = std::make_shared<AskedFile>();
  Settings settings;
  settings
      .path("world", "WORLD", asked->path,
            "World file: a scene, bodies, and how they move (docs/formats.md)")
      .files("toml")
      .required("a world file");
  settings.seconds("--at", asked->atUs, "Instant of the world (s); not given: the first pose");
  settings.asJson(asked->asJson);
  addShapeSettings(settings, *asked);
  addFilterSettings(settings, *asked);
  Command command{
      "ask", "What a ray, a moved shape or a shape meets in a world at an instant",
      "Examples:\n"
      "  foretouch ask stage.toml --at 1.7 --from 0,1.2,3 --along 0,0,-1\n"
      "  foretouch ask stage.toml --at 1.7 --from 0,1.2,0 --radius 0.3\n"
      "  foretouch ask stage.toml --at 1.7 --from 0,1.2,0 --box 0.2,0.1,0.3 --along 0,-1,0\n"
      "  foretouch ask stage.toml --at 1.7 --from 0,1.2,0 --solids\n"
      "  foretouch ask stage.toml --at 1.7 --from 0,1.2,0 --within 2 --without scene",
      std::move(settings)};
  command.run = [asked](const Settings& given) { return run(*asked, given); };
  return command;
}

}  // namespace foretouch::tools
