// The binary interface on x86-64, in numbers: programs are compiled against them, so
// these lines only ever get company.
#include <cstddef>
#include <foretouch/ask.h>
#include <foretouch/events.h>
#include <foretouch/mechanics.h>
#include <foretouch/person.h>
#include <foretouch/robots.h>
#include <foretouch/solid.h>
#include <foretouch/solid_world.h>
#include <foretouch/triggers.h>
#include <foretouch/world.h>

#include <gtest/gtest.h>

#define AT(type, field, offset) static_assert(offsetof(type, field) == (offset))

static_assert(sizeof(ft_status) == 4);

static_assert(sizeof(ft_scene_arrays) == 64);
AT(ft_scene_arrays, size, 0);
AT(ft_scene_arrays, reserved, 4);
AT(ft_scene_arrays, positions, 8);
AT(ft_scene_arrays, vertex_count, 16);
AT(ft_scene_arrays, indices, 24);
AT(ft_scene_arrays, triangle_count, 32);
AT(ft_scene_arrays, objects, 40);
AT(ft_scene_arrays, object_names, 48);
AT(ft_scene_arrays, object_count, 56);

static_assert(sizeof(ft_import_options) == 40);
AT(ft_import_options, up, 4);
AT(ft_import_options, scale, 8);
AT(ft_import_options, memory_limit_bytes, 16);
AT(ft_import_options, time_limit_s, 24);
AT(ft_import_options, importer, 32);

static_assert(sizeof(ft_scene_info) == 88);
AT(ft_scene_info, object_count, 4);
AT(ft_scene_info, triangles, 8);
AT(ft_scene_info, dropped_non_finite, 16);
AT(ft_scene_info, zero_area, 24);
AT(ft_scene_info, duplicates, 32);
AT(ft_scene_info, box_min, 40);
AT(ft_scene_info, box_max, 64);

static_assert(sizeof(ft_lss) == 56);
AT(ft_lss, a, 0);
AT(ft_lss, b, 24);
AT(ft_lss, radius, 48);
static_assert(sizeof(ft_triangle) == 72);

static_assert(sizeof(ft_avatar_arrays) == 96);
AT(ft_avatar_arrays, reserved, 4);
AT(ft_avatar_arrays, joint_count, 8);
AT(ft_avatar_arrays, names, 16);
AT(ft_avatar_arrays, parents, 24);
AT(ft_avatar_arrays, offsets, 32);
AT(ft_avatar_arrays, rotations, 40);
AT(ft_avatar_arrays, lss, 48);
AT(ft_avatar_arrays, lss_links, 56);
AT(ft_avatar_arrays, lss_count, 64);
AT(ft_avatar_arrays, triangles, 72);
AT(ft_avatar_arrays, triangle_links, 80);
AT(ft_avatar_arrays, triangle_count, 88);

static_assert(sizeof(ft_pose) == 24);
AT(ft_pose, joint_count, 4);
AT(ft_pose, rotations, 8);
AT(ft_pose, translations, 16);

static_assert(sizeof(ft_clip_options) == 64);
AT(ft_clip_options, up, 4);
AT(ft_clip_options, scale, 8);
AT(ft_clip_options, yaw_deg, 16);
AT(ft_clip_options, origin, 24);
AT(ft_clip_options, skeleton, 48);
AT(ft_clip_options, row_rate_hz, 56);

static_assert(sizeof(ft_clip_info) == 24);
AT(ft_clip_info, matched_joints, 4);
AT(ft_clip_info, frame_count, 8);
AT(ft_clip_info, frame_time_s, 16);

static_assert(sizeof(ft_link_pair) == 8);
static_assert(sizeof(ft_left_out_pair) == 12);
AT(ft_left_out_pair, b, 4);
AT(ft_left_out_pair, reason, 8);

static_assert(sizeof(ft_pair_radius) == 24);
AT(ft_pair_radius, lss_a, 4);
AT(ft_pair_radius, b, 8);
AT(ft_pair_radius, lss_b, 12);
AT(ft_pair_radius, radius, 16);

