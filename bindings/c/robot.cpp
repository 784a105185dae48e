// bindings/c/robot.cpp: ft_robot.
#include <string>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "assets/import/model_import.h"
#include "bindings/c/import_options.h"
#include "bindings/c/robot_handle.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

static_assert(static_cast<int>(RobotJointKind::Fixed) == FT_JOINT_FIXED);
static_assert(static_cast<int>(RobotJointKind::Revolute) == FT_JOINT_REVOLUTE);
static_assert(static_cast<int>(RobotJointKind::Continuous) == FT_JOINT_CONTINUOUS);
static_assert(static_cast<int>(RobotJointKind::Prismatic) == FT_JOINT_PRISMATIC);
static_assert(static_cast<int>(RobotJointKind::Planar) == FT_JOINT_PLANAR);

constexpr std::size_t kMaxPackagePaths = 4096;

ft_urdf_options defaultUrdfOptions() {
  ft_urdf_options options{};
  options.size = sizeof options;
  options.max_lss_per_link = ModelAvatarOptions().maxLssPerLink;
  return options;
}

ft_status readUrdfOptions(const ft_urdf_options* given, RobotImportOptions& options) {
  ft_urdf_options known = defaultUrdfOptions();
  if (given != nullptr) {
    if (const auto s = readStruct(given, "ft_urdf_options", known); s != FT_OK) return s;
  }
  if (known.use_visual != 0 && known.use_visual != 1) {
    return failure(FT_ERROR_OUT_OF_RANGE, kNoIndex, "use_visual: expected 0 or 1, found %d",
                   known.use_visual);
  }
  if (const auto s = zero(static_cast<std::uint32_t>(known.reserved), "reserved"); s != FT_OK) {
    return s;
  }
  const auto s =
      neededArray(known.package_paths, known.package_count, kMaxPackagePaths, "package_paths");
  if (s != FT_OK) return s;
  for (std::size_t i = 0; i < known.package_count; ++i) {
    if (const auto n = needed(known.package_paths[i], "package_paths"); n != FT_OK) return n;
    options.reading.packagePaths.emplace_back(known.package_paths[i]);
  }
  options.reading.urdfSurface =
      known.use_visual == 1 ? UrdfSurface::Visual : UrdfSurface::Collision;
  options.making.maxLssPerLink = known.max_lss_per_link;
  return readImportOptions(known.import, options.reading.import);
}

ft_status readJoint(const ft_robot_joint& given, std::size_t index, RobotJoint& joint) {
  if (given.kind < FT_JOINT_FIXED || given.kind > FT_JOINT_PLANAR) {
    return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(index),
                   "joints: expected a `kind` from FT_JOINT_FIXED to FT_JOINT_PLANAR, found %d",
                   given.kind);
  }
  joint.kind = static_cast<RobotJointKind>(given.kind);
  if (joint.kind == RobotJointKind::Fixed) return FT_OK;
  joint.axis = Eigen::Map<const Eigen::Vector3d>(given.axis);
  joint.lower = given.lower;
  joint.upper = given.upper;
  joint.mimicOf = given.mimic_of;
  joint.mimicFactor = given.mimic_factor;
  joint.mimicOffset = given.mimic_offset;
  return FT_OK;
}

ft_status makeRobot(Robot made, ft_robot** robot) {
  auto parts = std::make_shared<const AvatarParts>(AvatarParts{made.avatar(), std::nullopt});
  *robot = new ft_robot{ft_robot::kMark, std::move(made), std::move(parts)};
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_robot_create(const ft_avatar* avatar, const ft_robot_joint* joints, size_t joint_count,
                          const char* const* names, ft_robot** robot) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(robot); s != FT_OK) return s;
    if (const auto s = checked(avatar); s != FT_OK) return s;
    const auto s = neededArray(joints, joint_count, countOf(kMaxJoints), "joints");
    if (s != FT_OK) return s;
    std::vector<RobotJoint> all(joint_count);
    for (std::size_t i = 0; i < joint_count; ++i) {
      if (const auto r = readJoint(joints[i], i, all[i]); r != FT_OK) return r;
      if (names == nullptr) continue;
      if (const auto n = needed(names[i], "names"); n != FT_OK) return n;
      all[i].name = names[i];
    }
    FORETOUCH_TRY_OR(failure, auto made, Robot::build(avatar->parts->avatar, std::move(all)));
    return makeRobot(std::move(made), robot);
  });
}

ft_status ft_urdf_options_init(ft_urdf_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_urdf_options", defaultUrdfOptions());
}

