#include "tools/certificate/certify_edges.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/avatar/avatar_file.h"
#include "assets/certificate/certificate_writer.h"
#include "assets/clip/clip_file.h"
#include "assets/import/model_import.h"
#include "assets/json_writer.h"
#include "assets/model/edge_table.h"
#include "assets/text_file.h"
#include "tools/inputs/ignored_pairs.h"

namespace foretouch::tools {
namespace {

struct AskedRoadmap {
  EdgeQuery query;
  EdgeTable edges;
};

Result<AskedRoadmap> roadmapOf(const AskedEdges& asked, const ReplayRequest& request) {
  RobotImportOptions options;
  options.reading.import.up = UpAxis::Z;  // as `avatar urdf` reads it
  options.reading.packagePaths = request.packagePaths;
  FORETOUCH_TRY(const auto imported, importRobot(request.robotPath, options));
  printNotes(request.robotPath, imported.notes);
  const Robot& robot = imported.made.robot;
  FORETOUCH_TRY(const auto scene, loadScene(request));
  FORETOUCH_TRY(const auto text, readWholeFile(asked.path, kMaxJointTableBytes));
  FORETOUCH_TRY(auto edges, readEdgeTable(robot, text, asked.path));
  EdgeOptions question;
  question.tolerance = request.query.tolerance;
  question.clearance = asked.clearance;
  FORETOUCH_TRY(question.ignored,
                parseIgnoredPairs(request.ignore, robot.avatar().skeleton(), scene.objectNames()));
  if (!request.pairsPath.empty()) {
    FORETOUCH_TRY(question.self, readPairsFile(request.pairsPath, robot.avatar()));
  } else if (request.asksSelf) {
    FORETOUCH_TRY(question.self, inFile(PairRules::derive(robot), "--self"));
  }
  FORETOUCH_TRY(auto query, EdgeQuery::build(robot, scene, question));
  return AskedRoadmap{std::move(query), std::move(edges)};
}

/// What an edge that is not clear meets: link, and own link or object.
struct MetOnEdge {
  std::string link, other, object;

