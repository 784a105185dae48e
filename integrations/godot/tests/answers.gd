# All answers without rounding, into files: of the bundled clips, which answers.c writes on its own; and of
# Godot's own meshes and bones, with all that these were asked of, which answers.c asks again.
#   godot3-server --path . -s answers.gd   with FORETOUCH_EXAMPLES and FORETOUCH_OUT in the environment
extends "check.gd"

const FtScene := preload("res://addons/foretouch/ft_scene.gdns")
const FtBody := preload("res://addons/foretouch/ft_body.gdns")

const STEPS := 400
const BONES := 12


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	var examples := OS.get_environment("FORETOUCH_EXAMPLES")
	var folder := OS.get_environment("FORETOUCH_OUT")
	_write_clip(examples, "room", "dancer", folder + "/steps.bin", false)
	_write_clip(examples, "desk", "hand", folder + "/ticks.bin", true)
	_write_own(folder + "/own.bin")
	finish()


func _write_clip(examples: String, place: String, who: String, path: String, is_solid: bool) -> void:
	var made = FtScene.new()
	check(made.load("%s/%s.obj" % [examples, place]) == "", "the scene is read")
	var body = FtBody.new()
	check(body.load("%s/%s.avatar.json" % [examples, who]), "the avatar is read")
	var frames: int = body.load_clip("%s/%s.bvh" % [examples, who])
	check(frames > 100, "the clip is read")
	check(body.make_solid(made, 2e-3) if is_solid else body.use_scene(made, 1e-3), "made: " + body.error())
	var file := File.new()
	check(file.open(path, File.WRITE) == OK, "can write")
	for frame in frames:
		if is_solid:
			body.follow_clip(frame, 1.0 / 64)
			file.store_buffer(body.tick_bytes())
		else:
			body.step_clip(frame)
			file.store_buffer(body.step_bytes())
	file.close()


func _write_own(path: String) -> void:
	var random := RandomNumberGenerator.new()
	random.seed = 1
	var file := File.new()
	check(file.open(path, File.WRITE) == OK, "can write")
	var made = FtScene.new()
	file.store_32(40)
	for i in 40:
		var mesh: Mesh = SphereMesh.new() if i % 2 == 0 else CubeMesh.new()
		var faces: PoolVector3Array = mesh.get_faces()
		var place := Transform(_turn(random, PI).scaled(Vector3(0.1, 0.2, 0.3)), _vector(random, 2.5))
		check(made.add_mesh(faces, place, "mesh") == "", "a mesh of any scale")
		file.store_32(faces.size())
		for corner in faces:
			_store_vector(file, corner)
		_store_place(file, place)
	check(made.build() == "", "the scene is built")
	_write_steps(file, made, random)
	file.close()


func _write_steps(file: File, made, random: RandomNumberGenerator) -> void:
	var tracked := _skeleton(random, 1.25)
	var shown := _skeleton(random, 0.75)
	var body = FtBody.new()
	file.store_32(BONES)
	for bone in BONES:
		var a := _vector(random, 0.1)
		var b := _vector(random, 0.1)
		var radius := random.randf_range(0.01, 0.05)
		body.add_joint("bone%d" % bone, tracked.get_bone_parent(bone), bone)
		check(body.add_capsule(bone, a, b, radius), "a capsule")
		file.store_32(tracked.get_bone_parent(bone))
		_store_vector(file, a)
		_store_vector(file, b)
		file.store_double(radius)
	_store_bones(file, tracked)
	check(body.build(tracked) and body.use_scene(made, 1e-3) and body.make_solid(made, 2e-3), "made: " + body.error())
	# The rest pose, which solid bodies look at: that of its making, and so of a step at once.
	check(body.step(tracked) == 0, "begins")
	file.store_buffer(body.step_bytes().subarray(0, 7 * 8 * BONES - 1))
	body.restart()
	file.store_32(STEPS)
	for step in STEPS:
		var at := _vector(random, 2.0)
		tracked.transform = Transform(_turn(random, PI).scaled(1.25 * Vector3(1, 1, 1)), at) if step % 8 == 0 else tracked.transform
		tracked.translation += _vector(random, 0.05)
		for bone in BONES:
			tracked.set_bone_pose(bone, Transform(_turn(random, 0.3), Vector3()))
		check(body.step(tracked) >= 0, "a step")
		var contacts: PoolByteArray = body.step_bytes()
		check(body.follow(tracked, 1.0 / 64) >= 0 and body.show(shown), "a tick")
		var tick: PoolByteArray = body.tick_bytes()
		_store_bones(file, tracked)
		file.store_buffer(contacts)
		file.store_32(tick.size())
		file.store_buffer(tick)
		_store_bones(file, shown)


func _skeleton(random: RandomNumberGenerator, scale: float) -> Skeleton:
	var node := Skeleton.new()
	for bone in BONES:
		node.add_bone("bone%d" % bone)
		node.set_bone_parent(bone, -1 if bone == 0 else (bone - 1) / 2)
		node.set_bone_rest(bone, Transform(_turn(random, 1.0), _vector(random, 0.2)))
	root.add_child(node)
	node.scale = scale * Vector3(1, 1, 1)
	return node


func _vector(random: RandomNumberGenerator, most: float) -> Vector3:
	return Vector3(random.randf_range(-most, most), random.randf_range(-most, most), random.randf_range(-most, most))


func _turn(random: RandomNumberGenerator, most: float) -> Basis:
	return Basis(_vector(random, 1).normalized(), random.randf_range(-most, most))


func _store_vector(file: File, v: Vector3) -> void:
	file.store_float(v.x)
	file.store_float(v.y)
	file.store_float(v.z)


# Row by row, then the origin.
func _store_place(file: File, place: Transform) -> void:
	for row in 3:
		_store_vector(file, Vector3(place.basis.x[row], place.basis.y[row], place.basis.z[row]))
	_store_vector(file, place.origin)


func _store_bones(file: File, node: Skeleton) -> void:
	_store_place(file, node.global_transform)
	for bone in BONES:
		_store_place(file, node.get_bone_global_pose(bone))
