// Calls with arguments drawn from what callers get wrong (random_caller.h). Whatever comes, the
// answer is a status of the list, and a handle where and only where it is FT_OK.
#include <array>
#include <foretouch/ask.h>
#include <foretouch/events.h>
#include <foretouch/mechanics.h>
#include <foretouch/solid_world.h>
#include <foretouch/triggers.h>
#include <limits>
#include <string>

#include "tests/bindings/moving_world.h"
#include "tests/bindings/random_caller.h"
#include "tests/bindings/solid_world.h"

namespace foretouch {
namespace {

class Caller : public test::RandomCaller {
 public:
  explicit Caller(std::uint64_t seed) : RandomCaller(seed) {}

  void callSomething(test::SmallWorld& world, ft_query* query) {
    switch (random_.below(12)) {
      case 0: makeScene(); break;
      case 1: makeAvatar(); break;
      case 2: makeQuery(world); break;
      case 3: step(query); break;
      case 4: readAnswers(query); break;
      case 5: askAvatar(world); break;
      case 6: convert(); break;
      case 7: askScene(world); break;
      case 8: makeRules(world, query); break;
      case 9: playSolid(world); break;
      case 10: playWorld(world); break;
      default: setOptions(query); break;
    }
  }

 private:
  void makeScene() {
    fillNumbers();
    std::array<std::uint32_t, 3 * kRoom> corners{};
    for (auto& corner : corners) corner = static_cast<std::uint32_t>(random_.below(4));
    ft_scene_arrays arrays{};
    arrays.size = sizeOr(sizeof arrays);
    arrays.positions = maybe(numbers_.data());
    arrays.vertex_count = random_.chance(0.7) ? 4 : std::min(count(), kRoom);
    arrays.indices = maybe(corners.data());
    arrays.triangle_count = count();
    arrays.objects = maybe(indices_.data());
    arrays.object_names = maybe(names_.data());
    arrays.object_count = count();
    if (arrays.indices == nullptr) arrays.vertex_count = 3 * arrays.triangle_count;
    ft_scene* scene = nullptr;
    takeHandle(ft_scene_create(maybe(&arrays), &scene), scene, ft_scene_destroy);
  }

  void makeAvatar() {
    fillNumbers();
    std::array<ft_lss, kRoom> lss{};
    for (ft_lss& l : lss) l = {{0, 0, 0}, {number(), 0, 0}, number()};
    std::array<ft_triangle, kRoom> triangles{};
    ft_avatar_arrays arrays{};
    arrays.size = sizeOr(sizeof arrays);
    arrays.joint_count = count();
    arrays.names = maybe(names_.data());
    std::array<std::int32_t, kRoom> parents = {-1, random_.chance(0.8) ? 0 : index(), index(),
                                               index()};
    arrays.parents = maybe(parents.data());
    arrays.offsets = maybe(numbers_.data());
    arrays.rotations = maybe(numbers_.data());
    arrays.lss = maybe(lss.data());
    arrays.lss_links = maybe(indices_.data());
    arrays.lss_count = count();
    arrays.triangles = random_.chance(0.8) ? nullptr : triangles.data();
    arrays.triangle_links = maybe(indices_.data());
    arrays.triangle_count = arrays.triangles == nullptr ? 0 : count();
    ft_avatar* avatar = nullptr;
    takeHandle(ft_avatar_create(maybe(&arrays), &avatar), avatar, ft_avatar_destroy);
  }

  ft_query_options options() {
    ft_query_options made = test::initialised(ft_query_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.3)) made.fidelity = index();
    if (random_.chance(0.3)) made.tolerance = number();
    if (random_.chance(0.3)) made.work_budget = static_cast<std::uint64_t>(random_.below(1000));
    if (random_.chance(0.3)) made.deadline_us = number();
    if (random_.chance(0.3)) made.scope = index();
    if (random_.chance(0.3)) made.pass_separating = index();
    for (ft_ignored_pair& pair : ignored_) pair = {index(), index()};
    for (ft_link_policy& policy : policies_) policy = {number(), index(), 0};
    if (random_.chance(0.3)) made.ignored = maybe(ignored_.data()), made.ignored_count = count();
    if (random_.chance(0.3)) made.policies = maybe(policies_.data()), made.policy_count = count();
    for (ft_object_policy& policy : objectPolicies_) {
      policy = {index(), index(), random_.chance(0.5) ? 0.0 : number(), index(), index()};
    }
    if (random_.chance(0.3)) {
      made.object_policies = maybe(objectPolicies_.data());
      made.object_policy_count = count();
    }
    return made;
  }
  void makeQuery(test::SmallWorld& world) {
    const ft_query_options made = options();
    const ft_scene* scene = maybe(world.scene.get());
    if (random_.chance(0.1)) scene = reinterpret_cast<const ft_scene*>(world.avatar.get());
    ft_query* query = nullptr;
    takeHandle(ft_query_create(scene, maybe(world.avatar.get()), maybe(&made), &query), query,
               ft_query_destroy);
  }
  void setOptions(ft_query* query) {
    const ft_query_options made = options();
    take(ft_query_set_options(maybe(query), maybe(&made)));
  }

