# The demo, as it goes: a line per physics frame of where the tracker is, where the hand is shown, how far the door is
# open (degrees) and where the button's front is. For the picture of docs/integrations.md.
#   godot3-server --path . --fixed-fps 60 -s film.gd   in the demo's folder
extends SceneTree

var _demo: Spatial


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	_demo = load("res://main.tscn").instance()
	root.add_child(_demo)
	while true:
		yield(self, "physics_frame")
		var tracked: Vector3 = _demo.get_node("Tracked").translation
		var shown: Vector3 = _demo.get_node("Shown").translation
		print("film: %f %f %f %f %f %f" % [tracked.x, tracked.z, shown.x, shown.z, _demo.get_node("Level/Hinge").rotation_degrees.y,
				_demo.get_node("Level/Button").translation.z])
