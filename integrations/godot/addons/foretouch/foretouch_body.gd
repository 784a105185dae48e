# ForetouchBody: reports what a Skeleton, or any Spatial with CollisionShapes, meets between two physics frames.
extends "foretouch_node.gd"
class_name ForetouchBody

# Each touch between two physics frames, the earliest first: a Dictionary with `joint`, `object` (names), `node`
# (the MeshInstance), `share` of the step before which nothing is touched, `starts_inside`, `undecided` (from
# `share` on nothing is claimed), `point`, `normal`.
signal touched(touch)

# The Skeleton or Spatial. Empty: the parent.
export var skeleton: NodePath
# Metres: touches are reported at most so much early, and never late.
export var tolerance := 1e-3

var _moved = null


# After a teleport: what lies between is not swept through.
func restart() -> void:
	if body != null:
		body.restart()


# What the body meets if its node goes from one place in the world to another, turning at a constant rate on
# the shorter arc, with its bones as they are now. Moves nothing. null: it is proven to touch nothing. Else a
# touch, as above, and `place`: where the node is then. Where something is wrong (`problem`), nothing is known:
# the touch is `undecided`, at `from`.
func rotate_and_collide(from: Transform, to: Transform):
	if not _is_ready():
		return _unknown(from)
	var count: int = body.sweep(_moved if is_instance_valid(_moved) else null, from, to)
	if count == 0:
		return null
	if count < 0:
		_stop(body.error())
		return _unknown(from)
	var touch := _touch(0)
	touch.place = body.place_of_node_at(touch.share)
	return touch


func _physics_process(_delta: float) -> void:
	if not _is_ready():
		return
	var count: int = body.step(_moved if is_instance_valid(_moved) else null)
	if count == 0:
		return
	if count < 0:
		_stop(body.error())
		return
	var touches := []
	for i in count:
		touches.append(_touch(i))
	for touch in touches:
		emit_signal("touched", touch)
		if _is_going():
			return


func _touch(i: int) -> Dictionary:
	var object: int = body.contact_object(i)
	var verdict: int = body.contact_verdict(i)
	return {
		joint = body.joint_name(body.contact_joint(i)), object = _object_name(object), node = _scene.node_of(object),
		share = body.contact_share(i), starts_inside = verdict == 2, undecided = verdict == 3,
		point = body.contact_point(i), normal = body.contact_normal(i)
	}


func _unknown(at: Transform) -> Dictionary:
	return {
		joint = "", object = "", node = null, share = 0.0, starts_inside = false, undecided = true, point = at.origin, normal = Vector3(),
		place = at
	}


func _moved_node():
	_moved = get_parent() if skeleton.is_empty() else get_node_or_null(skeleton)
	return _moved


func _use_scene(handle) -> bool:
	return body.use_scene(handle, tolerance)


func _words_for_no_node() -> String:
	return "`skeleton` names no Skeleton or Spatial"


func _class() -> String:
	return "ForetouchBody"