static_assert(sizeof(ft_pair_rule_options) == 64);
AT(ft_pair_rule_options, use_pair_radii, 4);
AT(ft_pair_rule_options, rest_skin, 8);
AT(ft_pair_rule_options, always_share, 16);
AT(ft_pair_rule_options, usual_rotations, 24);
AT(ft_pair_rule_options, usual_translations, 32);
AT(ft_pair_rule_options, usual_count, 40);
AT(ft_pair_rule_options, left_out, 48);
AT(ft_pair_rule_options, left_out_count, 56);

static_assert(sizeof(ft_pair_touches) == 16);
AT(ft_pair_touches, b, 4);
AT(ft_pair_touches, touches, 8);

static_assert(sizeof(ft_robot_pair_options) == 40);
AT(ft_robot_pair_options, samples, 4);
AT(ft_robot_pair_options, seed, 8);
AT(ft_robot_pair_options, always_share, 16);
AT(ft_robot_pair_options, left_out, 24);
AT(ft_robot_pair_options, left_out_count, 32);

static_assert(sizeof(ft_pair_rules_info) == 40);
AT(ft_pair_rules_info, pairs, 8);
AT(ft_pair_rules_info, asked, 16);
AT(ft_pair_rules_info, left_out, 24);
AT(ft_pair_rules_info, radii, 32);

static_assert(sizeof(ft_other_link) == 8);
AT(ft_other_link, lss, 4);

static_assert(sizeof(ft_ignored_pair) == 8);
static_assert(sizeof(ft_link_policy) == 16);
AT(ft_link_policy, fidelity, 8);

static_assert(sizeof(ft_object_policy) == 24);
AT(ft_object_policy, object, 4);
AT(ft_object_policy, tolerance, 8);
AT(ft_object_policy, fidelity, 16);
AT(ft_object_policy, ignore, 20);

static_assert(sizeof(ft_query_options) == 96);
AT(ft_query_options, fidelity, 4);
AT(ft_query_options, tolerance, 8);
AT(ft_query_options, work_budget, 16);
AT(ft_query_options, deadline_us, 24);
AT(ft_query_options, scope, 32);
AT(ft_query_options, reserved, 36);
AT(ft_query_options, ignored, 40);
AT(ft_query_options, ignored_count, 48);
AT(ft_query_options, policies, 56);
AT(ft_query_options, policy_count, 64);
AT(ft_query_options, object_policies, 72);
AT(ft_query_options, object_policy_count, 80);
AT(ft_query_options, pass_separating, 88);
AT(ft_query_options, reserved_end, 92);

static_assert(sizeof(ft_contact) == 144);
AT(ft_contact, link, 4);
AT(ft_contact, verdict, 8);
AT(ft_contact, reason, 12);
AT(ft_contact, toi, 16);
AT(ft_contact, free_until, 24);
AT(ft_contact, separation, 32);
AT(ft_contact, penetration, 40);
AT(ft_contact, point_scene, 48);
AT(ft_contact, point_link, 72);
AT(ft_contact, normal, 96);
AT(ft_contact, triangle, 120);
AT(ft_contact, object, 124);
AT(ft_contact, lss, 128);
AT(ft_contact, link_triangle, 132);
AT(ft_contact, link_feature, 136);
AT(ft_contact, scene_feature, 140);

static_assert(sizeof(ft_contact_point) == 72);
AT(ft_contact_point, point_link, 24);
AT(ft_contact_point, separation, 48);
AT(ft_contact_point, triangle, 56);
AT(ft_contact_point, lss, 60);
AT(ft_contact_point, link_triangle, 64);
AT(ft_contact_point, reserved, 68);

static_assert(sizeof(ft_contact_details) == 368);
AT(ft_contact_details, point_count, 4);
AT(ft_contact_details, velocity_scene, 8);
AT(ft_contact_details, velocity_link, 32);
AT(ft_contact_details, approach_speed, 56);
AT(ft_contact_details, approach_lower, 64);
AT(ft_contact_details, approach_upper, 72);
AT(ft_contact_details, points, 80);

