# ForetouchHand: shows a tracked Skeleton, or Spatial, by another one that passes through nothing.
extends "foretouch_node.gd"
class_name ForetouchHand

# A joint begins and ceases to be held by an object (both are names); and each physics frame, where and how
# hard: `push` is how far the tracked hand is beyond, in metres; times a stiffness (N/m) it is a force.
signal touched(joint, object)
signal released(joint, object)
signal push(joint, object, point, normal, push)

# The Skeleton that trackers move, or a Spatial with CollisionShapes: hide it. And what is shown: another one,
# with the same bones.
export var tracked: NodePath
export var shown: NodePath
# Gap that is kept to surfaces, in metres.
export var skin := 2e-3

enum { PLACING, EQUAL, FOLLOWING, SLIDING, HELD, AROUND, SNAPPED }
var state := PLACING
var deviation := 0.0  # metres between shown and tracked
var is_certified := false  # the way to what is shown now is proven free

var _tracked = null
var _shown = null
var _held := {}


# After a teleport, or when trackers were gone for long: begins anew at the tracked place.
func reset() -> void:
	if body != null:
		body.reset()


func _physics_process(delta: float) -> void:
	if not _is_ready():
		return
	var count: int = body.follow(_tracked if is_instance_valid(_tracked) else null, delta)
	if count < 0 or not body.show(_shown if is_instance_valid(_shown) else null):
		_stop(body.error())
		return
	state = body.tick_state()
	deviation = body.tick_deviation()
	is_certified = body.tick_is_certified()
	if count > 0 or not _held.empty():
		_tell(count)


func _tell(count: int) -> void:
	var held := {}
	var told := []
	for i in count:
		var pair := [body.joint_name(body.press_joint(i)), _object_name(body.press_object(i))]
		if not held.has(pair) and not _held.has(pair):
			told.append(["touched"] + pair)
		held[pair] = true
		told.append(["push"] + pair + [body.press_point(i), body.press_normal(i), body.press_push(i)])
	for pair in _held:
		if not held.has(pair):
			told.append(["released"] + pair)
	_held = held
	for one in told:
		callv("emit_signal", one)
		if _is_going():
			return


func _moved_node():
	_tracked = get_node_or_null(tracked) if not tracked.is_empty() else null
	_shown = get_node_or_null(shown) if not shown.is_empty() else null
	return _tracked if _shown is Spatial and _shown != _tracked else null


func _use_scene(handle) -> bool:
	return body.make_solid(handle, skin)


func _words_for_no_node() -> String:
	return "`tracked` and `shown` must be two Skeletons, or two Spatials: what trackers move, and a copy that is shown"


func _class() -> String:
	return "ForetouchHand"
