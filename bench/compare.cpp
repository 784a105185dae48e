#include "bench/compare.h"

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "bench/fidelity_comparison.h"
#include "bench/machine.h"
#include "bench/rigid_comparison.h"
#include "tools/console.h"
#include "tools/progress.h"

namespace foretouch::tools {
namespace {

std::string nameOf(const std::string& path) {
  return std::filesystem::path(path).filename().string();
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
  BenchReport report;
  report.kind = "compare";
  report.title = "The same steps as other models see them";
  report.command = ownCommandLine();
  report.date = dateNow();
  report.machine = machineFacts();
  report.workload = {{"scene", fmt::format("{}, {} triangles", nameOf(inputs.request.scenePath),
                                           inputs.scene.numTriangles())},
                     {"avatar", fmt::format("{}, {} links", nameOf(inputs.request.avatarPath),
                                            inputs.avatar.numLinks())},
                     {"clip", fmt::format("{}, {} steps at {:.5g} poses a second",
                                          nameOf(inputs.request.motionPath), inputs.steps.count,
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

}  // namespace

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

}  // namespace foretouch::tools