static_assert(sizeof(ft_transform) == 104);
AT(ft_transform, translation, 32);
AT(ft_transform, angular_velocity, 56);
AT(ft_transform, velocity, 80);

static_assert(sizeof(ft_counters) == 104);
AT(ft_counters, nodes, 8);
AT(ft_counters, hierarchy_tests, 64);
AT(ft_counters, rung_tests, 96);

static_assert(sizeof(ft_solid_options) == 184);
AT(ft_solid_options, floor, 4);
AT(ft_solid_options, skin, 8);
AT(ft_solid_options, tolerance, 16);
AT(ft_solid_options, catch_up, 24);
AT(ft_solid_options, up, 32);
AT(ft_solid_options, most_lift, 56);
AT(ft_solid_options, most_deviation, 64);
AT(ft_solid_options, most_limb_deviation, 72);
AT(ft_solid_options, patience, 80);
AT(ft_solid_options, snap_notice, 88);
AT(ft_solid_options, placing_reach, 96);
AT(ft_solid_options, may_snap, 104);
AT(ft_solid_options, around_per_tick, 108);
AT(ft_solid_options, around_in_all, 112);
AT(ft_solid_options, reserved, 116);
AT(ft_solid_options, work_budget, 120);
AT(ft_solid_options, visibility, 128);
AT(ft_solid_options, visibility_count, 136);
AT(ft_solid_options, feet, 144);
AT(ft_solid_options, feet_count, 152);
AT(ft_solid_options, ignored, 160);
AT(ft_solid_options, ignored_count, 168);
AT(ft_solid_options, self, 176);

static_assert(sizeof(ft_solid_tick) == 112);
AT(ft_solid_tick, state, 4);
AT(ft_solid_tick, limit, 8);
AT(ft_solid_tick, is_certified, 12);
AT(ft_solid_tick, has_appeared, 16);
AT(ft_solid_tick, reserved, 20);
AT(ft_solid_tick, deviation, 24);
AT(ft_solid_tick, lift, 32);
AT(ft_solid_tick, clearance, 40);
AT(ft_solid_tick, snap_in_s, 48);
AT(ft_solid_tick, joint_count, 56);
AT(ft_solid_tick, contact_count, 64);
AT(ft_solid_tick, way_count, 72);
AT(ft_solid_tick, queries, 80);
AT(ft_solid_tick, iterations, 84);
AT(ft_solid_tick, features, 88);
AT(ft_solid_tick, rows, 92);
AT(ft_solid_tick, around_queries, 96);
AT(ft_solid_tick, placing_queries, 100);
AT(ft_solid_tick, work, 104);

static_assert(sizeof(ft_solid_joint) == 16);
AT(ft_solid_joint, state, 4);
AT(ft_solid_joint, deviation, 8);

static_assert(sizeof(ft_solid_contact) == 96);
AT(ft_solid_contact, link, 4);
AT(ft_solid_contact, lss, 8);
AT(ft_solid_contact, triangle, 12);
AT(ft_solid_contact, object, 16);
AT(ft_solid_contact, other, 20);
AT(ft_solid_contact, point, 24);
AT(ft_solid_contact, normal, 48);
AT(ft_solid_contact, gap, 72);
AT(ft_solid_contact, push, 80);
AT(ft_solid_contact, slip_speed, 88);

static_assert(sizeof(ft_world_options) == 40);
AT(ft_world_options, asks_meshes, 4);
AT(ft_world_options, tolerance, 8);
AT(ft_world_options, work_per_pair, 16);
AT(ft_world_options, work_per_window, 24);
AT(ft_world_options, most_near, 32);

static_assert(sizeof(ft_body_options) == 24);
AT(ft_body_options, group, 4);
AT(ft_body_options, when_silent, 8);
AT(ft_body_options, fidelity, 12);
AT(ft_body_options, self, 16);

