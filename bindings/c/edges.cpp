// bindings/c/edges.cpp: ft_edges.
#include <optional>
#include <utility>
#include <vector>

#include "articulated/try.h"
#include "bindings/c/contact.h"
#include "bindings/c/robot_handle.h"
#include "bindings/c/sized_struct.h"
#include "lss/index.h"

namespace foretouch::c {
namespace {

/// Sixteen million edges of seven joints take two gigabytes.
constexpr std::size_t kMaxEdges = std::size_t{1} << 24;
constexpr std::size_t kMaxProps = 65536;

RigidPose rigidPoseOf(const double* rotation, const double* translation) {
  return {Quaternion(rotation[0], rotation[1], rotation[2], rotation[3]),
          Eigen::Vector3d(translation[0], translation[1], translation[2])};
}

ft_edge_options defaultEdgeOptions() {
  const EdgeOptions defaults;
  ft_edge_options options{};
  options.size = sizeof options;
  options.threads = 1;
  options.tolerance = defaults.tolerance;
  options.clearance = defaults.clearance;
  options.clearance_tolerance = defaults.clearanceTolerance;
  options.clearance_within = defaults.clearanceWithin;
  return options;
}

ft_status readProps(const ft_edge_options& given, EdgeOptions& options) {
  if (const auto s = neededArray(given.props, given.prop_count, kMaxProps, "props"); s != FT_OK) {
    return s;
  }
  for (std::size_t i = 0; i < given.prop_count; ++i) {
    const ft_edge_prop& told = given.props[i];
    if (const auto s = checked(told.scene); s != FT_OK) return s;
    EdgeProp prop{told.scene->scene, std::nullopt, {}};
    if (told.is_absent == 0) prop.X_WP = rigidPoseOf(told.rotation, told.translation);
    const auto s = neededArray(told.ignored, told.ignored_count, kMaxTriangles, "ignored");
    if (s != FT_OK) return s;
    for (std::size_t k = 0; k < told.ignored_count; ++k) {
      prop.ignored.push_back({told.ignored[k].link, told.ignored[k].object});
    }
    options.props.push_back(std::move(prop));
  }
  return FT_OK;
}

ft_status readEdgeOptions(const ft_edge_options& given, EdgeOptions& options) {
  options.tolerance = given.tolerance;
  options.clearance = given.clearance;
  options.clearanceTolerance = given.clearance_tolerance;
  options.clearanceWithin = given.clearance_within;
  if (given.self != nullptr) {
    if (const auto s = checked(given.self); s != FT_OK) return s;
    options.self = given.self->rules;
  }
  const auto s = neededArray(given.ignored, given.ignored_count, kMaxTriangles, "ignored");
  if (s != FT_OK) return s;
  for (std::size_t i = 0; i < given.ignored_count; ++i) {
    options.ignored.push_back({given.ignored[i].link, given.ignored[i].object});
  }
  return readProps(given, options);
}

ft_edge edgeOf(const EdgeAnswer& answer) {
  ft_edge c{};
  c.verdict = static_cast<std::int32_t>(answer.verdict);
  c.reason = static_cast<std::int32_t>(answer.reason);
  c.is_usable = answer.isUsable() ? 1 : 0;
  c.free_until = answer.freeUntil;
  c.breach_at_0 = answer.breachAt0.joint;
  c.breach_at_1 = answer.breachAt1.joint;
  return c;
}

ft_clearance clearanceOf(const EdgeClearance& answer) {
  ft_clearance c{};
  c.link = answer.link;
  c.lss = answer.lss;
  c.triangle = answer.triangle;
  c.prop = answer.prop;
  c.is_alone = answer.isAlone ? 1 : 0;
  c.lower = answer.lower;
  c.upper = answer.upper;
  c.t = answer.t;
  Eigen::Map<Eigen::Vector3d>(c.point_on_link) = answer.p_WLink;
  Eigen::Map<Eigen::Vector3d>(c.point_on_scene) = answer.p_WScene;
  Eigen::Map<Eigen::Vector3d>(c.normal) = answer.nhat_SL_W;
  return c;
}

ft_status checkedCounts(const ft_edges& edges, std::size_t count, std::size_t coordinates) {
  if (const auto s = withinLimit(count, kMaxEdges, "count"); s != FT_OK) return s;
  const std::size_t expected = edges.question.robot().numCoordinates();
  if (coordinates == expected) return FT_OK;
  return failure(FT_ERROR_MISMATCH, kNoIndex,
                 "coordinate_count: expected %zu, as the robot has, found %zu", expected,
                 coordinates);
}

/// An edge of the last list that is not clear.
ft_status checkedMet(const ft_edges* edges, std::size_t index) {
  if (const auto s = checked(edges); s != FT_OK) return s;
  if (!edges->hasAnswers) {
    return failure(FT_ERROR_NO_STEP, kNoIndex, "expected edges to be answered before");
  }
  if (index >= edges->answers.size()) {
    return failure(FT_ERROR_OUT_OF_RANGE, static_cast<std::int64_t>(index),
                   "index: expected less than %zu, found %zu", edges->answers.size(), index);
  }
  if (edges->answers[index].verdict == Verdict::Clear) {
    return failure(FT_ERROR_MISMATCH, static_cast<std::int64_t>(index),
                   "expected an edge that is not clear");
  }
  return FT_OK;
}

}  // namespace
}  // namespace foretouch::c

using namespace foretouch;
using namespace foretouch::c;

ft_status ft_edge_options_init(ft_edge_options* options, size_t size) {
  return initStruct(__func__, options, size, "ft_edge_options", defaultEdgeOptions());
}

