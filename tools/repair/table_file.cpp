// A robot's table as its maker wrote it (CSV, NPZ): tools/repair/maker_file.h.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "articulated/try.h"
#include "assets/bvh/bvh_rewrite.h"
#include "assets/bvh/bvh_text.h"
#include "assets/clip/clip_file.h"
#include "assets/model/joint_table.h"
#include "assets/model/model_avatar.h"
#include "assets/text_file.h"
#include "lss/index.h"
#include "tools/feet/npz_file.h"
#include "tools/inputs/motion_file.h"
#include "tools/inputs/npz_arrays.h"
#include "tools/inputs/npz_motion.h"
#include "tools/repair/maker_file.h"

namespace foretouch::tools {
namespace {

using Eigen::Vector3d;
using internal::JointTable;

/// A column is tried by changing it by so much of its unit.
constexpr double kTry = 1e-3;
/// What a column moves by less than this (rad, m) per unit it does not move.
constexpr double kMoves = 1e-9;

/// What tables have in common, whatever holds their numbers.
class TableFile : public MakerFile {
 public:
  [[nodiscard]] Result<std::string> with(const Changes& changes) const override {
    JointTable after = table_;
    for (std::size_t row = 0; row < after.rows.size(); ++row) {
      const auto change = changes.col(static_cast<Eigen::Index>(row));
      Vector3d turn = Vector3d::Zero();
      for (std::size_t k = 0; k < knobs_.size(); ++k) {
        const Place& place = places_[k];
        const double by = change[static_cast<Eigen::Index>(k)];
        if (place.column >= 0) after.rows[row][slotOf(place.column)] += by / place.unit;
        if (place.shift >= 0) after.roots[row].translation[place.shift] += by;
        if (place.turn >= 0) turn[place.turn] += by;
      }
      if (turn.isZero(0.0)) continue;
      Quaternion& rotation = after.roots[row].rotation;
      const Eigen::Quaterniond by(Eigen::AngleAxisd(turn.norm(), turn.normalized()));
      rotation = Quaternion((Eigen::Quaterniond(rotation) * by).normalized());
    }
    return write(after);
  }

 protected:
  /// Where a knob's number stands in a table.
  struct Place {
    std::int32_t column = -1;  ///< In JointTable::joints; or of its root:
    int shift = -1, turn = -1;
    double unit = 1.0;  ///< Radians or metres per unit of the column.
  };
  [[nodiscard]] virtual Result<std::string> write(const JointTable& after) const = 0;
  Result<Done> findKnobs(const ClipRequest& request);

  std::string bytes_;
  ClipRequest request_;
  Model robot_;
  JointTable table_;
  std::vector<Place> places_;  // one per knob

