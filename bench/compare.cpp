// bench/compare.cpp: the same steps as three models see them: the product, a check of the two poses
// alone, and rigid links that know only their own two poses; and, at exact fidelity, the links'
// LSS.
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "articulated/result.h"
#include "articulated/try.h"
#include "bench/commands.h"
#include "bench/machine.h"
#include "bench/options.h"
#include "bench/report.h"
#include "bench/rigid_comparison.h"
#include "tools/console.h"
#include "tools/inputs/policy_rules.h"
#include "tools/inputs/replay_inputs.h"
#include "tools/progress.h"
#include "tools/report/document_parts.h"
#include "tools/results_output.h"

namespace foretouch::tools {
namespace {

/// Counts of links over one step or many: whose LSS touch (contact, or from the start).
struct FidelityCounts {
  std::int64_t lssContacts = 0;
  std::int64_t refuted = 0;    ///< Of these, the mesh is clear.
  std::int64_t later = 0;      ///< The mesh touches later.
  std::int64_t broken = 0;     ///< The mesh touches and the LSS do not, or earlier: always 0, or a
                               ///< bug.
  std::int64_t undecided = 0;  ///< By either: not compared.
  double lssUs = 0.0;          ///< Cost of the LSS' answer.

  void add(const FidelityCounts& other) {
    lssContacts += other.lssContacts;
    refuted += other.refuted;
    later += other.later;
    broken += other.broken;
    undecided += other.undecided;
    lssUs += other.lssUs;
  }
};

bool touches(const LinkContact& contact) {
  return contact.verdict == Verdict::Contact || contact.verdict == Verdict::StartsInContact;
}

/// The same question at link fidelity.
Result<Query> askLinks(const Query& exact) {
  QueryOptions coarser = exact.options();
  coarser.fidelity = Fidelity::Link;
  // Compared is each link's first contact with the scene, which is the same in both scopes.
  if (coarser.scope == Scope::EveryObject) coarser.scope = Scope::EveryLink;
  coarser.self.reset();
  for (LinkPolicy& policy : coarser.linkPolicies) policy.fidelity = Fidelity::Link;
  return Query::build(exact.avatar(), exact.scene(), coarser);
}

/// Compares `exact`, the answer to `motion`, with that of the LSS alone: how many contacts
/// exactness refutes.
FidelityCounts compareWithLink(const Query& link, const ChainMotion& motion,
                               const StepContacts& exact, Scratch& scratch) {
  const auto start = std::chrono::steady_clock::now();
  const StepContacts coarse = link.answer(motion, scratch);
  const std::chrono::duration<double, std::micro> elapsed =
      std::chrono::steady_clock::now() - start;
  FidelityCounts counts;
  counts.lssUs = elapsed.count();
  for (std::size_t i = 0; i < exact.links.size(); ++i) {
    const LinkContact& mesh = exact.links[i];
    const LinkContact& lss = coarse.links[i];
    if (mesh.verdict == Verdict::Undecided || lss.verdict == Verdict::Undecided) {
      ++counts.undecided;
      continue;
    }
    if (touches(lss)) ++counts.lssContacts;
    if (touches(lss) && !touches(mesh)) ++counts.refuted;
    if (touches(mesh) && (!touches(lss) || mesh.toi < lss.toi)) ++counts.broken;
    if (touches(mesh) && touches(lss) && mesh.toi > lss.toi) ++counts.later;
  }
  return counts;
}

struct Compared {
  std::int64_t missedByPoses = 0;
  RigidCounts rigid;
  std::optional<FidelityCounts> link;  ///< At exact fidelity.
};

class Comparison {
 public:
  static Result<Comparison> build(const ReplayInputs& inputs) {
    FORETOUCH_TRY(auto query, Query::build(inputs.avatar, inputs.scene, inputs.query));
    FORETOUCH_TRY(auto rigid, RigidComparison::build(inputs.avatar, inputs.scene, inputs.query));
    Comparison built(inputs, std::move(query), std::move(rigid));
    if (inputs.query.surface) {
      FORETOUCH_TRY(built.link_, askLinks(built.query_));
      built.counts_.link.emplace();
    }
    return Result<Comparison>(std::move(built));
  }

  Result<Done> add(std::int64_t step) {
    const std::int64_t stride = inputs_->steps.stride;
    FORETOUCH_TRY(const auto from, poseAtFrame(*inputs_, step * stride));
    FORETOUCH_TRY(const auto to, poseAtFrame(*inputs_, (step + 1) * stride));
    const ChainMotion motion(inputs_->avatar.skeleton(), from, to);
    const StepContacts contacts = query_.answer(motion, scratch_);
    countMissedByPoses(motion, contacts);
    FORETOUCH_TRY(const auto rigid,
                  inFile(rigid_.compare(motion, contacts, scratch_), inputs_->request.motionPath));
    counts_.rigid.add(rigid);
    if (link_) counts_.link->add(compareWithLink(*link_, motion, contacts, scratch_));
    return Done{};
  }

  [[nodiscard]] const Compared& counts() const { return counts_; }

 private:
  Comparison(const ReplayInputs& inputs, Query query, RigidComparison rigid)
      : inputs_(&inputs), query_(std::move(query)), rigid_(std::move(rigid)) {}

  void countMissedByPoses(const ChainMotion& motion, const StepContacts& contacts) {
    for (const LinkContact& contact : contacts.links) {
      if (contact.verdict != Verdict::Contact) continue;
      const bool isSeen = query_.touchesAt(motion, contact.link, 0.0, scratch_) ||
                          query_.touchesAt(motion, contact.link, 1.0, scratch_);
      counts_.missedByPoses += isSeen ? 0 : 1;
    }
  }

