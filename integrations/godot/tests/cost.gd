# What steps cost in GDScript: of the bundled clip, and of a Skeleton and a Spatial that move; the least of many short
# rounds. Poses go into a file for cost.c, which asks the same in C.
extends "check.gd"

const FtScene := preload("res://addons/foretouch/ft_scene.gdns")
const FtBody := preload("res://addons/foretouch/ft_body.gdns")
const ROUNDS := 100
const FRAMES := 200


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	var examples := OS.get_environment("FORETOUCH_EXAMPLES")
	var room = FtScene.new()
	check(room.load(examples + "/room.obj") == "", "the room is read")
	_clip(room, examples)
	var file := File.new()
	check(file.open(OS.get_environment("FORETOUCH_OUT") + "/poses.bin", File.WRITE) == OK, "can write")
	_rigid(room, file)
	_skeleton(room, file)
	file.close()
	finish()


func _clip(room, examples: String) -> void:
	var body = FtBody.new()
	check(body.load(examples + "/dancer.avatar.json"), "the avatar is read")
	var frames: int = body.load_clip(examples + "/dancer.bvh")
	check(body.use_scene(room, 1e-3), "made")
	var least := INF
	for _round in ROUNDS:
		body.restart()
		var begin := OS.get_ticks_usec()
		for frame in frames:
			for i in body.step_clip(frame):
				body.contact_share(i)
		least = min(least, OS.get_ticks_usec() - begin)
	print("clip %d %f" % [frames, least / frames])


func _places(frame: int) -> Transform:
	return Transform(Basis(Vector3(0, 1, 0), 0.01 * frame), Vector3(sin(0.011 * frame), 1.0 + 0.2 * sin(0.017 * frame), cos(0.013 * frame)))


func _rigid(room, file: File) -> void:
	var node := Spatial.new()
	root.add_child(node)
	var body = FtBody.new()
	body.add_joint("hand", -1, -1)
	check(body.add_capsule(0, Vector3(-0.05, 0, 0), Vector3(0.05, 0, 0), 0.01) and body.build(node) and body.use_scene(room, 1e-3), "made")
	var places := []
	for frame in FRAMES:
		places.append(_places(frame))
	var least := INF
	for _round in ROUNDS:
		var begin := OS.get_ticks_usec()
		for frame in FRAMES - 1:
			for i in body.sweep(node, places[frame], places[frame + 1]):
				body.contact_share(i)
		least = min(least, OS.get_ticks_usec() - begin)
	print("rigid %d %f" % [FRAMES - 1, least / (FRAMES - 1)])
	for frame in FRAMES:
		node.transform = places[frame]
		body.step(node)
		file.store_buffer(body.step_bytes().subarray(0, 7 * 8 - 1))


func _skeleton(room, file: File) -> void:
	var node := Skeleton.new()
	for bone in 26:
		node.add_bone("bone%d" % bone)
		node.set_bone_parent(bone, -1 if bone == 0 else (bone - 1) / 5)
		node.set_bone_rest(bone, Transform(Basis(), Vector3(0.02, 0.01 * (bone % 5), 0)))
	root.add_child(node)
	var body = FtBody.new()
	for bone in 26:
		body.add_joint("bone%d" % bone, node.get_bone_parent(bone), bone)
		body.add_capsule(bone, Vector3(), Vector3(0.02, 0, 0), 0.01)
	check(body.build(node) and body.use_scene(room, 1e-3), "made")
	var least := INF
	for _round in ROUNDS:
		body.restart()
		var spent := 0
		for frame in FRAMES:
			node.transform = _places(frame)
			var begin := OS.get_ticks_usec()
			for i in body.step(node):
				body.contact_share(i)
			spent += OS.get_ticks_usec() - begin
		least = min(least, spent)
	print("skeleton %d %f" % [FRAMES, least / FRAMES])
	for frame in FRAMES:
		node.transform = _places(frame)
		body.step(node)
		file.store_buffer(body.step_bytes().subarray(0, 26 * 7 * 8 - 1))