 private:
  void addKnob(const Clip& tried, std::size_t row, Place place, std::string name);
  void limit(Knob& knob, const Place& place) const;
};

/// Moves each column, and each direction of the root, a little, and sees what moves.
Result<Done> TableFile::findKnobs(const ClipRequest& request) {
  request_ = request;
  JointTable tries = table_;
  tries.rows.assign(1, table_.rows.front());
  tries.lines.assign(1, table_.lines.front());
  if (!table_.roots.empty()) tries.roots.assign(1, table_.roots.front());
  std::vector<std::pair<Place, std::string>> all;
  const auto add = [&](const Place& place, std::string name) {
    all.emplace_back(place, std::move(name));
    tries.rows.push_back(table_.rows.front());
    tries.lines.push_back(table_.lines.front());
    if (place.column >= 0) tries.rows.back()[slotOf(place.column)] += kTry;
    if (table_.roots.empty()) return;
    RigidPose root = table_.roots.front();
    if (place.shift >= 0) root.translation[place.shift] += kTry;
    if (place.turn >= 0) {
      const Eigen::AngleAxisd turn(kTry, Vector3d::Unit(place.turn));
      root.rotation = Quaternion((Eigen::Quaterniond(root.rotation) * turn).normalized());
    }
    tries.roots.push_back(root);
  };
  for (int axis = 0; axis < 3 && !table_.roots.empty(); ++axis) {
    Place shift, turn;
    shift.shift = turn.turn = axis;
    add(shift, fmt::format("root shift {}", "xyz"[axis]));
    add(turn, fmt::format("root turn {}", "xyz"[axis]));
  }
  for (std::size_t k = 0; k < table_.joints.size(); ++k) {
    Place column;
    column.column = static_cast<std::int32_t>(k);
    add(column, table_.joints[k]);
  }
  FORETOUCH_TRY(const auto tried, internal::clipOfTable(robot_, tries));
  for (std::size_t i = 0; i < all.size(); ++i) addKnob(tried, i + 1, all[i].first, all[i].second);
  return Done{};
}

void TableFile::addKnob(const Clip& tried, std::size_t row, Place place, std::string name) {
  Knob knob;
  knob.name = std::move(name);
  const Pose &from = tried.frames.front(), &to = tried.frames[row];
  for (JointId joint = 0; joint < tried.skeleton.numJoints(); ++joint) {
    const std::size_t j = slotOf(joint);
    const Eigen::AngleAxisd turn(Eigen::Quaterniond(from.rotations[j]).conjugate() *
                                 Eigen::Quaterniond(to.rotations[j]));
    const Vector3d turned = turn.angle() / kTry * turn.axis();
    const Vector3d shifted = (to.translations[j] - from.translations[j]) / kTry;
    if (turned.norm() > kMoves) knob.drives.push_back({joint, true, turned});
    if (shifted.norm() > kMoves) knob.drives.push_back({joint, false, shifted});
  }
  if (knob.drives.empty()) return;
  if (place.column >= 0) {
    place.unit = knob.drives.front().turns ? table_.radiansPerUnit : table_.metresPerUnit;
    for (Drive& drive : knob.drives) drive.along /= place.unit;
    limit(knob, place);
  }
  knobs_.push_back(std::move(knob));
  places_.push_back(place);
}

void TableFile::limit(Knob& knob, const Place& place) const {
  for (const ModelNode& node : robot_.nodes) {
    if (node.jointName != knob.name && node.name != knob.name) continue;
    const bool isLimited =
        node.joint == ModelJointType::Revolute || node.joint == ModelJointType::Prismatic;
    if (!isLimited || !(node.lowerLimit < node.upperLimit)) return;
    knob.lower = node.lowerLimit;
    knob.upper = node.upperLimit;
    for (const auto& row : table_.rows)
      knob.values.push_back(row[slotOf(place.column)] * place.unit);
    return;
  }
}

/// A column's number in a row, and its value before.
struct Cell {
  std::size_t column = 0;
  double before = 0.0, after = 0.0;
};

/// The numbers of a root that have changed, in the order of the layout's columns.
void addRootCells(const RigidPose& before, const RigidPose& after, double metresPerUnit,
                  const std::vector<std::size_t>& columns, const std::vector<double>& row,
                  std::vector<Cell>& cells) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t column = columns[slotOf(axis)];
    const double shift = (after.translation[axis] - before.translation[axis]) / metresPerUnit;
    if (shift != 0.0) cells.push_back({column, row[column], row[column] + shift});
  }
  const Eigen::Quaterniond from(before.rotation);
  Eigen::Quaterniond to(after.rotation);
  if (from.coeffs() == to.coeffs()) return;
  if (columns.size() == 6) {  // angles about fixed axes, x first
    const auto angles = anglesAbout(to.toRotationMatrix(), {2, 1, 0},
                                    {row[columns[5]], row[columns[4]], row[columns[3]]});
    for (std::size_t i = 0; i < 3; ++i) {
      cells.push_back({columns[5 - i], row[columns[5 - i]], angles[i]});
    }
    return;
  }
  const Eigen::Vector4d written(row[columns[3]], row[columns[4]], row[columns[5]], row[columns[6]]);
  if (to.coeffs().dot(written) < 0.0) to.coeffs() = -to.coeffs();
  for (std::size_t i = 0; i < 4; ++i) {
    cells.push_back({columns[3 + i], written[static_cast<Eigen::Index>(i)],
                     to.coeffs()[static_cast<Eigen::Index>(i)]});
  }
}

class CsvFile : public TableFile {
 public:
  static Result<std::unique_ptr<MakerFile>> open(const ClipRequest& request) {
    auto file = std::make_unique<CsvFile>();
    FORETOUCH_TRY(file->bytes_, readWholeFile(request.motionPath, kMaxJointTableBytes));
    FORETOUCH_TRY(file->robot_, readRobotModel(clipFileOptionsOf(motionRequestOf(request))));
    FORETOUCH_TRY(file->table_, inFile(internal::parseJointTable(file->bytes_, request.table),
                                       request.motionPath));
    FORETOUCH_CHECK(file->findColumns(request));
    FORETOUCH_CHECK(file->findKnobs(request));
    return std::unique_ptr<MakerFile>(std::move(file));
  }
  [[nodiscard]] Result<Clip> reread(const std::string& bytes) const override {
    return clipFromJointPositions(robot_, bytes, request_.motionPath, request_.table);
  }