  void makeRules(test::SmallWorld& world, ft_query* query) {
    fillNumbers();
    ft_pair_rule_options options = test::initialised(ft_pair_rule_options_init);
    options.size = sizeOr(sizeof options);
    if (random_.chance(0.3)) options.use_pair_radii = index();
    if (random_.chance(0.3)) options.rest_skin = number();
    if (random_.chance(0.3)) options.always_share = number();
    if (random_.chance(0.3)) options.usual_rotations = maybe(numbers_.data());
    if (random_.chance(0.3)) options.usual_translations = maybe(numbers_.data());
    if (random_.chance(0.3)) options.usual_count = count();
    std::array<ft_link_pair, kRoom> pairs{};
    std::array<ft_left_out_pair, kRoom> leftOut{};
    std::array<ft_pair_radius, kRoom> radii{};
    for (ft_link_pair& pair : pairs) pair = {index(), index()};
    for (ft_left_out_pair& pair : leftOut) pair = {index(), index(), index()};
    for (ft_pair_radius& own : radii) own = {index(), index(), index(), index(), number()};
    if (random_.chance(0.3)) options.left_out = maybe(pairs.data());
    if (random_.chance(0.3)) options.left_out_count = count();
    const ft_avatar* avatar = maybe(world.avatar.get());
    if (random_.chance(0.1)) avatar = reinterpret_cast<const ft_avatar*>(world.scene.get());
    ft_pair_rules* rules = nullptr;
    takeHandle(ft_pair_rules_create(avatar, maybe(&options), &rules), rules, ft_pair_rules_destroy);
    takeHandle(ft_pair_rules_create_exactly(avatar, maybe(leftOut.data()), count(),
                                            maybe(radii.data()), count(), &rules),
               rules, ft_pair_rules_destroy);
    takeHandle(ft_pair_rules_create_from_file(maybe("/absent"), avatar, &rules), rules,
               ft_pair_rules_destroy);
    const auto* wrong = reinterpret_cast<const ft_pair_rules*>(world.avatar.get());
    take(ft_query_set_pair_rules(maybe(query), random_.chance(0.5) ? nullptr : wrong));
    take(ft_pair_rules_get_info(maybe(wrong), nullptr));
    std::array<ft_contact, 2> contacts{};
    contacts[0].size = sizeOr(sizeof(ft_contact));
    std::array<ft_other_link, 2> others{};
    std::size_t required = 0;
    take(ft_query_pairs(maybe(query), maybe(contacts.data()), maybe(others.data()),
                        static_cast<std::size_t>(random_.below(3)), maybe(&required)));
  }

  ft_pose pose() {
    ft_pose made{};
    made.size = sizeOr(sizeof made);
    made.joint_count = random_.chance(0.9) ? 1u : static_cast<std::uint32_t>(index());
    made.rotations = maybe(numbers_.data());
    made.translations = maybe(numbers_.data() + 4);
    return made;
  }
  void step(ft_query* query) {
    fillNumbers();
    const ft_pose from = pose(), to = pose();
    take(ft_query_step(maybe(query), random_.chance(0.3) ? nullptr : &from, maybe(&to)));
  }

