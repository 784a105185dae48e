# What `foretouch avatar colliders --godot 3` wrote of the bundled avatar, as Godot reads it, beside the avatar file.
#   godot3-server --path . -s colliders.gd   with dancer.tscn in the project and FORETOUCH_EXAMPLES in the environment
extends "check.gd"


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	box("Far", Vector3(1, 1, 1), Vector3(0, -40, 0))
	var file := File.new()
	check(file.open(OS.get_environment("FORETOUCH_EXAMPLES") + "/dancer.avatar.json", File.READ) == OK, "the avatar")
	var avatar: Dictionary = JSON.parse(file.get_as_text()).result
	var made: Spatial = load("res://dancer.tscn").instance()
	root.add_child(made)
	var skeleton: Skeleton = made.get_node("Skeleton")
	var level = scene()
	var body = ForetouchBody.new()
	skeleton.add_child(body)
	yield(frames(2), "completed")
	check(skeleton.get_bone_count() == avatar.links.size(), "as many bones as links")
	var count := 0
	for i in avatar.links.size():
		var link: Dictionary = avatar.links[i]
		check(skeleton.get_bone_name(i) == link.name, "a bone called " + link.name)
		var parent := skeleton.get_bone_parent(i)
		check((link.parent == null) == (parent < 0) and (parent < 0 or skeleton.get_bone_name(parent) == link.parent), "its parent")
		check(skeleton.get_bone_rest(i).origin.distance_to(_vector(link.offset)) < 1e-6, "its rest")
		count += _check_shapes(skeleton, link, skeleton.get_bone_global_pose(i))
	check(count > 20, "many shapes")
	check(level.version == 1 and body.body.capsule_count() == count, "a ForetouchBody has all of them: %d" % body.body.capsule_count())
	finish()


func _vector(numbers: Array) -> Vector3:
	return Vector3(numbers[0], numbers[1], numbers[2])


func _check_shapes(skeleton: Skeleton, link: Dictionary, pose: Transform) -> int:
	if link.lss.empty():
		return 0
	var attachment: BoneAttachment = skeleton.get_node(link.name)
	check(attachment.bone_name == link.name and attachment.transform.origin.distance_to(pose.origin) < 1e-5, "it follows its bone")
	var shapes := attachment.get_node("Body").get_children()
	check(shapes.size() == link.lss.size(), "as many shapes as LSS of " + link.name)
	for i in shapes.size():
		var shape: Shape = shapes[i].shape
		var half := Vector3(0, 0, 0.5 * shape.height) if shape is CapsuleShape else Vector3()
		var ends := [shapes[i].transform * -half, shapes[i].transform * half]
		for end in ["a", "b"]:
			# Vectors here are floats: what the file's numbers hold to the last digit, tests of the program judge.
			var off: float = Geometry.get_closest_point_to_segment(_vector(link.lss[i][end]), ends[0], ends[1]).distance_to(_vector(link.lss[i][end]))
			check(off + link.lss[i].radius <= shape.radius + 2e-7, "%s %d holds its LSS" % [link.name, i])
		check(shape.radius - link.lss[i].radius < 1e-6, "and is no thicker than floats need")
	return shapes.size()