static_assert(sizeof(ft_carrier) == 16);
AT(ft_carrier, body, 4);
AT(ft_carrier, link, 8);
AT(ft_carrier, moves_in_frame, 12);

static_assert(sizeof(ft_world_side) == 48);
AT(ft_world_side, body, 0);
AT(ft_world_side, link, 4);
AT(ft_world_side, lss, 8);
AT(ft_world_side, triangle, 12);
AT(ft_world_side, object, 16);
AT(ft_world_side, reserved, 20);
AT(ft_world_side, point, 24);

static_assert(sizeof(ft_world_contact) == 168);
AT(ft_world_contact, verdict, 4);
AT(ft_world_contact, reason, 8);
AT(ft_world_contact, is_assumed, 12);
AT(ft_world_contact, time_us, 16);
AT(ft_world_contact, time_fraction, 24);
AT(ft_world_contact, separation, 32);
AT(ft_world_contact, penetration, 40);
AT(ft_world_contact, normal, 48);
AT(ft_world_contact, a, 72);
AT(ft_world_contact, b, 120);

static_assert(sizeof(ft_silent_body) == 24);
AT(ft_silent_body, body, 4);
AT(ft_silent_body, since_us, 8);
AT(ft_silent_body, taken_to, 16);
AT(ft_silent_body, reserved, 20);

static_assert(sizeof(ft_world_counters) == 136);
AT(ft_world_counters, bodies, 8);
AT(ft_world_counters, pairs, 16);
AT(ft_world_counters, near_pairs, 24);
AT(ft_world_counters, spans, 32);
AT(ft_world_counters, nodes, 40);
AT(ft_world_counters, hierarchy_tests, 96);
AT(ft_world_counters, rung_tests, 128);

static_assert(sizeof(ft_follow_options) == 16);
AT(ft_follow_options, threads, 4);
AT(ft_follow_options, cut_us, 8);

static_assert(sizeof(ft_event_point) == 56);
AT(ft_event_point, point_a, 0);
AT(ft_event_point, point_b, 24);
AT(ft_event_point, separation, 48);

static_assert(sizeof(ft_event) == 472);
AT(ft_event, kind, 4);
AT(ft_event, cause, 8);
AT(ft_event, reason, 12);
AT(ft_event, time_us, 16);
AT(ft_event, time_fraction, 24);
AT(ft_event, since_us, 32);
AT(ft_event, since_fraction, 40);
AT(ft_event, separation, 48);
AT(ft_event, penetration, 56);
AT(ft_event, normal, 64);
AT(ft_event, velocity, 88);
AT(ft_event, approach_speed, 112);
AT(ft_event, approach_lower, 120);
AT(ft_event, approach_upper, 128);
AT(ft_event, effective_mass, 136);
AT(ft_event, a, 144);
AT(ft_event, b, 192);
AT(ft_event, is_assumed, 240);
AT(ft_event, point_count, 244);
AT(ft_event, points, 248);

static_assert(sizeof(ft_part) == 168);
AT(ft_part, is_contact, 4);
AT(ft_part, reason, 8);
AT(ft_part, is_assumed, 12);
AT(ft_part, began_before, 16);
AT(ft_part, goes_on, 20);
AT(ft_part, from_us, 24);
AT(ft_part, from_fraction, 32);
AT(ft_part, to_us, 40);
AT(ft_part, to_fraction, 48);
AT(ft_part, since_us, 56);
AT(ft_part, since_fraction, 64);
AT(ft_part, a, 72);
AT(ft_part, b, 120);

static_assert(sizeof(ft_trigger_options) == 16);
AT(ft_trigger_options, group, 4);
AT(ft_trigger_options, when_silent, 8);
AT(ft_trigger_options, by_link, 12);