ft_status ft_robot_create_from_urdf(const char* path, const ft_urdf_options* options,
                                    ft_robot** robot) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(robot); s != FT_OK) return s;
    if (const auto s = needed(path, "path"); s != FT_OK) return s;
    RobotImportOptions known;
    if (const auto s = readUrdfOptions(options, known); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto imported, importRobot(path, known));
    return makeRobot(std::move(imported.made.robot), robot);
  });
}

ft_status ft_robot_create_with_tool(const ft_robot* robot, int32_t link, const char* name,
                                    const ft_lss* lss, size_t lss_count, ft_robot** tooled) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(tooled, "tooled"); s != FT_OK) return s;
    *tooled = nullptr;
    if (const auto s = checked(robot); s != FT_OK) return s;
    if (const auto s = needed(name, "name"); s != FT_OK) return s;
    if (const auto s = neededArray(lss, lss_count, kMaxLssPerLink, "lss"); s != FT_OK) return s;
    std::vector<Lss> all;
    for (std::size_t i = 0; i < lss_count; ++i) {
      all.push_back({Eigen::Map<const Eigen::Vector3d>(lss[i].a),
                     Eigen::Map<const Eigen::Vector3d>(lss[i].b), lss[i].radius});
    }
    FORETOUCH_TRY_OR(failure, auto made, robot->robot.withTool(link, name, std::move(all)));
    return makeRobot(std::move(made), tooled);
  });
}

ft_status ft_robot_avatar(const ft_robot* robot, ft_avatar** avatar) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(avatar); s != FT_OK) return s;
    if (const auto s = checked(robot); s != FT_OK) return s;
    *avatar = new ft_avatar{ft_avatar::kMark, robot->avatar};
    return FT_OK;
  });
}

ft_status ft_robot_coordinate_count(const ft_robot* robot, size_t* count) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = needed(count, "count"); s != FT_OK) return s;
    if (const auto s = checked(robot); s != FT_OK) return s;
    *count = robot->robot.numCoordinates();
    return FT_OK;
  });
}

ft_status ft_robot_coordinates(const ft_robot* robot, ft_robot_coordinate* coordinates,
                               size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(robot); s != FT_OK) return s;
    const auto& all = robot->robot.coordinates();
    const Room room = roomFor(all.size(), coordinates, capacity, required, "coordinates");
    if (room.status != FT_OK || room.isAsking || all.empty()) return room.status;
    const auto at = [&](std::size_t i) {
      ft_robot_coordinate c{};
      c.joint = all[i].joint;
      c.name = all[i].name.c_str();
      c.lower = all[i].lower;
      c.upper = all[i].upper;
      c.is_angle = all[i].isAngle ? 1 : 0;
      c.is_periodic = all[i].isPeriodic ? 1 : 0;
      return c;
    };
    return writeStructs("ft_robot_coordinate", all.size(), at, coordinates);
  });
}

ft_status ft_robot_pose(const ft_robot* robot, const double* q, size_t coordinate_count,
                        double* rotations, double* translations, size_t capacity,
                        size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(robot); s != FT_OK) return s;
    if (const auto s = needed(q, "q"); s != FT_OK) return s;
    FORETOUCH_CHECK_OR(failure, robot->robot.checked(q, coordinate_count));
    Pose pose;
    robot->robot.poseAt(q, pose);
    return writePose(pose, rotations, translations, capacity, required);
  });
}

ft_status ft_robot_path(const ft_robot* robot, const double* q, size_t count,
                        size_t coordinate_count, double* rotations, double* translations,
                        double* at, size_t capacity, size_t* required) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(robot); s != FT_OK) return s;
    if (const auto s = needed(q, "q"); s != FT_OK) return s;
    FORETOUCH_CHECK_OR(failure, robot->robot.checked(q, coordinate_count));
    FORETOUCH_TRY_OR(failure, const auto path, robot->robot.pathAlong(q, count));
    const void* const any = rotations != nullptr      ? rotations
                            : translations != nullptr ? translations
                                                      : at;
    const Room room = roomFor(path.poses.size(), any, capacity, required, "poses");
    if (room.status != FT_OK || room.isAsking) return room.status;
    const std::size_t joints = robot->robot.joints().size();
    for (std::size_t i = 0; i < path.poses.size(); ++i) {
      if (at != nullptr) at[i] = path.at[i];
      if (rotations == nullptr && translations == nullptr) continue;
      const auto s = writePose(
          path.poses[i], rotations == nullptr ? nullptr : rotations + 4 * i * joints,
          translations == nullptr ? nullptr : translations + 3 * i * joints, joints, nullptr);
      if (s != FT_OK) return s;
    }
    return FT_OK;
  });
}

void ft_robot_destroy(ft_robot* robot) {
  destroy(__func__, robot);
}