  ft_solid_options solidOptions() {
    ft_solid_options made = test::initialised(ft_solid_options_init);
    made.size = sizeOr(sizeof made);
    made.placing_reach = 0.2;  // the places to look at are soon listed
    for (double* option : {&made.skin, &made.tolerance, &made.catch_up, &made.up[1],
                           &made.most_lift, &made.patience, &made.placing_reach}) {
      if (random_.chance(0.05)) *option = number();
    }
    if (random_.chance(0.1)) made.floor = index();
    if (random_.chance(0.1)) made.may_snap = index();
    if (random_.chance(0.1)) made.around_per_tick = index();
    if (random_.chance(0.1)) made.visibility = maybe(numbers_.data());
    if (random_.chance(0.1)) made.visibility_count = count();
    if (random_.chance(0.1)) made.ignored = maybe(ignored_.data());
    if (random_.chance(0.1)) made.ignored_count = count();
    made.work_budget = static_cast<std::uint64_t>(random_.below(1000));  // a tick is soon over
    return made;
  }
  void playSolid(test::SmallWorld& world) {
    fillNumbers();
    for (ft_ignored_pair& pair : ignored_) pair = {index(), index()};
    const ft_solid_options made = solidOptions();
    const ft_avatar* avatar = maybe(world.avatar.get());
    if (random_.chance(0.1)) avatar = reinterpret_cast<const ft_avatar*>(world.scene.get());
    ft_solid* solid = nullptr;
    const ft_status status =
        ft_solid_create(maybe(world.scene.get()), avatar, maybe(&made), &solid);
    take(status);
    ASSERT_EQ(solid != nullptr, status == FT_OK);
    if (solid == nullptr) return;
    const test::SolidHandle owner(solid);
    for (int i = 0; i < 4; ++i) tickSolid(world, solid);
  }
  void tickSolid(test::SmallWorld& world, ft_solid* solid) {
    fillNumbers();
    const ft_pose given = pose(), good = random_.chance(0.5) ? world.up() : world.lowered();
    const std::uint8_t flags[1] = {static_cast<std::uint8_t>(random_.below(3))};
    ft_solid_tick tick{};
    tick.size = sizeOr(sizeof tick);
    take(ft_solid_follow(maybe(solid), random_.chance(0.6) ? &good : maybe(&given), maybe(flags),
                         random_.chance(0.7) ? 0.01 : number(), maybe(&tick)));
    ft_solid_joint joint{};
    joint.size = sizeOr(sizeof joint);
    std::array<ft_solid_contact, kRoom> contacts{};
    contacts[0].size = sizeOr(sizeof(ft_solid_contact));
    std::size_t required = 0;
    const auto capacity = static_cast<std::size_t>(random_.below(2));
    take(ft_solid_joints(solid, maybe(&joint), capacity, maybe(&required)));
    take(ft_solid_contacts(solid, maybe(contacts.data()), kRoom, maybe(&required)));
    take(ft_solid_shown(solid, maybe(numbers_.data()), maybe(numbers_.data() + 4), capacity,
                        maybe(&required)));
    take(ft_solid_way(solid, static_cast<std::size_t>(index()), nullptr, maybe(numbers_.data()),
                      nullptr, capacity, nullptr));
    if (random_.chance(0.1)) take(ft_solid_reset(maybe(solid)));
    if (random_.chance(0.1)) take(ft_solid_reset_at(solid, random_.chance(0.5) ? &good : &given));
    if (random_.chance(0.1)) take(ft_solid_change_scene(solid, maybe(world.scene.get())));
  }

