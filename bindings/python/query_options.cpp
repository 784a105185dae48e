#include "bindings/python/query_options.h"

#include <array>
#include <cstdio>
#include <limits>

#include "bindings/python/pair_rules.h"
#include "bindings/python/surface.h"
#include "lss/index.h"
#include "middleware/query_options.h"

namespace foretouch::python {
namespace {

constexpr std::array<std::pair<const char*, Fidelity>, 2> kFidelities{
    {{"link", Fidelity::Link}, {"exact", Fidelity::Exact}}};
constexpr std::array<std::pair<const char*, Scope>, 3> kScopes{{{"links", Scope::EveryLink},
                                                                {"avatar", Scope::FirstOfAvatar},
                                                                {"objects", Scope::EveryObject}}};

// ---- ignore ----

/// All objects of this name, or the one of this index.
std::vector<ObjectId> objectsOf(const Scene& scene, py::handle given, const std::string& what) {
  const std::vector<std::string>& names = scene.objectNames();
  if (!PyUnicode_Check(given.ptr())) {
    const auto most = static_cast<std::int64_t>(names.size()) - 1;
    return {static_cast<ObjectId>(integer(given, what, 0, most))};
  }
  const std::string name = text(given, what);
  std::vector<ObjectId> found;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == name) found.push_back(static_cast<ObjectId>(i));
  }
  if (found.empty()) refuseName(what, "object of the scene", name, names);
  return found;
}

/// A link, or a pair of a link and an object.
void addIgnored(const py::object& given, const std::string& what, const Avatar& avatar,
                const Scene& scene, std::vector<IgnoredPair>& ignored) {
  if (!py::isinstance<py::tuple>(given) && !py::isinstance<py::list>(given)) {
    ignored.push_back({linkOf(avatar, given, what)});
    return;
  }
  const std::vector<py::object> pair = items(given, what);
  if (pair.size() != 2) {
    refuse(ErrorCode::Mismatch, what, "expected a link, or a pair of a link and an object");
  }
  const LinkId link = linkOf(avatar, pair[0], what + "[0]");
  for (const ObjectId object : objectsOf(scene, pair[1], what + "[1]")) {
    ignored.push_back({link, object});
  }
}

// ---- policies ----

/// What a policy sets for its link, or for its link with its objects.
void readPolicy(py::handle given, const std::string& what, ObjectPolicy& policy) {
  for (const auto& [key, value] : mapping(given, what)) {
    const std::string name = text(key, what);
    const std::string place = what + "['" + name + "']";
    if (name == "tolerance") {
      policy.tolerance = number(value, place);
      if (*policy.tolerance >= kMinTolerance && *policy.tolerance <= kMaxTolerance) continue;
      refuse(ErrorCode::OutOfRange, place, "expected 1e-9 to 1e7 metres");
    } else if (name == "fidelity") {
      policy.fidelity = fidelityFrom(value, place);
    } else if (name == "ignore") {
      policy.ignore = boolean(value, place);
    } else {
      refuse(ErrorCode::UnknownName, place, "expected 'tolerance', 'fidelity' or 'ignore'");
    }
  }
}

/// A link, or a pair of a link and an object; returns what errors call it.
std::string readKey(py::handle given, const Avatar& avatar, const Scene& scene,
                    ObjectPolicy& policy) {
  if (!py::isinstance<py::tuple>(given)) {
    policy.links = {linkOf(avatar, given, "policies")};
    return "policies['" + avatar.skeleton().name(policy.links[0]) + "']";
  }
  const std::vector<py::object> pair = items(given, "policies");
  if (pair.size() != 2) {
    refuse(ErrorCode::Mismatch, "policies", "expected a link, or a pair of a link and an object");
  }
  policy.links = {linkOf(avatar, pair[0], "policies")};
  policy.objects = objectsOf(scene, pair[1], "policies");
  return "policies['" + avatar.skeleton().name(policy.links[0]) + "', '" +
         scene.objectNames()[slotOf(policy.objects[0])] + "']";
}