 protected:
  [[nodiscard]] Result<std::string> write(const JointTable& after) const override;

 private:
  Result<Done> findColumns(const ClipRequest& request);
  void replace(std::string_view line, std::vector<Cell> cells, std::string& out) const;

  JointTable whole_;  // with all columns, as they stand
  std::vector<std::size_t> jointColumns_, rootColumns_;
};

Result<Done> CsvFile::findColumns(const ClipRequest& request) {
  const internal::TableLayout* const layout = internal::layoutIn(request.table);
  const auto& named = layout != nullptr ? layout->columns : request.table.columns;
  FORETOUCH_TRY(whole_, inFile(internal::parseTable(bytes_, named, ""), request.motionPath));
  const bool isOfSeed = layout != nullptr && layout->isOfSeed;
  const std::vector<std::string> root =
      isOfSeed ? std::vector<std::string>{"root_translateX", "root_translateY", "root_translateZ",
                                          "root_rotateX",    "root_rotateY",    "root_rotateZ"}
               : internal::rootColumns();
  const auto placeOf = [&](const std::string& name) {
    const auto found = std::find(whole_.joints.begin(), whole_.joints.end(), name);
    return slotOf(found - whole_.joints.begin());
  };
  if (!table_.roots.empty()) {
    for (const std::string& name : root) rootColumns_.push_back(placeOf(name));
  }
  const auto isRoot = [&](std::size_t column) {
    return std::find(rootColumns_.begin(), rootColumns_.end(), column) != rootColumns_.end();
  };
  bool hasTime = false;
  for (std::size_t column = 0; column < whole_.joints.size(); ++column) {
    const std::string& name = whole_.joints[column];
    const bool isTime = !hasTime && internal::isKeyword(name, "time");
    hasTime = hasTime || isTime;
    if (!isTime && !isRoot(column) && !(isOfSeed && name == "Frame")) {
      jointColumns_.push_back(column);
    }
  }
  return Done{};
}

/// The line with these cells' numbers; blanks and quotes around them stay.
void CsvFile::replace(std::string_view line, std::vector<Cell> cells, std::string& out) const {
  std::sort(cells.begin(), cells.end(),
            [](const Cell& x, const Cell& y) { return x.column < y.column; });
  std::size_t column = 0, at = 0, copied = 0;
  for (const Cell& cell : cells) {
    for (; column < cell.column; ++column) at = line.find(',', at) + 1;
    const std::size_t end = std::min(line.find(',', at), line.size());
    const std::size_t first = line.find_first_not_of(" \t\"", at);
    const std::size_t last = line.find_last_not_of(" \t\"\r", end - 1) + 1;
    const std::string_view word = line.substr(first, last - first);
    const int digits = std::max(8, digitsBehindPoint(word));
    if (std::abs(cell.after - cell.before) < 0.5 * std::pow(10.0, -digits)) continue;
    out.append(line, copied, first - copied);
    out += fmt::format("{:.{}f}", cell.after, digits);
    copied = last;
  }
  out.append(line, copied, std::string_view::npos);
}

Result<std::string> CsvFile::write(const JointTable& after) const {
  std::string out;
  std::string_view rest = bytes_;
  std::size_t row = 0;
  for (std::int64_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size() - 1) + 1;
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(end);
    if (row == table_.lines.size() || table_.lines[row] != number) {
      out += line;
      continue;
    }
    std::vector<Cell> cells;
    for (std::size_t k = 0; k < jointColumns_.size(); ++k) {
      if (after.rows[row][k] == table_.rows[row][k]) continue;
      cells.push_back({jointColumns_[k], table_.rows[row][k], after.rows[row][k]});
    }
    if (!rootColumns_.empty()) {
      addRootCells(table_.roots[row], after.roots[row], table_.metresPerUnit, rootColumns_,
                   whole_.rows[row], cells);
    }
    const bool endsLine = line.back() == '\n';
    replace(endsLine ? line.substr(0, line.size() - 1) : line, std::move(cells), out);
    if (endsLine) out += '\n';
    ++row;
  }
  return out;
}

