# The nodes: what they report, and what they say about a host's bad habits. The script beside this one holds the
# errors that Godot prints against the words after "expect:".
extends "check.gd"

var _told := []


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	box("Board", Vector3(0.004, 2, 2), Vector3(0.5, 0, 0))
	box("Far", Vector3(1, 1, 1), Vector3(0, -40, 0))
	var level = scene()
	yield(frames(1), "completed")
	check(level.version == 1 and level.handle.triangle_count() == 24, "the scene has both boxes")
	yield(_bodies(), "completed")
	yield(_hands(level), "completed")
	yield(_bad_scenes(), "completed")
	yield(_bad_bodies(level), "completed")
	yield(_freed(), "completed")
	finish()


func _tell(touch) -> void:
	_told.append(touch)


func _body_of(node: Spatial, radius := 0.0):
	var body = ForetouchBody.new()
	body.radius = radius
	node.add_child(body)
	body.connect("touched", self, "_tell")
	return body


func _bodies():
	var node := ball(0.02)
	var body = _body_of(node)
	_told = []
	yield(frames(2), "completed")
	check(_told.empty(), "still, and touches nothing")
	node.translation = Vector3(1, 0.1, 0)
	yield(frames(2), "completed")
	check(_told.size() == 1 and _told[0].object == "Board" and _told[0].node.name == "Board", "one touch of the board")
	check(abs(_told[0].share - 0.478) < 1.1e-3 and _told[0].share < 0.478, "never late, at most the tolerance early")
	check(_told[0].normal.is_equal_approx(Vector3(-1, 0, 0)) and not _told[0].starts_inside, "its normal")
	check(body.rotate_and_collide(Transform(), Transform(Basis(), Vector3(0.4, 0, 0))) == null, "the way to 0.4 m is free")
	node.translation = Vector3()
	yield(frames(1), "completed")
	_told = []
	node.translation = Vector3(1, 0, 0)
	check(body.rotate_and_collide(Transform(), Transform()) == null, "asked in between")
	yield(frames(1), "completed")
	check(_told.size() == 1 and abs(_told[0].share - 0.478) < 1.1e-3, "which hides no touch of a step")
	body.restart()
	_told = []
	node.translation = Vector3(0.5, 0, 0)
	yield(frames(1), "completed")
	check(_told.empty(), "restart() sweeps through nothing")
	node.translation = Vector3(0.502, 0, 0)
	yield(frames(1), "completed")
	check(_told.size() == 1 and _told[0].starts_inside and _told[0].share == 0, "it starts inside")
	node.free()

	# A capsule that turns: neither its begin nor its end touches the board.
	var turning := ball(0.02, 0.8)
	body = _body_of(turning)
	yield(frames(1), "completed")
	var up := Transform(Basis(Vector3(0, 0, 1), PI / 2), Vector3(0.2, 0, 0))
	var down := Transform(Basis(Vector3(0, 0, 1), -PI / 2), Vector3(0.2, 0, 0))
	var touch = body.rotate_and_collide(up, Transform(Basis(Vector3(0, 0, 1), -PI / 2 + 0.01), Vector3(0.2, 0, 0)))
	check(touch != null and touch.joint == turning.name and touch.object == "Board", "rotate_and_collide() finds the board in the turn")
	# The tip, 0.4 m out and 0.02 m thick, meets x = 0.498 when cos(angle) = (0.298 - 0.02) / 0.4.
	var angle := acos((0.298 - 0.02) / 0.4)
	var expected := (PI / 2 - angle) / (PI - 0.01)
	check(touch.share <= expected and touch.share > expected - 0.003, "at the angle of the closed form")
	check(abs(touch.place.basis.get_euler().z - angle) < 0.01 and touch.place.origin.is_equal_approx(up.origin), "and where the node is then")
	check(body.rotate_and_collide(up, up) == null and body.problem == "", "no motion, no touch")
	turning.free()

	# A skeleton: the tip of its middle bone comes down on the board's side as its root turns.
	var bones := arm()
	body = _body_of(bones, 0.01)
	bones.translation = Vector3(0, 0, -5)
	yield(frames(2), "completed")
	check(body.problem == "" and body.body.capsule_count() == 4, "capsules along three bones, and a tip")
	_told = []
	bones.translation = Vector3(0.45, 0, 0)
	yield(frames(1), "completed")
	check(_told.size() >= 1 and _told[0].joint == "bone0", "its first bone meets the board")
	bones.free()

	# CollisionShapes on a BoneAttachment.
	bones = arm()
	var attachment := BoneAttachment.new()
	attachment.bone_name = "bone3"
	bones.add_child(attachment)
	var tip := ball(0.03)
	root.remove_child(tip)
	attachment.add_child(tip)
	body = _body_of(bones)
	yield(frames(1), "completed")
	check(body.problem == "" and body.body.capsule_count() == 1, "one capsule, of the attachment")
	touch = body.rotate_and_collide(Transform(Basis(), Vector3(-0.9, 0, 0)), Transform(Basis(), Vector3(0.1, 0, 0)))
	check(touch != null and touch.joint == "bone3" and abs(touch.share - 0.468) < 1.1e-3, "it is where the bone is")
	bones.free()