ft_status ft_edges_create(const ft_robot* robot, const ft_scene* scene,
                          const ft_edge_options* options, ft_edges** edges) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = cleared(edges); s != FT_OK) return s;
    if (const auto s = checked(robot); s != FT_OK) return s;
    if (const auto s = checked(scene); s != FT_OK) return s;
    ft_edge_options known = defaultEdgeOptions();
    if (options != nullptr) {
      if (const auto s = readStruct(options, "ft_edge_options", known); s != FT_OK) return s;
    }
    EdgeOptions asked;
    if (const auto s = readEdgeOptions(known, asked); s != FT_OK) return s;
    FORETOUCH_TRY_OR(failure, auto pool, WorkerPool::start(known.threads));
    FORETOUCH_TRY_OR(failure, auto question, EdgeQuery::build(robot->robot, scene->scene, asked));
    std::vector<Scene> props;
    for (const EdgeProp& prop : asked.props) props.push_back(prop.scene);
    *edges = new ft_edges{ft_edges::kMark,
                          scene->scene,
                          std::move(props),
                          std::move(question),
                          std::move(pool),
                          {},
                          {},
                          false};
    return FT_OK;
  });
}

ft_status ft_edges_answer(ft_edges* edges, const double* q0, const double* q1, size_t count,
                          size_t coordinate_count, ft_edge* answers) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(edges); s != FT_OK) return s;
    if (const auto s = checkedCounts(*edges, count, coordinate_count); s != FT_OK) return s;
    if (const auto s = neededArray(q0, count, kMaxEdges, "q0"); s != FT_OK) return s;
    if (const auto s = neededArray(q1, count, kMaxEdges, "q1"); s != FT_OK) return s;
    if (const auto s = neededArray(answers, count, kMaxEdges, "answers"); s != FT_OK) return s;
    edges->hasAnswers = false;
    FORETOUCH_CHECK_OR(failure,
                       edges->question.answerAll(q0, q1, count, edges->pool, edges->answers));
    edges->hasAnswers = true;
    if (count == 0) return FT_OK;
    const auto at = [&](std::size_t i) { return edgeOf(edges->answers[i]); };
    return writeStructs("ft_edge", count, at, answers);
  });
}

ft_status ft_edges_clearance(ft_edges* edges, const double* q0, const double* q1, size_t count,
                             size_t coordinate_count, ft_clearance* clearances, double* slopes0,
                             double* slopes1) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(edges); s != FT_OK) return s;
    if (const auto s = checkedCounts(*edges, count, coordinate_count); s != FT_OK) return s;
    if (const auto s = neededArray(q0, count, kMaxEdges, "q0"); s != FT_OK) return s;
    if (const auto s = neededArray(q1, count, kMaxEdges, "q1"); s != FT_OK) return s;
    if (const auto s = neededArray(clearances, count, kMaxEdges, "clearances"); s != FT_OK) {
      return s;
    }
    FORETOUCH_CHECK_OR(failure, edges->question.clearanceAll(q0, q1, count, edges->pool,
                                                             edges->clearances, slopes0, slopes1));
    if (count == 0) return FT_OK;
    const auto at = [&](std::size_t i) { return clearanceOf(edges->clearances[i]); };
    return writeStructs("ft_clearance", count, at, clearances);
  });
}

ft_status ft_edges_answer_path(ft_edges* edges, const double* q, size_t count,
                               size_t coordinate_count, ft_path* path) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(edges); s != FT_OK) return s;
    if (const auto s = checkedCounts(*edges, count, coordinate_count); s != FT_OK) return s;
    if (const auto s = neededArray(q, count, kMaxEdges, "q"); s != FT_OK) return s;
    edges->hasAnswers = false;
    FORETOUCH_TRY_OR(failure, const auto found, edges->question.answerPath(q, count, edges->pool));
    edges->answers.assign(1, found.answer);
    edges->hasAnswers = true;
    ft_path c{};
    c.verdict = static_cast<std::int32_t>(found.answer.verdict);
    c.edge = found.edge;
    c.free_until = found.freeUntil;
    return writeStruct(path, "ft_path", c);
  });
}

ft_status ft_edges_place(ft_edges* edges, size_t prop, const double* rotation,
                         const double* translation) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checked(edges); s != FT_OK) return s;
    std::optional<RigidPose> place;
    if (rotation != nullptr) {
      if (const auto s = neededArray(translation, 3, 3, "translation"); s != FT_OK) return s;
      place = rigidPoseOf(rotation, translation);
    }
    FORETOUCH_CHECK_OR(failure, edges->question.place(prop, place));
    return FT_OK;
  });
}

ft_status ft_edges_contact(const ft_edges* edges, size_t index, ft_contact* contact,
                           ft_other_link* other) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = checkedMet(edges, index); s != FT_OK) return s;
    const EdgeAnswer& answer = edges->answers[index];
    const PairContact& met = answer.contact;
    if (other != nullptr) *other = {met.other, met.otherLss};
    const bool isScene = met.other < 0;
    const LinkContact& link = met;
    const Scene& scene = answer.prop < 0 ? edges->scene : edges->props[slotOf(answer.prop)];
    return writeStruct(contact, "ft_contact",
                       isScene ? contactOf(link, scene) : contactOf(met, scene));
  });
}

ft_status ft_edges_contact_prop(const ft_edges* edges, size_t index, int32_t* prop) {
  return guarded(__func__, [&]() -> ft_status {
    if (const auto s = neededArray(prop, 1, 1, "prop"); s != FT_OK) return s;
    if (const auto s = checkedMet(edges, index); s != FT_OK) return s;
    *prop = edges->answers[index].prop;
    return FT_OK;
  });
}

void ft_edges_destroy(ft_edges* edges) {
  destroy(__func__, edges);
}