  const ReplayInputs* inputs_;
  Query query_;
  RigidComparison rigid_;
  std::optional<Query> link_;
  Scratch scratch_;
  Compared counts_;
};

BenchTable rigidTable(const Compared& counts) {
  BenchTable table;
  table.name = "poses_or_rigid";
  table.title = "First contacts, and what a check of the poses and rigid links say of them";
  table.columns = {{"contacts", "first contacts"},
                   {"missed_by_poses", "discrete check misses"},
                   {"missed_by_rigid", "rigid model misses"},
                   {"rigid_late", "late by over 1 mm"},
                   {"rigid_early", "early by over 1 mm"},
                   {"false_contacts", "false contacts"},
                   {"undecided", "not compared"}};
  const RigidCounts& rigid = counts.rigid;
  table.rows = {{rigid.contacts, counts.missedByPoses, rigid.missed, rigid.late, rigid.early,
                 rigid.falseContacts, rigid.undecided}};
  return table;
}

BenchTable linkTable(const FidelityCounts& counts, std::int64_t steps) {
  BenchTable table;
  table.name = "link";
  table.title = "Contacts of the LSS (first or from the start), and what the meshes say of them";
  table.columns = {{"lss_contacts", "LSS contacts"},
                   {"refuted", "refuted"},
                   {"later", "later"},
                   {"broken", "earlier or new"},
                   {"undecided", "not compared"},
                   {"lss_us", "LSS us a step", 1}};
  table.rows = {{counts.lssContacts, counts.refuted, counts.later, counts.broken, counts.undecided,
                 counts.lssUs / static_cast<double>(steps)}};
  return table;
}

BenchReport reportOf(const ReplayInputs& inputs, const Compared& counts) {
  BenchReport report = startedReport("compare", "The same steps as other models see them");
  report.workload = {{"scene", fmt::format("{}, {} triangles", fileName(inputs.request.scenePath),
                                           inputs.scene.numTriangles())},
                     {"avatar", fmt::format("{}, {} links", fileName(inputs.request.avatarPath),
                                            inputs.avatar.numLinks())},
                     {"clip", fmt::format("{}, {} steps at {:.5g} poses a second",
                                          fileName(inputs.request.motionPath), inputs.steps.count,
                                          rateTaken(inputs.steps, inputs.clip.frameTimeS))},
                     {"fidelity", toString(inputs.query.fidelity)},
                     {"tolerance", fmt::format("{:g} m", inputs.query.tolerance)}};
  report.tables.push_back(rigidTable(counts));
  if (counts.link) report.tables.push_back(linkTable(*counts.link, inputs.steps.count));
  report.notes = {
      "A discrete check looks only at the two poses. The rigid model is a perfect solver that "
      "knows "
      "only each link's own two end poses: position on a line, rotation by slerp."};
  return report;
}

/// Every step of the clip, on one thread. Errors name the file or option.
Result<BenchReport> measureComparison(const ReplayRequest& request) {
  FORETOUCH_TRY(const auto inputs, loadReplayInputs(request));
  for (const std::string& remark : remarksOn(inputs)) printNote(remark);
  FORETOUCH_TRY(auto comparison, Comparison::build(inputs));
  ProgressBar progress("compare", inputs.steps.count);
  for (std::int64_t step = 0; step < inputs.steps.count; ++step) {
    FORETOUCH_CHECK(comparison.add(step));
    progress.advanceTo(step + 1);
  }
  return reportOf(inputs, comparison.counts());
}

struct AskedComparison {
  ReplayRequest request;
  FigureFiles figures;  ///< Without lines for a CSV.
};

ExitCode run(AskedComparison& asked) {
  ReplayRequest& request = asked.request;
  if (request.budgetUs > 0) {
    return failed(Error::in("--budget-us", ErrorCode::Mismatch,
                            "expected none: what is undecided has nothing to compare"));
  }
  FORETOUCH_CHECK_OR(failed, readPolicies(request));
  if (const std::string& json = asked.figures.json; !json.empty()) {
    FORETOUCH_CHECK_OR(failed,
                       checkOutput(json, {request.scenePath, request.avatarPath, request.motionPath,
                                          request.mapPath, request.robotPath, request.policyPath}));
  }
  FORETOUCH_TRY_OR(failed, const auto report, measureComparison(request));
  return finished(report, {}, asked.figures);
}

}  // namespace

Command compareCommand() {
  const auto asked = std::make_shared<AskedComparison>();
  Settings settings;
  addSceneSettings(settings, asked->request);
  settings.of("--scene").required();
  addAvatarSetting(settings, asked->request).required();
  addMotionSetting(settings, asked->request, "--motion", "CLIP").required();
  addRateSetting(settings, asked->request);
  addClipSettings(settings, asked->request);
  addQuerySettings(settings, asked->request);
  settings.of("--fidelity").only({"link", "exact"});
  settings.path("--policy", "FILE", asked->request.policyPath, "As of replay: [[policy]] tables");
  settings.output("--json", "FILE", asked->figures.json, "Also write the figures to a file");
  Command command{"compare",
                  "What a check of the poses, rigid links and, at exact fidelity, LSS make of a "
                  "clip's contacts",
                  "Example:\n  foretouch-bench compare --scene kitchen.ply --scene-up z --avatar "
                  "man.avatar.json --motion kick.bvh --clip-scale 0.01 --rate 10",
                  std::move(settings)};
  command.run = [asked](const Settings&) { return run(*asked); };
  return command;
}

}  // namespace foretouch::tools