  static MetOnEdge of(const EdgeQuery& query, const EdgeAnswer& answer) {
    const Skeleton& skeleton = query.robot().avatar().skeleton();
    const PairContact& contact = answer.contact;
    MetOnEdge met;
    if (contact.link >= 0) met.link = skeleton.name(contact.link);
    if (contact.other >= 0) {
      met.other = skeleton.name(contact.other);
    } else if (contact.triangle >= 0) {
      met.object = query.scene().objectNames()[slotOf(query.scene().object(contact.triangle))];
    }
    return met;
  }
  [[nodiscard]] std::string inWords() const {
    if (!other.empty()) return fmt::format("link \"{}\" and own link \"{}\"", link, other);
    return object.empty() ? fmt::format("link \"{}\"", link)
                          : fmt::format("link \"{}\" and object \"{}\"", link, object);
  }
  [[nodiscard]] bool operator==(const MetOnEdge& to) const {
    return link == to.link && other == to.other && object == to.object;
  }
};

/// One sentence, where all edges start with the same in contact: a base stands in its table.
std::optional<std::string> remarkOnStart(const EdgeQuery& query, const EdgeCertificate& made) {
  const MetOnEdge first = MetOnEdge::of(query, made.answers.front());
  const bool isSame =
      std::all_of(made.answers.begin(), made.answers.end(), [&](const EdgeAnswer& answer) {
        return answer.verdict == Verdict::StartsInContact && MetOnEdge::of(query, answer) == first;
      });
  if (!isSame) return std::nullopt;
  const std::string lead =
      fmt::format("all {} edges start with {} in contact; ", made.answers.size(), first.inWords());
  if (!first.other.empty()) {
    return lead + fmt::format(
                      "if the two may touch, leave the pair out of the rules: foretouch "
                      "avatar pairs --leave-out \"{}:{}\"",
                      first.link, first.other);
  }
  return lead + fmt::format(
                    "if it stands there, as a base does, ignore the pair: --ignore "
                    "\"{}:{}\"",
                    first.link, first.object);
}

std::string wordFor(const EdgeAnswer& answer) {
  return answer.verdict == Verdict::Clear ? "unproven" : toString(answer.verdict);
}

std::string edgesLine(const EdgeQuery& query, const EdgeCertificate& made) {
  std::string text;
  JsonWriter out(text);
  out.beginObject();
  out.field("edges", made.answers.size());
  out.field("proven", std::count(made.isProven.begin(), made.isProven.end(), true));
  out.field("unproven", made.counts.unproven);
  out.field("clearance", query.options().clearance);
  out.field("links", made.counts.links);
  out.field("pairs", made.counts.pairs);
  out.field("lss", made.counts.capsules);
  out.field("spans", made.counts.spans);
  out.field("planes", made.counts.planes);
  out.field("bytes", made.proof.size());
  out.key("not_proven");
  out.beginArray();
  for (std::size_t i = 0; i < made.answers.size(); ++i) {
    if (made.isProven[i]) continue;
    const EdgeAnswer& answer = made.answers[i];
    out.beginObject();
    out.field("edge", i);
    out.field("verdict", wordFor(answer));
    out.field("free_until", answer.freeUntil);
    if (answer.verdict != Verdict::Clear) {
      const MetOnEdge met = MetOnEdge::of(query, answer);
      if (!met.link.empty()) out.field("link", met.link);
      if (!met.other.empty()) out.field("other", met.other);
      if (!met.object.empty()) out.field("object", met.object);
    }
    out.endObject();
  }
  out.endArray();
  out.endObject();
  return text + "\n";
}

std::string edgesInWords(const EdgeQuery& query, const EdgeCertificate& made,
                         const std::string& folder) {
  constexpr std::size_t kMostNamed = 20;
  std::string text = fmt::format(
      "{} of {} edges are proven: {} links, {} pairs of own links, {} spans, {} planes, {} bytes\n",
      std::count(made.isProven.begin(), made.isProven.end(), true), made.answers.size(),
      made.counts.links, made.counts.pairs, made.counts.spans, made.counts.planes,
      made.proof.size());
  std::size_t others = 0;
  for (std::size_t i = 0; i < made.answers.size(); ++i) {
    const EdgeAnswer& answer = made.answers[i];
    if (made.isProven[i] || ++others > kMostNamed) continue;
    const std::string met =
        answer.verdict == Verdict::Clear ? "" : ": " + MetOnEdge::of(query, answer).inWords();
    text += fmt::format("edge {}: {}{}\n", i, wordFor(answer), met);
  }
  if (others > kMostNamed) text += fmt::format("and {} more\n", others - kMostNamed);
  return text + fmt::format(
                    "\nfor a stranger:\n  foretouch-verify {0}/scene.obj {0}/avatar.json "
                    "{0}/edges.txt {0}/certificate.txt\n",
                    folder);
}

Result<Done> checkGiven(const Settings& settings, const ReplayRequest& request,
                        const std::string& folder) {
  for (const auto& [option, value] :
       {std::pair<const char*, const std::string&>{"--robot", request.robotPath},
        {"--scene", request.scenePath},
        {"--output", folder}}) {
    if (value.empty()) return Error::in(option, ErrorCode::Empty, "expected it with --edges");
  }
  for (const char* const option : {"--motion", "--avatar", "--rate", "--animation", "--map",
                                   "--clip-scale", "--clip-up", "--place"}) {
    if (!settings.isGiven(option)) continue;
    return Error::in(option, ErrorCode::Mismatch, "not with --edges, which are of the robot alone");
  }
  return Done{};
}

}  // namespace

void addEdgeSettings(Settings& settings, AskedEdges& asked, WorldRequest& request) {
  settings
      .path("--edges", "CSV", asked.path,
            "In place of --avatar and --motion: edges of --robot, two rows of joint positions each")
      .files("csv")
      .in(kInputGroup)
      .standingForRequired();
  settings
      .number("--clearance", "M", asked.clearance, kZeroOrAbove,
              "Of edges: metres that the robot has to keep away, and own links between them")
      .in(kTouchGroup)
      .needing("--edges");
  settings
      .list("--ignore", "PAIRS", request.ignore, "Of edges: contacts to ignore; may be repeated")
      .in(kTouchGroup)
      .needing("--edges");
  settings
      .flag("--self", request.asksSelf,
            "Of edges: also prove own links apart, by rules that the robot's limits give")
      .in(kTouchGroup)
      .needing("--edges");
  settings.path("--pairs", "FILE", request.pairsPath, "With --self: the pair rules")
      .files("json")
      .in(kTouchGroup)
      .needing("--self");
}

ExitCode certifyEdgesOf(const Settings& settings, const AskedEdges& asked,
                        const ReplayRequest& request, const std::string& folder, bool asJson) {
  FORETOUCH_CHECK_OR(failed, checkGiven(settings, request, folder));
  FORETOUCH_TRY_OR(failed, const auto question, roadmapOf(asked, request));
  const EdgeTable& edges = question.edges;
  FORETOUCH_TRY_OR(failed, const auto made,
                   certifyEdges(question.query, edges.q0.data(), edges.q1.data(), edges.count));
  FORETOUCH_CHECK_OR(failed, writeEdgeCertificate(made, folder));
  if (const auto remark = remarkOnStart(question.query, made)) printNote(*remark);
  printOut(asJson ? edgesLine(question.query, made) : edgesInWords(question.query, made, folder));
  return made.counts.unproven == 0 ? ExitCode::Done : ExitCode::CheckSaysNo;
}

}  // namespace foretouch::tools
