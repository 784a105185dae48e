# ForetouchScene: what bodies and hands touch: the meshes of a group, where they stand when this node enters
# the tree. What moves later is not seen: rebuild() takes them anew.
extends Spatial
class_name ForetouchScene

const FtScene = preload("ft_scene.gdns")

# Every MeshInstance in this group, and below a node in it, is an object of the scene.
export var group := "foretouch"

var version := 0  # counts up with each rebuild()
var problem := ""  # "" where all is well
var handle = null  # FtScene; null: something is wrong
var _nodes := []  # weak references, one per object


func _enter_tree() -> void:
	call_deferred("_build_once")  # when the whole scene is in the tree


func _build_once() -> void:
	if handle == null and problem == "" and is_inside_tree():
		rebuild()


# Takes all meshes as they stand now; hands go on from where they are shown, bodies begin anew.
func rebuild() -> bool:
	var made = FtScene.new()
	var nodes := []
	for node in get_tree().get_nodes_in_group(group):
		_add(made, node, nodes)
	problem = made.build() if not nodes.empty() else "the group '%s' has no MeshInstance with triangles: add your level's meshes to it" % group
	if problem != "":
		push_error("ForetouchScene '%s': %s" % [name, problem])
		return false
	handle = made
	_nodes = nodes
	version += 1
	return true


# The handle, built if need be, for the node that needs it first.
func built():
	_build_once()
	return handle


# The MeshInstance of an object; null: it was freed since.
func node_of(object: int):
	return _nodes[object].get_ref() if object >= 0 and object < _nodes.size() else null


func _add(made, node: Node, nodes: Array) -> void:
	if node is MeshInstance:
		_add_mesh(made, node, nodes)
	elif node is CSGShape or node is MultiMeshInstance or node is GridMap or node is CollisionShape:
		push_warning("ForetouchScene '%s': '%s' is a %s: nothing touches it, make a MeshInstance of it" % [name, node.name, node.get_class()])
	for child in node.get_children():
		if not child.is_in_group(group):  # those are added themselves
			_add(made, child, nodes)


func _add_mesh(made, node: MeshInstance, nodes: Array) -> void:
	if node.mesh == null:
		push_warning("ForetouchScene '%s': '%s' has no mesh: nothing touches it" % [name, node.name])
		return
	var wrong: String = made.add_mesh(node.mesh.get_faces(), node.global_transform, node.name)
	if wrong == "":
		nodes.append(weakref(node))
	else:
		push_warning("ForetouchScene '%s': %s" % [name, wrong])