  std::int64_t instant() {
    constexpr std::array<std::int64_t, 4> kInstants = {std::numeric_limits<std::int64_t>::min(),
                                                       std::numeric_limits<std::int64_t>::max(), -1,
                                                       std::int64_t{1} << 53};
    if (random_.chance(0.1)) return kInstants[static_cast<std::size_t>(random_.below(4))];
    return 100 * ++now_;
  }
  /// The calls of a solid world, of one that may be none.
  void tickWorld(test::SmallWorld& small, ft_world* world) {
    const ft_pose good = small.up(), given = pose();
    const ft_solid_options made = solidOptions();
    std::int32_t body = 0, isAssumed = 0;
    take(ft_solid_world_add(maybe(world), maybe(small.avatar.get()), maybe(&made), nullptr, &body));
    const ft_solid_target target{random_.chance(0.6) ? 0 : index(), random_.chance(0.9) ? 0 : 1,
                                 random_.chance(0.6) ? &good : maybe(&given), nullptr};
    take(ft_solid_world_tick(maybe(world), instant(), maybe(&target), 1));
    std::int64_t at = 0;
    take(ft_solid_world_at(maybe(world), maybe(&at)));
    ft_solid_tick tick{};
    tick.size = sizeOr(sizeof tick);
    std::size_t required = 0;
    take(ft_solid_world_get_tick(world, index(), maybe(&tick), maybe(&isAssumed)));
    take(ft_solid_world_shown(maybe(world), index(), nullptr, nullptr, 0, maybe(&required)));
    take(ft_solid_world_joints(world, index(), nullptr, 0, maybe(&required)));
    take(ft_solid_world_contacts(world, index(), nullptr, 0, maybe(&required)));
    take(ft_solid_world_way(world, index(), static_cast<std::size_t>(index()), nullptr, nullptr,
                            nullptr, 0, maybe(&required)));
    take(ft_solid_world_body_contacts(world, index(), nullptr, 0, maybe(&required)));
    take(ft_solid_world_crushes(world, index(), nullptr, 0, maybe(&required)));
    take(ft_solid_world_held(world, index(), nullptr, 0, maybe(&required)));
  }
  void playWorld(test::SmallWorld& small) {
    ft_world_options made = test::initialised(ft_world_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.1)) made.tolerance = number();
    const ft_scene* still = maybe(small.scene.get());
    if (random_.chance(0.1)) still = reinterpret_cast<const ft_scene*>(small.avatar.get());
    ft_world* world = nullptr;
    const bool isSolid = random_.chance(0.5);
    const ft_status status =
        isSolid ? ft_solid_world_create(still, 0, random_.chance(0.9) ? 0 : index(), maybe(&made),
                                        &world)
                : ft_world_create(still, maybe(&made), &world);
    take(status);
    ASSERT_EQ(world != nullptr, status == FT_OK);
    if (world == nullptr) return;
    const test::WorldHandle owner(world);
    for (int i = 0; i < 3; ++i) addBody(small, world);
    if (random_.chance(0.5)) addTriggers(small, world);
    for (int i = 0; isSolid && i < 3; ++i) tickWorld(small, world);
    for (int i = 0; i < 12; ++i) tellWorld(small, world);
    if (random_.chance(0.2)) tickWorld(small, world);
    for (int i = 0; i < 3; ++i) follow(world, i == 0 || random_.chance(0.2));
    askWorld(world);
    collide();
  }
  void addTriggers(test::SmallWorld& small, ft_world* world) {
    ft_trigger_options made = test::initialised(ft_trigger_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.2)) made.group = index();
    if (random_.chance(0.2)) made.when_silent = random_.below(4);
    made.by_link = random_.below(3);
    std::int32_t trigger = 0, body = -1;
    fillNumbers();
    switch (random_.below(3)) {
      case 0:
        take(ft_world_add_trigger_box(maybe(world), maybe(numbers_.data()), maybe(&made),
                                      maybe(&trigger), maybe(&body)));
        break;
      case 1:
        take(ft_world_add_trigger_sphere(maybe(world), number(), maybe(&made), maybe(&trigger),
                                         maybe(&body)));
        break;
      default:
        take(ft_world_add_trigger_mesh(maybe(world), maybe(small.scene.get()), maybe(&made),
                                       maybe(&trigger), maybe(&body)));
    }
    const ft_pose given = pose();
    take(ft_world_stand_trigger(maybe(world), random_.chance(0.8) ? 0 : index(), instant(),
                                maybe(&given)));
    take(ft_world_watch(maybe(world), random_.chance(0.8) ? 0 : index(), index(), index()));
  }
  void follow(ft_world* world, bool begins) {
    ft_follow_options made = test::initialised(ft_follow_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.2)) made.threads = random_.below(4);
    if (random_.chance(0.2)) made.cut_us = instant();
    if (begins) {
      const std::int64_t from = random_.chance(0.5) ? instant() : 100 * now_;
      take(ft_world_follow_from(maybe(world), from, maybe(&made)));
    }
    fillNumbers();
    const std::int32_t body = random_.chance(0.8) ? random_.below(3) : index();
    take(ft_world_weigh(world, body, number(), maybe(numbers_.data()), maybe(numbers_.data() + 4)));
    take(ft_world_weigh_avatar(world, body, number()));
    std::int64_t known = instant();
    if (random_.chance(0.8)) take(ft_world_known_until(world, &known, nullptr));
    take(ft_world_follow(maybe(world), known));
    std::array<ft_event, kRoom> events{};
    events[0].size = sizeOr(sizeof(ft_event));
    std::array<ft_part, kRoom> parts{};
    parts[0].size = sizeOr(sizeof(ft_part));
    std::array<ft_trigger_event, kRoom> told{};
    told[0].size = sizeOr(sizeof(ft_trigger_event));
    std::array<ft_occupant, kRoom> inside{};
    inside[0].size = sizeOr(sizeof(ft_occupant));
    std::size_t required = 0;
    take(ft_world_followed(maybe(world), maybe(&known), maybe(&known)));
    take(ft_world_events(world, maybe(events.data()), kRoom, maybe(&required)));
    take(ft_world_parts(world, maybe(parts.data()), kRoom, maybe(&required)));
    take(ft_world_open_parts(world, maybe(parts.data()), kRoom, maybe(&required)));
    take(ft_world_trigger_events(world, maybe(told.data()), kRoom, maybe(&required)));
    take(ft_world_occupants(world, maybe(inside.data()), kRoom, maybe(&required)));
    ft_depth_question question{};
    question.size = sizeOr(sizeof question);
    question.body = random_.chance(0.8) ? random_.below(3) : index();
    question.from_body = random_.chance(0.8) ? random_.below(3) : index();
    question.link = random_.chance(0.8) ? FT_EVERY_LINK : index();
    question.from_link = random_.chance(0.8) ? FT_EVERY_LINK : index();
    question.time_us = random_.chance(0.8) ? 100 * now_ : instant();
    question.time_fraction = random_.chance(0.8) ? 0.5 : number();
    ft_depth depth{};
    depth.size = sizeOr(sizeof depth);
    take(ft_world_depth(maybe(world), maybe(&question), maybe(&depth)));
  }
  void collide() {
    fillNumbers();
    std::array<double, 9> inverse{};
    take(ft_inverse_mass_at(number(), maybe(numbers_.data()), maybe(numbers_.data() + 3),
                            maybe(numbers_.data() + 12), maybe(numbers_.data() + 16),
                            maybe(numbers_.data() + 19), maybe(inverse.data())));
    ft_collision_point point{};
    point.size = sizeOr(sizeof point);
    for (int i = 0; i < 3; ++i) point.velocity[i] = number();
    point.normal[random_.below(3)] = random_.chance(0.8) ? 1.0 : number();
    for (int i = 0; i < 9; ++i) point.inverse_mass[i] = i % 4 == 0 ? 1.0 : 0.0;
    if (random_.chance(0.3)) point.inverse_mass[random_.below(9)] = number();
    point.restitution = random_.chance(0.7) ? 0.5 : number();
    point.friction = random_.chance(0.7) ? 0.5 : number();
    ft_collision_impulse impulse{};
    impulse.size = sizeOr(sizeof impulse);
    take(ft_collide(maybe(&point), maybe(&impulse)));
  }
  void addBody(test::SmallWorld& small, ft_world* world) {
    ft_body_options made = test::initialised(ft_body_options_init);
    made.size = sizeOr(sizeof made);
    if (random_.chance(0.2)) made.group = index();
    if (random_.chance(0.5)) made.when_silent = random_.below(4);
    if (random_.chance(0.1)) made.self = reinterpret_cast<const ft_pair_rules*>(world);
    std::int32_t body = -1;
    if (random_.chance(0.5)) {
      take(ft_world_add_avatar(maybe(world), maybe(small.avatar.get()), maybe(&made), &body));
    } else {
      take(ft_world_add_mesh(maybe(world), maybe(small.scene.get()), maybe(&made), &body));
    }
  }
  void tellWorld(test::SmallWorld& small, ft_world* world) {
    fillNumbers();
    const ft_pose given = pose(), good = random_.chance(0.5) ? small.up() : small.lowered();
    const ft_pose* next = random_.chance(0.8) ? &good : maybe(&given);
    ft_carrier carrier{};
    carrier.size = sizeOr(sizeof carrier);
    carrier.body = random_.chance(0.8) ? random_.below(3) : index();
    carrier.link = random_.chance(0.8) ? 0 : index();
    carrier.moves_in_frame = random_.below(3);
    const std::int32_t body = random_.chance(0.8) ? random_.below(3) : index();
    switch (random_.below(10)) {
      case 0: take(ft_world_attach(world, body, maybe(&carrier), instant(), next)); break;
      case 1: take(ft_world_detach(world, body, instant(), next)); break;
      case 2: take(ft_world_ask(maybe(world), index(), index(), index())); break;
      case 3: take(ft_world_ask_still(maybe(world), index(), index())); break;
      case 4: askWorld(world); break;
      default: take(ft_world_push(maybe(world), body, instant(), next)); break;
    }
  }
  void askWorld(ft_world* world) {
    std::int64_t known = 100 * now_;
    std::int32_t waitsFor = 0;
    take(ft_world_known_until(maybe(world), maybe(&known), maybe(&waitsFor)));
    const std::int64_t to = random_.chance(0.8) ? known : instant();
    take(ft_world_answer(maybe(world), random_.chance(0.8) ? known - 150 : instant(), to));
    std::array<ft_world_contact, kRoom> contacts{};
    contacts[0].size = sizeOr(sizeof(ft_world_contact));
    std::array<ft_silent_body, kRoom> silent{};
    silent[0].size = sizeOr(sizeof(ft_silent_body));
    ft_world_counters counters{};
    counters.size = sizeOr(sizeof counters);
    std::size_t required = 0;
    take(ft_world_contacts(world, maybe(contacts.data()), kRoom, maybe(&required)));
    take(ft_world_silent(world, maybe(silent.data()), kRoom, maybe(&required)));
    take(ft_world_get_counters(world, maybe(&counters)));
    take(ft_world_body_count(maybe(world), maybe(&required)));
    probe(world, known);
    if (random_.chance(0.1)) take(ft_world_forget_before(world, instant()));
    if (random_.chance(0.1)) take(ft_world_thin_before(world, instant(), number()));
    if (random_.chance(0.1)) take(ft_world_forget_beyond(maybe(world), index(), maybe(&known)));
    take(ft_world_pose_bytes(world, maybe(&required)));
  }
  void probe(ft_world* world, std::int64_t known) {
    const ft_ask_part part{index(), index(), index()};
    const ft_ask_instant instantOfBody{index(), 0, instant(), number()};
    ft_ask_whom whom{};
    take(ft_ask_whom_init(maybe(&whom), sizeOr(sizeof whom)));
    whom.size = sizeOr(sizeof whom);
    whom.only = maybe(&part);
    whom.only_count = static_cast<std::size_t>(random_.below(2));
    ft_question question{};
    take(ft_question_init(maybe(&question), sizeOr(sizeof question)));
    question.size = sizeOr(sizeof question);
    question.what = random_.chance(0.8) ? random_.below(3) : index();
    question.which = random_.chance(0.8) ? random_.below(3) : index();
    for (double& x : question.direction) x = number();
    question.reach = number();
    question.shape.radius = random_.chance(0.8) ? 0.1 : number();
    question.time_us = random_.chance(0.8) ? known : instant();
    question.whom = maybe(&whom);
    const std::array<double, 6> corners{number(), number(), number(), 0.1, 0.2, 0.3};
    question.hull = maybe(corners.data());
    question.hull_count = static_cast<std::size_t>(random_.below(3));
    question.solids = random_.chance(0.8) ? random_.below(2) : index();
    question.instants = maybe(&instantOfBody);
    question.instant_count = static_cast<std::size_t>(random_.below(2));
    ft_flight flight{};
    flight.size = sizeOr(sizeof flight);
    flight.shape = question.shape;
    for (double& x : flight.way) x = number();
    flight.from_us = instant();
    flight.to_us = random_.chance(0.8) ? known : instant();
    flight.whom = question.whom;
    flight.hull = question.hull;
    flight.hull_count = question.hull_count;
    ft_probed probed{};
    ft_flight_hit hit{};
    hit.size = sizeOr(sizeof hit);
    std::array<ft_world_hit, kRoom> hits{};
    hits[0].size = sizeOr(sizeof(ft_world_hit));
    std::array<ft_unknown_body, kRoom> unknown{};
    unknown[0].size = sizeOr(sizeof(ft_unknown_body));
    std::int32_t verdict = 0;
    std::size_t required = 0;
    take(ft_world_probe(maybe(world), maybe(&question), maybe(&verdict)));
    take(ft_world_probe_many(maybe(world), maybe(&question),
                             static_cast<std::size_t>(random_.below(2)), maybe(&probed)));
    take(ft_world_fly(maybe(world), maybe(&flight), maybe(&hit)));
    take(ft_world_hits(maybe(world), maybe(hits.data()), kRoom, maybe(&required)));
    take(ft_world_unknown(maybe(world), maybe(unknown.data()), kRoom, maybe(&required)));
  }

  void readAnswers(ft_query* query) {
    std::array<ft_contact, 2> contacts{};
    contacts[0].size = sizeOr(sizeof(ft_contact));
    std::array<ft_transform, 2> transforms{};
    ft_counters counters{};
    counters.size = sizeOr(sizeof counters);
    std::size_t required = 0;
    std::int32_t touches = 0;
    const auto capacity = static_cast<std::size_t>(random_.below(3));
    take(ft_query_links(maybe(query), maybe(contacts.data()), capacity, maybe(&required)));
    take(ft_query_contacts(maybe(query), maybe(contacts.data()), capacity, maybe(&required)));
    take(ft_motion_transforms(maybe(query), number(), maybe(transforms.data()), capacity,
                              maybe(&required)));
    take(ft_touches_at(maybe(query), index(), number(), maybe(&touches)));
    take(ft_query_objects(maybe(query), maybe(contacts.data()), capacity, maybe(&required)));
    take(ft_motion_pose(maybe(query), number(), maybe(numbers_.data()), maybe(numbers_.data() + 4),
                        std::min<std::size_t>(capacity, 1), maybe(&required)));
    ft_contact_details details{};
    details.size = sizeOr(sizeof details);
    take(ft_query_details(maybe(query), index(), static_cast<std::size_t>(index()),
                          maybe(&details)));
    take(ft_query_counters(maybe(query), maybe(&counters)));
  }
  void askAvatar(test::SmallWorld& world) {
    const ft_avatar* avatar = maybe(world.avatar.get());
    if (random_.chance(0.1)) avatar = reinterpret_cast<const ft_avatar*>(world.scene.get());
    const char* name = nullptr;
    std::int32_t joint = 0;
    std::size_t required = 0;
    take(ft_avatar_joint_name(avatar, index(), maybe(&name)));
    take(ft_avatar_joint_parent(avatar, index(), maybe(&joint)));
    take(ft_avatar_find_joint(avatar, maybe(random_.chance(0.5) ? "stick" : ""), maybe(&joint)));
    take(ft_avatar_rest_pose(avatar, maybe(numbers_.data()), maybe(numbers_.data()),
                             static_cast<std::size_t>(random_.below(3)), maybe(&required)));
  }
  void askScene(test::SmallWorld& world) {
    const char* name = nullptr;
    ft_scene_info info{};
    info.size = sizeOr(sizeof info);
    take(ft_scene_object_name(maybe(world.scene.get()), index(), maybe(&name)));
    take(ft_scene_get_info(maybe(world.scene.get()), maybe(&info)));
  }
  void convert() {
    std::array<float, 4 * kRoom> floats{};
    fillNumbers();
    take(ft_rotations_from_floats(maybe(floats.data()), count(), index(), maybe(numbers_.data())));
    take(ft_positions_to_floats(maybe(numbers_.data()), count(), index(), maybe(floats.data())));
  }

  std::array<ft_link_policy, kRoom> policies_{};
  std::array<ft_object_policy, kRoom> objectPolicies_{};
  std::int64_t now_ = 0;
};

TEST(CArguments, WhateverTheyAreGetAStatus) {
  constexpr int kCases = 4000, kCalls = 6;
  test::SmallWorld world;
  int accepted = 0, refused = 0;
  for (int i = 0; i < kCases; ++i) {
    SCOPED_TRACE("case " + std::to_string(i));
    const auto query = test::makeQuery(world.scene, world.avatar);
    Caller caller(static_cast<std::uint64_t>(i));
    for (int call = 0; call < kCalls; ++call) caller.callSomething(world, query.get());
    accepted += caller.accepted();
    refused += caller.refused();
    if (testing::Test::HasFailure()) break;
  }
  EXPECT_GT(accepted, kCases);
  EXPECT_GT(refused, kCases);
}

}  // namespace
}  // namespace foretouch