func _hands(level):
	var tracked := ball(0.02)
	var shown := Spatial.new()
	root.add_child(shown)
	var hand = ForetouchHand.new()
	hand.tracked = tracked.get_path()
	hand.shown = shown.get_path()
	root.add_child(hand)
	for name in ["touched", "released", "push"]:
		hand.connect(name, self, "_tell_hand", [name])
	yield(frames(2), "completed")
	check(hand.state == ForetouchHand.EQUAL and hand.is_certified, "shown as tracked")
	_told = []
	tracked.translation = Vector3(0.6, 0, 0)
	yield(frames(30), "completed")
	check(shown.translation.x < 0.478 and shown.translation.x > 0.47, "it stays before the board")
	check(_told[0][-1] == "touched" and _told[0][1] == "Board", "touched, once")
	check(_count("touched") == 1 and _count("push") > 10 and _count("released") == 0, "push each frame")
	check(abs(_told[-1][4] - (0.6 - shown.translation.x)) < 5e-3, "push is how far it is beyond")
	tracked.translation = Vector3(0.6, 0.3, 0)
	yield(frames(30), "completed")
	check(abs(shown.translation.y - 0.3) < 2e-3 and shown.translation.x < 0.478, "it slides along the board")
	tracked.translation = Vector3()
	yield(frames(60), "completed")
	check(_count("released") == 1 and shown.translation == Vector3(), "released, and back at the tracked place")
	tracked.translation = Vector3(0.6, 0, 0)
	yield(frames(10), "completed")
	var board := root.get_node("Board")
	board.translation.x = 2.5
	level.rebuild()
	yield(frames(60), "completed")
	check(shown.translation == Vector3(0.6, 0, 0), "the board was moved away, and rebuild() said so")
	board.translation.x = 0.5
	level.rebuild()
	hand.free()
	tracked.free()
	shown.free()

	# Two skeletons, scaled by two, whose first bone turns into the board.
	var moves := arm()
	var shows := arm()
	moves.scale = Vector3(2, 2, 2)
	moves.translation = Vector3(-1.5, 0, 0)
	shows.translation = Vector3(0.3, 0.2, 0)
	hand = ForetouchHand.new()
	hand.radius = 0.01
	hand.tracked = moves.get_path()
	hand.shown = shows.get_path()
	root.add_child(hand)
	yield(frames(2), "completed")
	check(hand.problem == "" and _apart(moves, shows) < 1e-5, "bones are shown where they are tracked, whatever the nodes' scales")
	moves.translation = Vector3(-1, 0, 0)  # its tip, at 1.8, is to be at 0.8
	yield(frames(30), "completed")
	var x := (shows.global_transform * shows.get_bone_global_pose(3)).origin.x
	check(x < 0.478 and x > 0.46 and _apart(moves, shows) > 0.3, "the tip of a scaled skeleton stays before the board")
	hand.free()
	moves.free()
	shows.free()


func _apart(a: Skeleton, b: Skeleton) -> float:
	var most := 0.0
	for i in a.get_bone_count():
		var place := a.global_transform * a.get_bone_global_pose(i)
		var other := b.global_transform * b.get_bone_global_pose(i)
		most = max(most, (place.origin - other.origin).length())
		most = max(most, (place.basis.get_rotation_quat() - other.basis.get_rotation_quat()).length())
	return most


func _tell_hand(joint, object, a = null, b = null, c = null, d = null) -> void:
	var list := [joint, object, a, b, c, d]
	while list[-1] == null:
		list.pop_back()
	_told.append(list)


func _count(name: String) -> int:
	var count := 0
	for one in _told:
		if one[-1] == name:
			count += 1
	return count


func _bad_scenes():
	print("expect: the group 'nobody' has no MeshInstance with triangles")
	var level = scene("nobody")
	yield(frames(1), "completed")
	check(level.handle == null and "nobody" in level.problem, "an empty group")
	level.free()
	var node := box("Good", Vector3(1, 1, 1), Vector3(), "some")
	var empty := box("NoSurface", Vector3(1, 1, 1), Vector3(), "some")
	empty.mesh = ArrayMesh.new()
	var none := box("NoMesh", Vector3(1, 1, 1), Vector3(), "some")
	none.mesh = null
	var csg := CSGBox.new()
	csg.name = "Csg"
	csg.add_to_group("some")
	root.add_child(csg)
	print("expect: 'NoSurface' has no triangles")
	print("expect: 'NoMesh' has no mesh")
	print("expect: 'Csg' is a CSGBox")
	level = scene("some")
	yield(frames(1), "completed")
	check(level.problem == "" and level.handle.triangle_count() == 12, "what has triangles is taken")
	for each in [level, node, empty, none, csg]:
		each.free()