static_assert(sizeof(ft_trigger_event) == 56);
AT(ft_trigger_event, kind, 4);
AT(ft_trigger_event, trigger, 8);
AT(ft_trigger_event, body, 12);
AT(ft_trigger_event, link, 16);
AT(ft_trigger_event, is_assumed, 20);
AT(ft_trigger_event, time_us, 24);
AT(ft_trigger_event, time_fraction, 32);
AT(ft_trigger_event, since_us, 40);
AT(ft_trigger_event, since_fraction, 48);

static_assert(sizeof(ft_occupant) == 40);
AT(ft_occupant, trigger, 4);
AT(ft_occupant, body, 8);
AT(ft_occupant, link, 12);
AT(ft_occupant, is_unresolved, 16);
AT(ft_occupant, reserved, 20);
AT(ft_occupant, since_us, 24);
AT(ft_occupant, since_fraction, 32);

static_assert(sizeof(ft_depth_question) == 40);
AT(ft_depth_question, body, 4);
AT(ft_depth_question, link, 8);
AT(ft_depth_question, from_body, 12);
AT(ft_depth_question, from_link, 16);
AT(ft_depth_question, reserved, 20);
AT(ft_depth_question, time_us, 24);
AT(ft_depth_question, time_fraction, 32);

static_assert(sizeof(ft_depth) == 80);
AT(ft_depth, is_certified, 4);
AT(ft_depth, lower, 8);
AT(ft_depth, upper, 16);
AT(ft_depth, way_out, 24);
AT(ft_depth, pair_count, 48);
AT(ft_depth, is_assumed, 52);
AT(ft_depth, link, 56);
AT(ft_depth, lss, 60);
AT(ft_depth, from_link, 64);
AT(ft_depth, from_lss, 68);
AT(ft_depth, from_triangle, 72);
AT(ft_depth, reserved, 76);

static_assert(sizeof(ft_collision_point) == 144);
AT(ft_collision_point, reserved, 4);
AT(ft_collision_point, normal, 8);
AT(ft_collision_point, velocity, 32);
AT(ft_collision_point, inverse_mass, 56);
AT(ft_collision_point, restitution, 128);
AT(ft_collision_point, friction, 136);

static_assert(sizeof(ft_collision_impulse) == 56);
AT(ft_collision_impulse, sticks, 4);
AT(ft_collision_impulse, on_a, 8);
AT(ft_collision_impulse, restitution, 32);
AT(ft_collision_impulse, friction, 40);
AT(ft_collision_impulse, effective_mass, 48);

static_assert(sizeof(ft_robot_joint) == 64);
AT(ft_robot_joint, mimic_of, 4);
AT(ft_robot_joint, axis, 8);
AT(ft_robot_joint, lower, 32);
AT(ft_robot_joint, upper, 40);
AT(ft_robot_joint, mimic_factor, 48);
AT(ft_robot_joint, mimic_offset, 56);

static_assert(sizeof(ft_urdf_options) == 40);
AT(ft_urdf_options, max_lss_per_link, 4);
AT(ft_urdf_options, import, 8);
AT(ft_urdf_options, package_paths, 16);
AT(ft_urdf_options, package_count, 24);
AT(ft_urdf_options, use_visual, 32);
AT(ft_urdf_options, reserved, 36);

static_assert(sizeof(ft_robot_coordinate) == 40);
AT(ft_robot_coordinate, joint, 4);
AT(ft_robot_coordinate, name, 8);
AT(ft_robot_coordinate, lower, 16);
AT(ft_robot_coordinate, upper, 24);
AT(ft_robot_coordinate, is_angle, 32);
AT(ft_robot_coordinate, is_periodic, 36);

static_assert(sizeof(ft_link_bound) == 56);
AT(ft_link_bound, acceleration, 8);
AT(ft_link_bound, follow_floor, 16);
AT(ft_link_bound, follow_share, 24);
AT(ft_link_bound, speed, 32);
AT(ft_link_bound, ahead_speed, 40);
AT(ft_link_bound, ahead_acceleration, 48);

