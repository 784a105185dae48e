#include "articulated/avatar.h"

#include <algorithm>
#include <atomic>
#include <optional>
#include <string>
#include <utility>

#include "articulated/quoted.h"
#include "lss/index.h"
#include "lss/rounding.h"

namespace foretouch {
namespace {

std::optional<Error> lssProblem(const Lss& lss) {
  Error error;
  if (!isValid(lss)) {
    error.code = ErrorCode::NonFinite;
    error.message = "is not finite or has a negative radius";
    return error;
  }
  const double largest = std::max(lss.a.cwiseAbs().maxCoeff(), lss.b.cwiseAbs().maxCoeff());
  if (std::max(largest, lss.radius) > kMaxCoordinate) {
    error.code = ErrorCode::OutOfRange;
    error.message = "has a coordinate or radius beyond 1e7 m; is the unit right?";
    return error;
  }
  return std::nullopt;
}

std::optional<Error> meshProblem(const MeshReference& mesh) {
  const auto isText = [](const std::string& text) { return text.empty() || !nameProblem(text); };
  if (mesh.file.empty() && !mesh.node.empty()) {
    return Error::of(ErrorCode::Empty, "names a mesh node but no mesh file");
  }
  if (isText(mesh.file) && isText(mesh.node)) return std::nullopt;
  return Error::of(ErrorCode::Syntax, "has a mesh file or node that is not at most " +
                                          std::to_string(kMaxNameBytes) +
                                          " bytes of UTF-8 without control characters");
}

std::optional<Error> linkProblem(const std::vector<Lss>& lss, const MeshReference* mesh) {
  if (lss.size() > kMaxLssPerLink) {
    return Error::of(ErrorCode::LimitExceeded, "has " + std::to_string(lss.size()) +
                                                   " LSS; expected at most " +
                                                   std::to_string(kMaxLssPerLink));
  }
  for (std::size_t i = 0; i < lss.size(); ++i) {
    if (auto problem = lssProblem(lss[i])) {
      problem->message = "has LSS " + std::to_string(i) + ", which " + problem->message;
      return problem;
    }
  }
  return mesh == nullptr ? std::nullopt : meshProblem(*mesh);
}

}  // namespace

Result<Avatar> Avatar::build(Skeleton skeleton, std::vector<std::vector<Lss>> lssPerLink,
                             std::vector<MeshReference> meshes) {
  const auto n = countOf(skeleton.numJoints());
  if (n == 0) return Error::of(ErrorCode::Empty, "expected at least one joint");
  if (lssPerLink.size() != n || (!meshes.empty() && meshes.size() != n)) {
    return Error::of(ErrorCode::Mismatch,
                     "an avatar has LSS lists for " + std::to_string(lssPerLink.size()) +
                         " links and meshes for " + std::to_string(meshes.size()) + "; expected " +
                         std::to_string(n) + " (or no meshes)");
  }
  bool any = false;
  for (std::size_t i = 0; i < n; ++i) {
    if (auto problem = linkProblem(lssPerLink[i], meshes.empty() ? nullptr : &meshes[i])) {
      problem->index = static_cast<std::int64_t>(i);
      problem->message = "link " + std::to_string(i) + " " +
                         inQuotes(skeleton.name(static_cast<JointId>(i))) + " " + problem->message;
      return *std::move(problem);
    }
    any = any || !lssPerLink[i].empty();
  }
  if (!any) return Error::of(ErrorCode::Empty, "expected an LSS on at least one link");
  static std::atomic<std::uint64_t> identities{0};
  Avatar avatar(std::move(skeleton));
  avatar.identity_ = ++identities;
  avatar.lss_ = std::move(lssPerLink);
  meshes.resize(n);
  avatar.meshes_ = std::move(meshes);
  return avatar;
}

std::int32_t Avatar::numLss() const {
  std::size_t count = 0;
  for (const auto& lss : lss_) count += lss.size();
  return static_cast<std::int32_t>(count);
}

Result<Avatar> Avatar::grownBy(double growth) const {
  std::vector<std::vector<Lss>> grown = lss_;
  for (std::vector<Lss>& ofLink : grown) {
    for (Lss& lss : ofLink) lss.radius = (lss.radius + growth) * internal::kInflation;
  }
  return build(skeleton_, std::move(grown));
}

}  // namespace foretouch
