#include "tests/bindings/moving_world.h"

#include <utility>

#include "lss/index.h"
#include "tests/bindings/same_answers.h"

namespace foretouch::test {
namespace {

Pose poseOf(const RigidPose& rigid) {
  return {{rigid.rotation}, {rigid.translation}};
}

ft_carrier carrierOf(const Carrier& carrier) {
  ft_carrier c{};
  c.size = sizeof c;
  c.body = carrier.body;
  c.link = carrier.link;
  c.moves_in_frame = carrier.movesInFrame ? 1 : 0;
  return c;
}

ft_body_options optionsOf(const BodyOptions& options) {
  ft_body_options c = initialised(ft_body_options_init);
  c.group = options.group;
  c.when_silent = static_cast<std::int32_t>(options.whenSilent);
  c.fidelity = options.surface ? FT_FIDELITY_EXACT : FT_FIDELITY_LINK;
  return c;
}

/// Per link; none without a surface.
std::vector<std::vector<Triangle>> trianglesOf(const BodyOptions& options) {
  std::vector<std::vector<Triangle>> triangles;
  if (!options.surface) return triangles;
  for (LinkId link = 0; link < options.surface->numLinks(); ++link) {
    triangles.push_back(options.surface->triangles(link));
  }
  return triangles;
}

void expectSameSide(const ft_world_side& c, const ContactSide& cxx, std::int32_t object) {
  EXPECT_EQ(c.body, cxx.body);
  EXPECT_EQ(c.link, cxx.link);
  EXPECT_EQ(c.lss, cxx.lss);
  EXPECT_EQ(c.triangle, cxx.triangle);
  EXPECT_EQ(c.object, object);
  EXPECT_EQ(c.reserved, 0);
  expectSameVector(c.point, cxx.p_W);
}

}  // namespace

WorldHandle makeWorld(const SceneHandle& still, const ft_world_options* options) {
  ft_world* world = nullptr;
  EXPECT_EQ(ft_world_create(still.get(), options, &world), FT_OK) << ft_last_error();
  return WorldHandle(world);
}

std::vector<ft_world_contact> contactsOf(const ft_world* world) {
  std::size_t count = 0;
  EXPECT_EQ(ft_world_contacts(world, nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_world_contact> contacts(count + 1);
  contacts[0].size = sizeof(ft_world_contact);
  EXPECT_EQ(ft_world_contacts(world, contacts.data(), count, nullptr), FT_OK);
  if (count > 0) {
    EXPECT_EQ(contacts.back().size, 0u) << "written past the end";
  }
  contacts.pop_back();
  return contacts;
}

std::vector<ft_silent_body> silentOf(const ft_world* world) {
  std::size_t count = 0;
  EXPECT_EQ(ft_world_silent(world, nullptr, 0, &count), FT_OK) << ft_last_error();
  std::vector<ft_silent_body> silent(count + 1);
  silent[0].size = sizeof(ft_silent_body);
  EXPECT_EQ(ft_world_silent(world, silent.data(), count, nullptr), FT_OK);
  silent.pop_back();
  return silent;
}

MovingWorld::MovingWorld(double tolerance, const RawScene* still, bool asksMeshes,
                         const WorldOptions& work)
    : cxx([&] {
        std::optional<Scene> scene;
        if (still != nullptr) scene = Scene::build(*still).value();
        WorldOptions options = work;
        options.tolerance = tolerance;
        options.askMeshes = asksMeshes;
        return World::build(scene, options).value();
      }()) {
  ft_world_options options = initialised(ft_world_options_init);
  if (work.workPerPair != WorldOptions().workPerPair) options.work_per_pair = work.workPerPair;
  if (work.workPerWindow != WorldOptions().workPerWindow) {
    options.work_per_window = work.workPerWindow;
  }
  options.tolerance = tolerance;
  options.asks_meshes = asksMeshes ? 1 : 0;
  if (still != nullptr) still_ = Scene::build(*still).value();
  c = makeWorld(still == nullptr ? nullptr : makeScene(*still), &options);
}

BodyId MovingWorld::add(const Avatar& avatar, BodyOptions options, bool asksSelf) {
  const AvatarHandle handle = makeAvatar(avatar, trianglesOf(options));
  ft_body_options ofC = optionsOf(options);
  RulesHandle rules;
  // Where no pair is left to ask, there are no rules.
  if (const auto derived = PairRules::derive(avatar); asksSelf && derived.ok()) {
    options.self = derived.value();
    ft_pair_rules* made = nullptr;
    EXPECT_EQ(ft_pair_rules_create(handle.get(), nullptr, &made), FT_OK) << ft_last_error();
    rules.reset(made);
    ofC.self = made;
  }
  std::int32_t body = -7;
  EXPECT_EQ(ft_world_add_avatar(c.get(), handle.get(), &ofC, &body), FT_OK) << ft_last_error();
  const BodyId added = cxx.add(avatar, options).value();
  EXPECT_EQ(body, added);
  meshes_.emplace_back();
  return added;
}

BodyId MovingWorld::add(const RawScene& mesh, const BodyOptions& options) {
  const SceneHandle handle = makeScene(mesh);
  const ft_body_options ofC = optionsOf(options);
  std::int32_t body = -7;
  EXPECT_EQ(ft_world_add_mesh(c.get(), handle.get(), &ofC, &body), FT_OK) << ft_last_error();
  meshes_.emplace_back(Scene::build(mesh).value());
  const BodyId added = cxx.add(*meshes_.back(), options).value();
  EXPECT_EQ(body, added);
  return added;
}

void MovingWorld::push(BodyId body, std::int64_t utimeUs, const Pose& pose) {
  const PoseArrays arrays(pose);
  const ft_pose view = arrays.view();
  EXPECT_EQ(ft_world_push(c.get(), body, utimeUs, &view), FT_OK) << ft_last_error();
  EXPECT_TRUE(cxx.push(body, utimeUs, pose).ok());
}

void MovingWorld::push(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  push(body, utimeUs, poseOf(pose));
}

void MovingWorld::attach(BodyId body, const Carrier& carrier, std::int64_t utimeUs,
                         const RigidPose& pose) {
  const PoseArrays arrays(poseOf(pose));
  const ft_pose view = arrays.view();
  const ft_carrier by = carrierOf(carrier);
  EXPECT_EQ(ft_world_attach(c.get(), body, &by, utimeUs, &view), FT_OK) << ft_last_error();
  EXPECT_TRUE(cxx.attach(body, carrier, utimeUs, pose).ok());
}

void MovingWorld::detach(BodyId body, std::int64_t utimeUs, const RigidPose& pose) {
  const PoseArrays arrays(poseOf(pose));
  const ft_pose view = arrays.view();
  EXPECT_EQ(ft_world_detach(c.get(), body, utimeUs, &view), FT_OK) << ft_last_error();
  EXPECT_TRUE(cxx.detach(body, utimeUs, pose).ok());
}

void MovingWorld::ask(BodyGroup a, BodyGroup b, bool isAsked) {
  EXPECT_EQ(ft_world_ask(c.get(), a, b, isAsked ? 1 : 0), FT_OK) << ft_last_error();
  EXPECT_TRUE(cxx.ask(a, b, isAsked).ok());
}

void MovingWorld::askStill(BodyGroup group, bool isAsked) {
  EXPECT_EQ(ft_world_ask_still(c.get(), group, isAsked ? 1 : 0), FT_OK) << ft_last_error();
  EXPECT_TRUE(cxx.askStill(group, isAsked).ok());
}

void MovingWorld::forgetBefore(std::int64_t utimeUs) {
  EXPECT_EQ(ft_world_forget_before(c.get(), utimeUs), FT_OK) << ft_last_error();
  cxx.forgetBefore(utimeUs);
}

void MovingWorld::answer(std::int64_t fromUs, std::int64_t toUs) {
  std::int64_t known = 0;
  std::int32_t waitsFor = -7;
  ASSERT_EQ(ft_world_known_until(c.get(), &known, &waitsFor), FT_OK) << ft_last_error();
  EXPECT_EQ(known, cxx.knownUntilUs());
  EXPECT_EQ(waitsFor, cxx.waitsFor().value_or(-1));
  ASSERT_EQ(ft_world_answer(c.get(), fromUs, toUs), FT_OK) << ft_last_error();
  ASSERT_TRUE(cxx.contacts(fromUs, toUs, scratch_, answerOfCxx).ok());
  expectSameContacts();
  expectSameSilent();
  expectSameCounters();
}

std::int32_t MovingWorld::objectOf(const ContactSide& side) const {
  if (side.triangle < 0) return -1;
  const std::optional<Scene>& mesh = side.body == kStillScene ? still_ : meshes_[slotOf(side.body)];
  return mesh ? mesh->object(side.triangle) : -1;
}

void MovingWorld::expectSameContacts() const {
  const std::vector<ft_world_contact> ofC = contactsOf(c.get());
  ASSERT_EQ(ofC.size(), answerOfCxx.contacts.size());
  for (std::size_t i = 0; i < ofC.size(); ++i) {
    const ft_world_contact& one = ofC[i];
    const WorldContact& other = answerOfCxx.contacts[i];
    EXPECT_EQ(one.size, sizeof one);
    EXPECT_EQ(one.verdict, static_cast<int>(other.verdict));
    EXPECT_EQ(one.reason, static_cast<int>(other.reason));
    EXPECT_EQ(one.is_assumed, other.isAssumed ? 1 : 0);
    EXPECT_EQ(one.time_us, other.time.us);
    EXPECT_EQ(one.time_fraction, other.time.fraction);
    EXPECT_EQ(one.separation, other.separation);
    expectSameDepth(one.penetration, other.verdict == Verdict::StartsInContact, other.penetration);
    expectSameVector(one.normal, other.nhat_BA_W);
    expectSameSide(one.a, other.a, objectOf(other.a));
    expectSameSide(one.b, other.b, objectOf(other.b));
  }
}

void MovingWorld::expectSameSilent() const {
  const std::vector<ft_silent_body> ofC = silentOf(c.get());
  ASSERT_EQ(ofC.size(), answerOfCxx.silent.size());
  for (std::size_t i = 0; i < ofC.size(); ++i) {
    EXPECT_EQ(ofC[i].body, answerOfCxx.silent[i].body);
    EXPECT_EQ(ofC[i].since_us, answerOfCxx.silent[i].sinceUs);
    EXPECT_EQ(ofC[i].taken_to, static_cast<int>(answerOfCxx.silent[i].takenTo));
  }
}

void MovingWorld::expectSameCounters() const {
  ft_world_counters counters{};
  counters.size = sizeof counters;
  ASSERT_EQ(ft_world_get_counters(c.get(), &counters), FT_OK) << ft_last_error();
  const WorldCounters& cxxs = answerOfCxx.counters;
  EXPECT_EQ(counters.bodies, cxxs.bodies);
  EXPECT_EQ(counters.pairs, cxxs.pairs);
  EXPECT_EQ(counters.near_pairs, cxxs.nearPairs);
  EXPECT_EQ(counters.spans, cxxs.spans);
  EXPECT_EQ(counters.nodes, cxxs.queries.nodes);
  EXPECT_EQ(counters.leaves, cxxs.queries.leaves);
  EXPECT_EQ(counters.candidates, cxxs.queries.candidates);
  EXPECT_EQ(counters.cluster_steps, cxxs.queries.clusterSteps);
  EXPECT_EQ(counters.lane_steps, cxxs.queries.laneSteps);
  EXPECT_EQ(counters.part_steps, cxxs.queries.partSteps);
  EXPECT_EQ(counters.advancements, cxxs.queries.advancements);
  EXPECT_EQ(counters.hierarchy_tests, cxxs.queries.hierarchyTests);
  EXPECT_EQ(counters.plane_tests, cxxs.queries.planeTests);
  EXPECT_EQ(counters.leaf_tests, cxxs.queries.leafTests);
  EXPECT_EQ(counters.states, cxxs.queries.states);
  EXPECT_EQ(counters.rung_tests, cxxs.queries.rungTests);
}

RawScene doorScene() {
  using Eigen::Vector3d;
  RawScene raw;
  raw.objectNames = {"lower", "upper"};
  raw.triangles = {{{Vector3d(0, 0, 0), Vector3d(0.9, 0, 0), Vector3d(0.9, 2, 0)}},
                   {{Vector3d(0, 0, 0), Vector3d(0.9, 2, 0), Vector3d(0, 2, 0)}}};
  raw.objectOf = {0, 1};
  return raw;
}

RigidPose doorPose(double angle, const Eigen::Vector3d& place) {
  return {Quaternion(Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY())), place};
}

}  // namespace foretouch::test