static_assert(sizeof(ft_bracket_options) == 48);
AT(ft_bracket_options, fidelity, 4);
AT(ft_bracket_options, resolution, 8);
AT(ft_bracket_options, ignored, 16);
AT(ft_bracket_options, ignored_count, 24);
AT(ft_bracket_options, self, 32);
AT(ft_bracket_options, work_budget, 40);

static_assert(sizeof(ft_posed_step) == 64);
AT(ft_posed_step, between, 4);
AT(ft_posed_step, before, 8);
AT(ft_posed_step, from, 16);
AT(ft_posed_step, to, 24);
AT(ft_posed_step, after, 32);
AT(ft_posed_step, seconds_before, 40);
AT(ft_posed_step, seconds, 48);
AT(ft_posed_step, seconds_after, 56);

static_assert(sizeof(ft_link_bracket) == 64);
AT(ft_link_bracket, link, 4);
AT(ft_link_bracket, other, 8);
AT(ft_link_bracket, verdict, 12);
AT(ft_link_bracket, triangle, 16);
AT(ft_link_bracket, object, 20);
AT(ft_link_bracket, possible_from, 24);
AT(ft_link_bracket, possible_until, 32);
AT(ft_link_bracket, certain_from, 40);
AT(ft_link_bracket, certain_until, 48);
AT(ft_link_bracket, growth, 56);

static_assert(sizeof(ft_edge_prop) == 88);
AT(ft_edge_prop, scene, 0);
AT(ft_edge_prop, rotation, 8);
AT(ft_edge_prop, translation, 40);
AT(ft_edge_prop, is_absent, 64);
AT(ft_edge_prop, reserved, 68);
AT(ft_edge_prop, ignored, 72);
AT(ft_edge_prop, ignored_count, 80);

static_assert(sizeof(ft_edge_options) == 80);
AT(ft_edge_options, threads, 4);
AT(ft_edge_options, tolerance, 8);
AT(ft_edge_options, clearance, 16);
AT(ft_edge_options, self, 24);
AT(ft_edge_options, ignored, 32);
AT(ft_edge_options, ignored_count, 40);
AT(ft_edge_options, props, 48);
AT(ft_edge_options, prop_count, 56);
AT(ft_edge_options, clearance_tolerance, 64);
AT(ft_edge_options, clearance_within, 72);

static_assert(sizeof(ft_clearance) == 120);
AT(ft_clearance, link, 4);
AT(ft_clearance, lss, 8);
AT(ft_clearance, triangle, 12);
AT(ft_clearance, prop, 16);
AT(ft_clearance, is_alone, 20);
AT(ft_clearance, lower, 24);
AT(ft_clearance, upper, 32);
AT(ft_clearance, t, 40);
AT(ft_clearance, point_on_link, 48);
AT(ft_clearance, point_on_scene, 72);
AT(ft_clearance, normal, 96);

static_assert(sizeof(ft_edge) == 32);
AT(ft_edge, verdict, 4);
AT(ft_edge, reason, 8);
AT(ft_edge, is_usable, 12);
AT(ft_edge, free_until, 16);
AT(ft_edge, breach_at_0, 24);
AT(ft_edge, breach_at_1, 28);

static_assert(sizeof(ft_path) == 24);
AT(ft_path, verdict, 4);
AT(ft_path, edge, 8);
AT(ft_path, free_until, 16);

static_assert(sizeof(ft_ask_part) == 12);
static_assert(sizeof(ft_ask_instant) == 24);
AT(ft_ask_instant, time_us, 8);
AT(ft_ask_instant, time_fraction, 16);

static_assert(sizeof(ft_ask_whom) == 48);
AT(ft_ask_whom, groups, 4);
AT(ft_ask_whom, asks_still, 8);
AT(ft_ask_whom, reserved, 12);
AT(ft_ask_whom, only, 16);
AT(ft_ask_whom, only_count, 24);
AT(ft_ask_whom, without, 32);
AT(ft_ask_whom, without_count, 40);

