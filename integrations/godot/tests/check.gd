# What the tests share: counted checks, and level parts. A test extends it, and ends with finish().
extends SceneTree

const ForetouchScene := preload("res://addons/foretouch/foretouch_scene.gd")
const ForetouchBody := preload("res://addons/foretouch/foretouch_body.gd")
const ForetouchHand := preload("res://addons/foretouch/foretouch_hand.gd")

var _checks := 0
var _failures := 0


func check(is_so: bool, what: String) -> void:
	_checks += 1
	if not is_so:
		_failures += 1
		print("FAILED: ", what)


func finish() -> void:
	print("%d checks, %d failed" % [_checks, _failures])
	OS.exit_code = 0 if _failures == 0 and _checks > 0 else 1
	quit()


func box(name: String, size: Vector3, place: Vector3, group := "foretouch") -> MeshInstance:
	var node := MeshInstance.new()
	node.name = name
	# The server without a screen keeps a mesh as it was first asked for: the size comes before the node.
	var mesh := CubeMesh.new()
	mesh.size = size
	node.mesh = mesh
	node.translation = place
	node.add_to_group(group)
	root.add_child(node)
	return node


func scene(group := "foretouch"):
	var node = ForetouchScene.new()
	node.group = group
	root.add_child(node)
	return node


# A KinematicBody with a ball, or with a capsule along its x.
func ball(radius: float, length := 0.0) -> KinematicBody:
	var node := KinematicBody.new()
	var shape := CollisionShape.new()
	if length > 0:
		shape.shape = CapsuleShape.new()
		shape.shape.height = length
		shape.rotate_y(PI / 2)
	else:
		shape.shape = SphereShape.new()
	shape.shape.radius = radius
	node.add_child(shape)
	root.add_child(node)
	return node


# An arm: three bones along x, 0.3 m each, and a fingertip.
func arm() -> Skeleton:
	var node := Skeleton.new()
	for i in 4:
		node.add_bone("bone%d" % i)
		node.set_bone_parent(i, i - 1)
		node.set_bone_rest(i, Transform(Basis(), Vector3(0.3 if i > 0 else 0.0, 0, 0)))
	root.add_child(node)
	return node


func frames(count: int):
	for _i in count:
		yield(self, "physics_frame")
	yield(self, "idle_frame")
