# A tracked hand (here, a path) reaches through a railing, presses a button and pushes a door; the shown hand
# passes through none of them. This script moves what the hand pushes, and reports it to the scene.
extends Spatial

# Where the tracker is, and when.
const PATH := [
	[0.0, Vector3(0.05, 0, 0)], [0.5, Vector3(0.05, 0, -0.55)], [1.0, Vector3(0.3, 0, -0.55)], [1.5, Vector3(0.05, 0, -0.55)],
	[2.0, Vector3(0.05, 0, 0)], [2.5, Vector3(0.65, 0, 0)], [3.0, Vector3(0.65, 0, -0.45)], [3.5, Vector3(0.65, 0, 0)],
	[4.0, Vector3(1.4, 0, 0)], [5.0, Vector3(1.4, 0, -0.75)], [5.5, Vector3(1.4, 0, 0)], [6.0, Vector3(1.4, 0, 0)]
]
const BUTTON_TRAVEL := 0.02

var _seconds := 0.0
var _furthest := 0.0
var _is_pressed := false
onready var _button := $Level/Button
onready var _button_begin: float = $Level/Button.translation.z


func _ready() -> void:
	$ForetouchHand.connect("touched", self, "_on_touched")
	$ForetouchHand.connect("released", self, "_on_released")
	$ForetouchHand.connect("push", self, "_on_push")


func _physics_process(delta: float) -> void:
	_seconds += delta
	for i in PATH.size() - 1:
		if _seconds >= PATH[i][0] and _seconds < PATH[i + 1][0]:
			var share: float = (_seconds - PATH[i][0]) / (PATH[i + 1][0] - PATH[i][0])
			$Tracked.translation = PATH[i][1].linear_interpolate(PATH[i + 1][1], share)
	_furthest = max(_furthest, $ForetouchHand.deviation)
	if _seconds > PATH[-1][0]:
		print("the door is open by %d degrees; the tracker was up to %d cm away" % [$Level/Hinge.rotation_degrees.y, 100 * _furthest])
		set_physics_process(false)
		if OS.has_feature("Server"):
			get_tree().quit()


func _on_touched(_joint: String, object: String) -> void:
	print("%.2f s: touches %s" % [_seconds, object])


func _on_released(_joint: String, object: String) -> void:
	print("%.2f s: leaves %s" % [_seconds, object])


# What gives way moves by what the hand presses, and not faster than 1 cm per frame.
func _on_push(_joint: String, object: String, point: Vector3, _normal: Vector3, push: float) -> void:
	var way := min(push, 0.01)
	if object == "Button" and not _is_pressed:
		_button.translation.z = max(_button.translation.z - way, _button_begin - BUTTON_TRAVEL)
		_is_pressed = is_equal_approx(_button.translation.z, _button_begin - BUTTON_TRAVEL)
		if _is_pressed:
			print("%.2f s: the button is pressed" % _seconds)
	elif object == "Door":
		$Level/Hinge.rotation.y += way / max(0.1, point.distance_to($Level/Hinge.translation))
	else:
		return
	$ForetouchScene.rebuild()