static_assert(sizeof(ft_skin) == 72);
AT(ft_skin, reserved, 4);
AT(ft_skin, vertex_count, 8);
AT(ft_skin, first_share, 16);
AT(ft_skin, share_links, 24);
AT(ft_skin, share_weights, 32);
AT(ft_skin, share_points, 40);
AT(ft_skin, triangles, 48);
AT(ft_skin, triangle_links, 56);
AT(ft_skin, triangle_count, 64);

static_assert(sizeof(ft_question) == 168);
AT(ft_question, what, 4);
AT(ft_question, which, 8);
AT(ft_question, reserved, 12);
AT(ft_question, shape, 16);
AT(ft_question, direction, 72);
AT(ft_question, reach, 96);
AT(ft_question, time_us, 104);
AT(ft_question, time_fraction, 112);
AT(ft_question, whom, 120);
AT(ft_question, instants, 128);
AT(ft_question, instant_count, 136);
AT(ft_question, hull, 144);
AT(ft_question, hull_count, 152);
AT(ft_question, solids, 160);
AT(ft_question, reserved_end, 164);

static_assert(sizeof(ft_world_hit) == 112);
AT(ft_world_hit, is_assumed, 4);
AT(ft_world_hit, what, 8);
AT(ft_world_hit, distance, 56);
AT(ft_world_hit, normal, 64);
AT(ft_world_hit, weights, 88);

static_assert(sizeof(ft_unknown_body) == 16);
AT(ft_unknown_body, body, 4);
AT(ft_unknown_body, why, 8);
AT(ft_unknown_body, object, 12);

static_assert(sizeof(ft_probed) == 16);
AT(ft_probed, hit_count, 4);
AT(ft_probed, unknown_count, 8);
AT(ft_probed, reserved, 12);

static_assert(sizeof(ft_flight) == 128);
AT(ft_flight, shape, 8);
AT(ft_flight, way, 64);
AT(ft_flight, from_us, 88);
AT(ft_flight, to_us, 96);
AT(ft_flight, whom, 104);
AT(ft_flight, hull, 112);
AT(ft_flight, hull_count, 120);

static_assert(sizeof(ft_flight_hit) == 136);
AT(ft_flight_hit, verdict, 4);
AT(ft_flight_hit, time_us, 8);
AT(ft_flight_hit, time_fraction, 16);
AT(ft_flight_hit, is_assumed, 24);
AT(ft_flight_hit, what, 32);
AT(ft_flight_hit, distance, 80);
AT(ft_flight_hit, normal, 88);
AT(ft_flight_hit, weights, 112);

static_assert(sizeof(ft_solid_target) == 24);
AT(ft_solid_target, body, 0);
AT(ft_solid_target, reserved, 4);
AT(ft_solid_target, pose, 8);
AT(ft_solid_target, is_tracked, 16);

static_assert(sizeof(ft_solid_body_contact) == 96);
AT(ft_solid_body_contact, body, 4);
AT(ft_solid_body_contact, link, 8);
AT(ft_solid_body_contact, lss, 12);
AT(ft_solid_body_contact, triangle, 16);
AT(ft_solid_body_contact, object, 20);
AT(ft_solid_body_contact, point, 24);
AT(ft_solid_body_contact, normal, 48);
AT(ft_solid_body_contact, gap, 72);
AT(ft_solid_body_contact, push, 80);
AT(ft_solid_body_contact, slip_speed, 88);

static_assert(sizeof(ft_solid_crush) == 32);
AT(ft_solid_crush, body, 4);
AT(ft_solid_crush, link, 8);
AT(ft_solid_crush, is_over, 12);
AT(ft_solid_crush, since_us, 16);
AT(ft_solid_crush, depth, 24);

static_assert(sizeof(ft_solid_held) == 16);
AT(ft_solid_held, body, 4);
AT(ft_solid_held, state, 8);
AT(ft_solid_held, reserved, 12);

namespace {

TEST(CLayout, IsWhatProgramsWereCompiledAgainst) {
  EXPECT_EQ(FT_ABI_VERSION, 11);  // a field or a function more: count up, and add its lines above
}

}  // namespace