func _said(body, words: String) -> void:
	check(words in body.problem, "'%s' is said, found: '%s'" % [words, body.problem])


func _bad_bodies(level):
	var node := ball(0.02)
	node.scale = Vector3(1, 2, 1)
	print("expect: has the scale (1, 2, 1) in the world")
	var body = _body_of(node)
	yield(frames(1), "completed")
	_said(body, "capsules need one scale above zero along all axes")
	node.scale = Vector3(1, 1, 1)
	check(body.rebuild(), "mended, and rebuild()")
	node.scale = Vector3(3, 3, 3)
	print("expect: changed from 1 to 3 at run time")
	yield(frames(2), "completed")
	_said(body, "Call rebuild()")
	var unknown = body.rotate_and_collide(Transform(), Transform()) if body.rebuild() else null
	check(unknown != null and unknown.undecided and unknown.share == 0, "of a sweep of another scale nothing is known")
	_said(body, "changed from 3 to 1")
	node.free()

	print("expect: has no CollisionShape with a capsule or a sphere")
	node = ball(0.02)
	node.get_child(0).free()
	body = _body_of(node)
	yield(frames(1), "completed")
	_said(body, "set `radius`")
	node.free()

	print("expect: is a BoxShape")
	node = ball(0.02)
	node.get_child(0).shape = BoxShape.new()
	body = _body_of(node)
	yield(frames(1), "completed")
	_said(body, "BoxShape")
	node.free()

	print("expect: has no capsules: choose Skeleton > Create physical skeleton")
	var bones := arm()
	body = _body_of(bones)
	yield(frames(1), "completed")
	_said(body, "or set `radius`")
	body.radius = 0.01
	check(body.rebuild(), "then with a radius")
	print("expect: the Skeleton has 5 bones, and had 4")
	bones.add_bone("late")
	yield(frames(2), "completed")
	_said(body, "call rebuild() after a change")
	check(body.rebuild(), "and the fifth bone is taken")
	print("expect: the Skeleton has 0 bones, and had 5")
	bones.clear_bones()
	yield(frames(2), "completed")
	_said(body, "has 0 bones")
	bones.free()

	print("expect: bone 'bone1' has the scale (1, 1, 3)")
	bones = arm()
	bones.set_bone_pose(1, Transform(Basis().scaled(Vector3(1, 1, 3)), Vector3()))
	body = _body_of(bones, 0.01)
	yield(frames(1), "completed")
	_said(body, "bone 'bone1'")
	bones.free()

	print("expect: has the scale (1, 1, 1) in the world, mirrored or skewed")
	node = ball(0.02)
	node.transform.basis = Basis(Vector3(-1, 0, 0), Vector3(0, 1, 0), Vector3(0, 0, 1))
	body = _body_of(node)
	yield(frames(1), "completed")
	_said(body, "mirrored")
	node.free()

	print("expect: `tracked` and `shown` must be two")
	node = ball(0.02)
	var hand = ForetouchHand.new()
	hand.tracked = node.get_path()
	hand.shown = node.get_path()
	root.add_child(hand)
	yield(frames(2), "completed")
	_said(hand, "two Spatials")
	hand.free()
	node.free()


func _freed():
	# What it follows, the scene, and itself, each freed by a listener in the middle of a step.
	for victim in ["node", "level", "body", "child"]:
		var level = scene()
		var holder := Spatial.new()
		root.add_child(holder)
		var node := ball(0.02)
		var body = ForetouchBody.new()
		body.skeleton = node.get_path()
		body.scene = level.get_path()
		holder.add_child(body)
		yield(frames(2), "completed")
		body.connect("touched", self, "_free_now", [{node = node, level = level, body = holder, child = node.get_child(0)}[victim]])
		node.translation = Vector3(1, 0, 0)
		if victim in ["node", "level"]:
			print("expect: ", "its Spatial is missing or was freed" if victim == "node" else "its ForetouchScene is missing or was freed")
		yield(frames(3), "completed")
		if victim == "body":
			check(not is_instance_valid(body), "freed, and nothing more is told")
		else:
			check((body.problem != "") == (victim != "child"), "%s was freed: '%s'" % [victim, body.problem])
		for each in [node, level, holder]:
			if is_instance_valid(each):
				each.free()


func _free_now(_touch, who) -> void:
	if is_instance_valid(who):
		if who.get_child_count() == 1 and who.get_child(0) is ForetouchBody:
			who.queue_free()  # Godot itself refuses free() of what emits
		else:
			who.free()