class NpzTable : public TableFile {
 public:
  static Result<std::unique_ptr<MakerFile>> open(const ClipRequest& request) {
    auto file = std::make_unique<NpzTable>();
    FORETOUCH_TRY(file->bytes_, readWholeFile(request.motionPath, kMaxJointTableBytes));
    FORETOUCH_TRY(file->robot_, readRobotModel(clipFileOptionsOf(motionRequestOf(request))));
    FORETOUCH_TRY(file->table_,
                  inFile(tableFromNpz(file->bytes_, request.table), request.motionPath));
    FORETOUCH_CHECK(file->findKnobs(request));
    return std::unique_ptr<MakerFile>(std::move(file));
  }
  [[nodiscard]] Result<Clip> reread(const std::string& bytes) const override {
    FORETOUCH_TRY(const auto table,
                  inFile(tableFromNpz(bytes, request_.table), request_.motionPath));
    return inFile(internal::clipOfTable(robot_, table), request_.motionPath);
  }

 protected:
  [[nodiscard]] Result<std::string> write(const JointTable& after) const override;

 private:
  /// Changes the numbers of an array that are not as they were.
  void changeTurns(const std::string& name, const JointTable& after,
                   std::vector<double>& numbers) const;
};

void NpzTable::changeTurns(const std::string& name, const JointTable& after,
                           std::vector<double>& numbers) const {
  const bool endsWxyz = name.size() > 5 && name.compare(name.size() - 5, 5, "_wxyz") == 0;
  const bool isWxyz = endsWxyz || request_.table.quaternion == QuaternionOrder::Wxyz;
  for (std::size_t row = 0; row < table_.rows.size(); ++row) {
    Eigen::Quaterniond to(after.roots[row].rotation);
    if (Eigen::Quaterniond(table_.roots[row].rotation).coeffs() == to.coeffs()) continue;
    double* const q = &numbers[4 * row];
    const std::array<double, 4> written = isWxyz ? std::array{to.w(), to.x(), to.y(), to.z()}
                                                 : std::array{to.x(), to.y(), to.z(), to.w()};
    double dot = 0.0;
    for (std::size_t i = 0; i < 4; ++i) dot += q[i] * written[i];
    for (std::size_t i = 0; i < 4; ++i) q[i] = dot < 0.0 ? -written[i] : written[i];
  }
}

Result<std::string> NpzTable::write(const JointTable& after) const {
  FORETOUCH_TRY(const auto arrays, inFile(NpzArrays::of(bytes_), request_.motionPath));
  NpzFile out;
  for (const std::string& name : arrays.names()) {
    FORETOUCH_TRY(auto content, inFile(arrays.content(name), request_.motionPath));
    const bool isJoints = name == "joint_pos" || name == "dof_pos";
    const bool isPlace = name == "root_pos" || name == "root_trans" || name == "base_pos";
    const bool isTurn = name.rfind("root_rot", 0) == 0 || name.rfind("root_quat", 0) == 0 ||
                        name.rfind("base_quat", 0) == 0;
    if (isJoints || (isPlace && !table_.roots.empty()) || (isTurn && !table_.roots.empty())) {
      FORETOUCH_TRY(auto array, inFile(arrays.array(name), request_.motionPath));
      std::vector<double>& numbers = array.numbers;
      const std::size_t width = isJoints ? table_.joints.size() : 3;
      for (std::size_t row = 0; row < table_.rows.size() && isJoints; ++row) {
        std::copy(after.rows[row].begin(), after.rows[row].end(),
                  numbers.begin() + static_cast<std::ptrdiff_t>(row * width));
      }
      for (std::size_t row = 0; row < table_.rows.size() && isPlace; ++row) {
        const Vector3d shift = after.roots[row].translation - table_.roots[row].translation;
        for (int axis = 0; axis < 3; ++axis)
          numbers[row * width + slotOf(axis)] += shift[axis] / table_.metresPerUnit;
      }
      if (isTurn) changeTurns(name, after, numbers);
      FORETOUCH_CHECK_OR([&](const Error& error) { return inFile(error, request_.motionPath); },
                         arrays.replaceNumbers(numbers, content));
    }
    out.addContent(name, content);
  }
  return out.bytes();
}

}  // namespace

Result<std::unique_ptr<MakerFile>> openTable(const ClipRequest& request) {
  const std::string& path = request.motionPath;
  const bool isNpz = path.size() > 4 && (path.back() == 'z' || path.back() == 'Z');
  return isNpz ? NpzTable::open(request) : CsvFile::open(request);
}

}  // namespace foretouch::tools
