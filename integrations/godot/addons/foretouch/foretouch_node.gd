# What ForetouchBody and ForetouchHand share: they build when they are first needed, say once what is wrong,
# in Godot's words, and stop; rebuild() tries again.
extends Spatial

const ForetouchScene := preload("foretouch_scene.gd")
const FtBody := preload("ft_body.gdns")
const Capsules := preload("capsules.gd")

# The ForetouchScene. Empty: the first one that is found in the tree.
export var scene: NodePath
# Radius of a capsule along every bone, in metres, for a skeleton that has no CollisionShapes. 0: it must have some.
export var radius := 0.0

var problem := ""  # "" where all is well
var body = null  # FtBody
var _scene = null
var _scene_version := -1


# Builds body and capsules anew: after a change of bones, scales or shapes, or when what was wrong is mended.
func rebuild() -> bool:
	problem = ""
	body = null
	_scene_version = -1
	_scene = get_node_or_null(scene) if not scene.is_empty() else _first_scene(get_tree().root)
	var node = _moved_node()
	var wrong := ""
	if node == null or not node is Spatial:
		wrong = _words_for_no_node()
	if wrong == "":
		body = FtBody.new()
		wrong = Capsules.fill(body, node, radius)
	if wrong == "" and not body.build(node):
		wrong = body.error()
	if wrong == "":
		wrong = _follow_scene()
	set_physics_process(wrong == "")
	return wrong == "" or _stop(wrong)


func _ready() -> void:
	set_physics_process(true)


# False: something is wrong, and it was said.
func _is_ready() -> bool:
	if problem != "":
		return false
	if body == null:
		return rebuild()
	var wrong := _follow_scene()
	return wrong == "" or _stop(wrong)


func _follow_scene() -> String:
	if not is_instance_valid(_scene) or not _scene is ForetouchScene:
		return "its ForetouchScene is missing or was freed: add one, and call rebuild()"
	var handle = _scene.built()
	if handle == null:
		return "its ForetouchScene '%s' has said what is wrong" % _scene.name
	if _scene_version == _scene.version:
		return ""
	_scene_version = _scene.version
	return "" if _use_scene(handle) else body.error()


func _stop(wrong: String) -> bool:
	problem = wrong
	set_physics_process(false)
	push_error("%s '%s': %s" % [_class(), name, wrong])
	return false


static func _first_scene(node: Node):
	if node is ForetouchScene:
		return node
	for child in node.get_children():
		var found = _first_scene(child)
		if found != null:
			return found
	return null


# A listener may free what reports to it.
func _is_going() -> bool:
	return is_queued_for_deletion() or not is_inside_tree()


func _object_name(object: int) -> String:
	return _scene.handle.object_name(object)


# ---- What a body and a hand say of themselves ----

func _moved_node():
	return null


func _use_scene(_handle) -> bool:
	return false


func _words_for_no_node() -> String:
	return ""


func _class() -> String:
	return ""
