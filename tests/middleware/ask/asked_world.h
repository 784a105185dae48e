// tests/middleware/ask/asked_world.h: random worlds that questions are asked about, and what the
// judge knows of them.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "tests/middleware/ask/ask_campaign.h"
#include "tests/middleware/mesh_body.h"
#include "tests/middleware/random_scene.h"
#include "tests/middleware/world/random_worlds.h"

namespace foretouch::test {

/// A world of both kinds, and what its bodies are.
class AskedWorld {
 public:
  /// Without skins, if flights are asked about: these are not followed as they bend.
  AskedWorld(Random& random, bool hasSkins)
      : still_(stillScene(random)), both_(still_, WorldOptions{1e-3}) {
    const int walkers = 1 + random.below(3);
    for (int i = 0; i < walkers; ++i) {
      addWalker(random, i == 0 || random.chance(0.3), hasSkins && random.chance(0.4));
    }
    const int meshes = 1 + random.below(2);
    for (int i = 0; i < meshes; ++i) {
      const Scene mesh = clutterOf(random, 1 + random.below(12), 1 + random.below(3));
      const BodyId body = add(mesh, random);
      fly(both_, body, random.inBox(0.8), randomPeriod(random), kWindowUs, random);
    }
    if (random.chance(0.6)) addTool(random);
  }

  BothWorlds& both() { return both_; }
  [[nodiscard]] int numBodies() const { return both_.world.numBodies(); }
  [[nodiscard]] int linksOf(BodyId body) const {
    return static_cast<int>(both_.oracle.bodies[slotOf(body)].parents.size());
  }
  [[nodiscard]] bool isCarried(BodyId body) const { return body == tool_; }
  [[nodiscard]] bool hasSkin(BodyId body) const {
    return body >= 0 && slotOf(body) < skins_.size() && skins_[slotOf(body)];
  }
  [[nodiscard]] const BodyOptions& options(BodyId body) const { return options_[slotOf(body)]; }
  [[nodiscard]] const std::optional<Scene>& still() const { return still_; }
  /// Of the body itself, and of who carries it; nothing if all is known.
  [[nodiscard]] std::optional<AskUnknown> whyUnknown(BodyId body, const WorldTime& time) const;

  /// All parts that are known then, in W.
  [[nodiscard]] std::vector<JudgedPart> partsAt(const WorldQuestion& question) const;
  [[nodiscard]] std::vector<UnknownBody> unknownAt(const WorldQuestion& question) const;

 private:
  /// One more object: an eight-sided star, perhaps with a hollow in it; perhaps a face is missing.
  static void addClosed(RawScene& raw, Random& random, double size);
  static Scene clutterOf(Random& random, int triangles, int objects) {
    RawScene raw = clutter(random, triangles, objects, Eigen::Vector3d::Zero());
    for (Triangle& triangle : raw.triangles) {
      for (Eigen::Vector3d& v : triangle.vertices) v *= 0.15;
    }
    addClosed(raw, random, 0.3);
    return Scene::build(std::move(raw)).value();
  }
  static std::optional<Scene> stillScene(Random& random) {
    if (random.chance(0.2)) return std::nullopt;
    RawScene raw = clutter(random, 5 + random.below(60), 3, Eigen::Vector3d::Zero());
    for (int i = random.below(3); i > 0; --i) addClosed(raw, random, 1.0);
    return Scene::build(std::move(raw)).value();
  }

  BodyOptions optionsOf(Random& random) {
    const WhenSilent silent[] = {WhenSilent::Wait, WhenSilent::HoldStill, WhenSilent::Undecided};
    BodyOptions options;
    options.group = random.below(4);
    options.whenSilent = silent[random.below(3)];
    options_.push_back(options);
    return options;
  }

  BodyId add(const Scene& mesh, Random& random) {
    meshes_.emplace_back(mesh);
    surfaces_.emplace_back();
    avatars_.emplace_back();
    return both_.add(mesh, optionsOf(random));
  }

  void addWalker(Random& random, bool hasSurface, bool hasSkin) {
    Walker walker = randomWalker(random, random.inBox(0.8), random.uniform(0.0, 0.1));
    BodyOptions options = optionsOf(random);
    if (hasSurface) options.surface = randomSurface(walker.avatar, random);
    if (hasSkin) {
      skins_.resize(slotOf(numBodies() + 1));
      skins_.back() = skinOf(walker.avatar, random);
      options.skin =
          SkinnedSurface::build(walker.avatar, skins_.back()->skin, skins_.back()->counts).value();
    }
    meshes_.emplace_back();
    surfaces_.push_back(options.surface);
    avatars_.emplace_back(walker.avatar);
    const BodyId body = both_.add(walker.avatar, options);
    walk(both_, body, walker, randomPeriod(random), kWindowUs, random);
  }

  /// Held fast by a link of the first walker from an instant on; before, in a hand of nobody.
  void addTool(Random& random) {
    const Scene mesh = clutterOf(random, 1 + random.below(6), 1);
    tool_ = add(mesh, random);
    both_.push(tool_, 0, RigidPose{random.rotation(), random.inBox(0.5)});
    both_.push(tool_, 40'000, RigidPose{random.rotation(), random.inBox(0.5)});
    both_.attach(tool_, {0, random.below(linksOf(0)), false}, 40'000,
                 RigidPose{random.rotation(), random.inBox(0.1)});
  }

  /// Some links have no triangles.
  static RandomSkin skinOf(const Avatar& avatar, Random& random);
  /// As the judge's links carry it then.
  void appendSkin(BodyId body, Real us, std::vector<JudgedPart>& all) const;
  void appendParts(BodyId body, const std::vector<oracle::OraclePart>& parts,
                   std::vector<JudgedPart>& all) const;
  [[nodiscard]] const OracleBody& bodyOf(BodyId body) const {
    return both_.oracle.bodies[slotOf(body)];
  }

  std::optional<Scene> still_;
  BothWorlds both_;
  std::vector<BodyOptions> options_;
  std::vector<std::optional<Scene>> meshes_;
  std::vector<std::optional<AvatarSurface>> surfaces_;
  std::vector<std::optional<Avatar>> avatars_;
  std::vector<std::optional<RandomSkin>> skins_;  // of the first bodies
  BodyId tool_ = -1;
};

/// A point on or near some part; anywhere without parts.
[[nodiscard]] Eigen::Vector3d aimed(const std::vector<JudgedPart>& parts, Random& random);
[[nodiscard]] bool isInGroups(const AskWhom& whom, BodyGroup group);

}  // namespace foretouch::test
