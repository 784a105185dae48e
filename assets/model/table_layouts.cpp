// The layouts of public sets of motions of robots: assets/model/joint_table.h.
#include <algorithm>

#include "assets/model/joint_table.h"

namespace foretouch {
namespace {

using internal::TableLayout;

/// The 29 joints of a Unitree G1 behind its root, in the order of its model.
std::vector<std::string> columnsOfG1() {
  std::vector<std::string> columns{"root_x",  "root_y",  "root_z", "root_qx",
                                   "root_qy", "root_qz", "root_qw"};
  const auto add = [&](const std::string& before, std::initializer_list<const char*> names) {
    for (const char* const name : names) columns.push_back(before + name + "_joint");
  };
  for (const char* const side : {"left_", "right_"}) {
    add(side, {"hip_pitch", "hip_roll", "hip_yaw", "knee", "ankle_pitch", "ankle_roll"});
  }
  add("waist_", {"yaw", "roll", "pitch"});
  for (const char* const side : {"left_", "right_"}) {
    add(side, {"shoulder_pitch", "shoulder_roll", "shoulder_yaw", "elbow", "wrist_roll",
               "wrist_pitch", "wrist_yaw"});
  }
  return columns;
}

const std::vector<TableLayout>& layouts() {
  static const std::vector<TableLayout> all{
      // https://huggingface.co/datasets/lvhaidong/LAFAN1_Retargeting_Dataset
      {"lafan1-g1", columnsOfG1(), 30.0, false, 1.0, false},
      // https://nvlabs.github.io/ProtoMotions/getting_started/seed_g1_csv_preparation.html
      {"bones-seed-g1", {}, 120.0, true, 0.01, true},
  };
  return all;
}

}  // namespace

std::vector<std::string> tableLayouts() {
  std::vector<std::string> names;
  for (const TableLayout& layout : layouts()) names.emplace_back(layout.name);
  return names;
}

const TableLayout* internal::tableLayout(const std::string& name) {
  const auto found = std::find_if(layouts().begin(), layouts().end(),
                                  [&](const TableLayout& layout) { return name == layout.name; });
  return found == layouts().end() ? nullptr : &*found;
}

const TableLayout* internal::layoutIn(const JointTableOptions& options) {
  return options.columns.size() == 1 ? tableLayout(options.columns.front()) : nullptr;
}

}  // namespace foretouch
