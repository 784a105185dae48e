// bindings/python/near.cpp: foretouch.NearQuery.
#include <array>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "bindings/python/arguments.h"
#include "bindings/python/bindings.h"
#include "bindings/python/poses.h"
#include "bindings/python/query_options.h"
#include "lss/index.h"
#include "middleware/near/near_features.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, NearDetail>, 3> kDetails{
    {{"reduced", NearDetail::Reduced}, {"all", NearDetail::All}, {"nearest", NearDetail::Nearest}}};

/// A column of the features: `of(feature)` is one number, or three in a vector.
template <typename T, typename Of>
py::array_t<T> column(const NearFeatures& near, const Of& of) {
  py::array_t<T> made(static_cast<py::ssize_t>(near.features.size()));
  T* to = made.mutable_data();
  for (const NearFeature& feature : near.features) *to++ = of(feature);
  return made;
}
template <typename Of>
Numbers points(const NearFeatures& near, const Of& of) {
  Numbers made({static_cast<py::ssize_t>(near.features.size()), py::ssize_t{3}});
  double* to = made.mutable_data();
  for (const NearFeature& feature : near.features) {
    const Eigen::Vector3d& p = of(feature);
    to = std::copy(p.data(), p.data() + 3, to);
  }
  return made;
}

py::object toPython(const NearFeatures& near) {
  py::list kinds, more;
  for (const NearFeature& feature : near.features) kinds.append(toString(feature.feature));
  for (std::size_t link = 0; link < near.links.size(); ++link) {
    if (near.links[link].hadMore) more.append(link);
  }
  using F = const NearFeature&;
  return pythonType("NearFeatures")(
      column<std::int32_t>(near, [](F f) { return f.link; }),
      column<std::int32_t>(near, [](F f) { return f.lss; }),
      column<std::int32_t>(near, [](F f) { return f.triangle; }), kinds,
      column<double>(near, [](F f) { return f.along; }),
      column<double>(near, [](F f) { return f.gap; }),
      points(near, [](F f) -> const Eigen::Vector3d& { return f.p_WScene; }),
      points(near, [](F f) -> const Eigen::Vector3d& { return f.p_WLink; }),
      points(near, [](F f) -> const Eigen::Vector3d& { return f.nhat_SL_W; }), more);
}

/// One for all links, or one per link.
std::vector<double> reachFrom(py::handle given, std::size_t links) {
  std::vector<double> all(links);
  if (py::isinstance<py::float_>(given) || py::isinstance<py::int_>(given)) {
    all.assign(links, number(given, "reach"));
  } else {
    const Numbers reach = numbers(given, "reach", {static_cast<py::ssize_t>(links)});
    all.assign(reach.data(), reach.data() + links);
  }
  for (std::size_t i = 0; i < links; ++i) {
    if (all[i] <= kMaxCoordinate) continue;  // NaN is not
    refuse(ErrorCode::OutOfRange, "reach", "expected at most 1e7 metres",
           static_cast<std::int64_t>(i));
  }
  return all;
}

/// Any number of threads may use one at once: they take turns.
class PythonNearQuery {
 public:
  PythonNearQuery(std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
                  const std::vector<IgnoredPair>& ignored)
      : avatar_(std::move(avatar)),
        scene_(std::move(scene)),
        question_(valueOf(NearQuery::build(*avatar_, *scene_, ignored))) {}

  [[nodiscard]] const std::shared_ptr<Avatar>& avatar() const { return avatar_; }
  [[nodiscard]] const std::shared_ptr<Scene>& scene() const { return scene_; }

  [[nodiscard]] NearFeatures answer(const Pose& pose, const std::vector<double>& reach,
                                    NearDetail detail) {
    const py::gil_scoped_release free;
    const std::lock_guard<std::mutex> lock(mutex_);
    NearFeatures near;
    still_.assign(avatar_->skeleton(), pose, pose);
    still_.statesAt(0.0, states_);
    question_.answer(states_, reach, scratch_, near, detail);
    return near;
  }

 private:
  std::shared_ptr<Avatar> avatar_;
  std::shared_ptr<Scene> scene_;
  NearQuery question_;
  std::mutex mutex_;
  Scratch scratch_;
  ChainMotion still_;
  std::vector<LinkState> states_;
};

}  // namespace

void bindNear(py::module_& module) {
  py::class_<PythonNearQuery>(
      module, "NearQuery",
      "What are links of an avatar near to at one pose? Checked once, with\n"
      "memory that it keeps. Any number of threads may ask one.")
      .def(py::init([](std::shared_ptr<Avatar> avatar, std::shared_ptr<Scene> scene,
                       const Shown<shown::Items>& ignore) {
             const auto ignored = ignoredFrom(ignore, *avatar, *scene);
             return std::make_unique<PythonNearQuery>(std::move(avatar), std::move(scene), ignored);
           }),
           py::arg("avatar").none(false), py::arg("scene").none(false), py::kw_only(),
           py::arg("ignore") = py::tuple(),
           "ignore: a list of links and of pairs (link, object), by name or index.")
      .def(
          "answer",
          [](PythonNearQuery& query, const Shown<shown::Pose>& pose,
             const Shown<shown::Instants>& reach, const Shown<shown::Text>& detail) {
            const Pose at = poseFrom(query.avatar()->skeleton(), pose, "pose");
            const auto all = reachFrom(reach, countOf(query.avatar()->numLinks()));
            return toPython(query.answer(at, all, oneOf(detail, "detail", kDetails)));
          },
          py::arg("pose"), py::arg("reach"), py::kw_only(), py::arg("detail") = "reduced",
          "The places within reach (metres: a number, or one per link; below 0: not asked): a\n"
          "NearFeatures. detail: 'reduced', what a solver of contacts needs; 'all', every pair of\n"
          "an LSS and a triangle; 'nearest', the nearest place of each link.")
      .def_property_readonly("avatar", &PythonNearQuery::avatar)
      .def_property_readonly("scene", &PythonNearQuery::scene);
}

}  // namespace foretouch::python