/// {link or (link, object): {"tolerance": ..., "fidelity": ..., "ignore": ...}}, later ones over
/// earlier ones; what is left out is as for all links.
void applyPolicies(const py::object& given, const Avatar& avatar, const Scene& scene,
                   QueryOptions& options) {
  if (given.is_none()) return;
  std::vector<ObjectPolicy> policies;
  for (const auto& [key, policy] : mapping(given, "policies")) {
    ObjectPolicy& read = policies.emplace_back();
    const std::string what = readKey(key, avatar, scene, read);
    readPolicy(policy, what, read);
  }
  valueOf(applyObjectPolicies(policies, avatar.numLinks(),
                              static_cast<std::int32_t>(scene.objectNames().size()), options));
}

/// The library takes up to 1e7 m, for scenes of planets. Near a body no caller means more than
/// this: one who gives 1.0 took it for a share, or for millimetres.
constexpr double kCoarseTolerance = 0.1;

double toleranceFrom(py::handle given) {
  const double tolerance = number(given, "tolerance");
  if (tolerance > kCoarseTolerance && tolerance <= kMaxTolerance) {
    std::array<char, 128> words{};
    std::snprintf(words.data(), words.size(),
                  "tolerance=%g is in metres: contacts may be reported that far before they are "
                  "made; 0.001 is usual",
                  tolerance);
    warn(words.data());
  }
  return tolerance;
}

}  // namespace

Fidelity fidelityFrom(py::handle given, const std::string& what) {
  if (PyUnicode_Check(given.ptr())) {
    const std::string why = whyFidelityIsGone(text(given, what));
    if (!why.empty()) refuse(ErrorCode::UnknownName, what, why);
  }
  return oneOf(given, what, kFidelities);
}

/// A surface of another avatar would cause reads out of bounds.
std::optional<AvatarSurface> surfaceFrom(const py::object& given, const Avatar& avatar) {
  if (given.is_none()) return std::nullopt;
  if (!py::isinstance<Surface>(given)) {
    refuse(ErrorCode::Mismatch, "surface", "expected a foretouch.Surface");
  }
  const auto& surface = given.cast<const Surface&>();
  if (surface.avatar->identity() != avatar.identity()) {
    refuse(ErrorCode::Mismatch, "surface", "expected the surface of this avatar");
  }
  return surface.triangles;
}

std::vector<IgnoredPair> ignoredFrom(const py::object& given, const Avatar& avatar,
                                     const Scene& scene) {
  std::vector<IgnoredPair> ignored;
  std::size_t place = 0;
  for (const py::object& one : items(given, "ignore")) {
    addIgnored(one, "ignore[" + std::to_string(place++) + "]", avatar, scene, ignored);
  }
  return ignored;
}

bool boolean(py::handle given, const std::string& what) {
  if (!PyBool_Check(given.ptr())) refuse(ErrorCode::Mismatch, what, "expected a bool");
  return given.ptr() == Py_True;
}

std::optional<foretouch::PairRules> rulesFrom(const py::object& given, const Avatar& avatar) {
  if (given.is_none()) return std::nullopt;
  if (!py::isinstance<PairRules>(given)) {
    refuse(ErrorCode::Mismatch, "self_pairs", "expected a foretouch.PairRules");
  }
  const auto& own = given.cast<const PairRules&>();
  if (own.avatar->identity() != avatar.identity()) {
    refuse(ErrorCode::Mismatch, "self_pairs", "expected the rules of this avatar");
  }
  return own.rules;
}

QueryOptions optionsFrom(const GivenOptions& given, const Avatar& avatar, const Scene& scene) {
  QueryOptions options;
  options.tolerance = toleranceFrom(given.tolerance);
  options.fidelity = fidelityFrom(given.fidelity, "fidelity");
  options.ignored = ignoredFrom(given.ignore, avatar, scene);
  applyPolicies(given.policies, avatar, scene, options);
  options.scope = oneOf(given.scope, "scope", kScopes);
  options.passSeparating = boolean(given.passSeparating, "pass_separating");
  options.surface = surfaceFrom(given.surface, avatar);
  if (!given.workBudget.is_none()) {
    options.workBudget = static_cast<std::uint64_t>(
        integer(given.workBudget, "work_budget", 0, std::numeric_limits<std::int64_t>::max()));
  }
  options.self = rulesFrom(given.selfPairs, avatar);
  if (!given.deadlineUs.is_none()) options.deadlineUs = number(given.deadlineUs, "deadline_us");
  return options;
}

}  // namespace foretouch::python
