# Capsules of a Skeleton's bones, or of one node: from its CollisionShapes, or as thick as the user says.
# Each function returns "" or what is wrong.
extends Reference


static func fill(body, node: Spatial, radius: float) -> String:
	body.clear()
	if node is Skeleton:
		return _fill_bones(body, node, radius)
	body.add_joint(node.name, -1, -1)
	var wrong := _add_shapes(body, node, 0, Transform())
	if wrong != "" or body.capsule_count() > 0:
		return wrong
	if radius > 0:
		body.add_capsule(0, Vector3(), Vector3(), radius)
		return ""
	return "'%s' has no CollisionShape with a capsule or a sphere below it: add one, or set `radius`" % node.name


static func _fill_bones(body, skeleton: Skeleton, radius: float) -> String:
	var joint_of := {-1: -1}
	while joint_of.size() <= skeleton.get_bone_count():  # parents first, however they are numbered
		var before := joint_of.size()
		for bone in skeleton.get_bone_count():
			if not joint_of.has(bone) and joint_of.has(skeleton.get_bone_parent(bone)):
				joint_of[bone] = body.add_joint(skeleton.get_bone_name(bone), joint_of[skeleton.get_bone_parent(bone)], bone)
		if joint_of.size() == before:
			return "the bones of '%s' are their own parents" % skeleton.name
	for child in skeleton.get_children():
		var bone := -1
		var place := Transform()
		if child is PhysicalBone:
			bone = child.get_bone_id()
			place = child.body_offset
		elif child is BoneAttachment:
			bone = skeleton.find_bone(child.bone_name)
		if bone >= 0:
			var wrong := _add_shapes(body, child, joint_of[bone], place)
			if wrong != "":
				return wrong
	if body.capsule_count() > 0:
		return ""
	if radius <= 0:
		return ("the Skeleton '%s' has no capsules: choose Skeleton > Create physical skeleton, or hang CollisionShapes on " +
				"BoneAttachments, or set `radius` to make one along every bone") % skeleton.name
	_add_bones(body, skeleton, joint_of, radius)
	return ""


# From each bone to those below it; around the last of a chain, a sphere.
static func _add_bones(body, skeleton: Skeleton, joint_of: Dictionary, radius: float) -> void:
	var has_child := {}
	for bone in skeleton.get_bone_count():
		var parent := skeleton.get_bone_parent(bone)
		if parent >= 0:
			has_child[parent] = true
			body.add_capsule(joint_of[parent], Vector3(), skeleton.get_bone_rest(bone).origin, radius)
	for bone in skeleton.get_bone_count():
		if not has_child.has(bone):
			body.add_capsule(joint_of[bone], Vector3(), Vector3(), radius)


static func _add_shapes(body, node: Node, joint: int, place: Transform) -> String:
	for child in node.get_children():
		var at: Transform = place * child.transform if child is Spatial else place
		var wrong := ""
		if child is CollisionShape and not child.disabled and child.shape != null:
			wrong = _add_shape(body, child, joint, at)
		if wrong == "":
			wrong = _add_shapes(body, child, joint, at)
		if wrong != "":
			return wrong
	return ""


static func _add_shape(body, node: CollisionShape, joint: int, place: Transform) -> String:
	var shape := node.shape
	if not (shape is CapsuleShape or shape is SphereShape):
		return "'%s' is a %s: a body is made of CapsuleShapes and SphereShapes" % [node.name, shape.get_class()]
	var scale := place.basis.get_scale().abs()
	if abs(scale.x - scale.y) > 1e-3 * scale.x or abs(scale.x - scale.z) > 1e-3 * scale.x:
		return "'%s' has the scale %s: a capsule needs one scale along all axes; change its radius and height instead" % [node.name, scale]
	var half := Vector3(0, 0, 0.5 * shape.height) if shape is CapsuleShape else Vector3()
	if body.add_capsule(joint, place * -half, place * half, scale.x * shape.radius):
		return ""
	return body.error()
