# Hands led at a board of 4 mm, at up to 10 m/s, turning, at 60 frames per second: how many end behind it, and how
# many have a finger through it, by ForetouchBody.rotate_and_collide() and by KinematicBody.move_and_collide(). The
# judge is closed form: the two ends of the capsule's axis, where it was left in each frame.
extends "check.gd"

const DELTA := 1.0 / 60
const HALF := 0.04  # of the capsule's axis
const RADIUS := 0.01

var _behind := {}
var _through := {}


func _init() -> void:
	call_deferred("_run")


func _run() -> void:
	box("Board", Vector3(0.004, 4, 4), Vector3())
	var solid := StaticBody.new()
	var shape := CollisionShape.new()
	shape.shape = BoxShape.new()
	shape.shape.extents = Vector3(0.002, 2, 2)
	solid.add_child(shape)
	root.add_child(solid)
	scene()
	var hand := ball(RADIUS, 2 * HALF)
	var body = ForetouchBody.new()
	hand.add_child(body)
	yield(frames(3), "completed")
	check(body.problem == "", body.problem)
	body.set_physics_process(false)
	var count := int(OS.get_environment("FORETOUCH_HANDS"))
	var random := RandomNumberGenerator.new()
	for i in count:
		random.seed = i
		var speed := random.randf_range(0.5, 10)
		var aim := Vector3(random.randf_range(0.5, 1), random.randf_range(-1, 1), random.randf_range(-1, 1)).normalized()
		var axis := Vector3(random.randf_range(-1, 1), random.randf_range(-1, 1), random.randf_range(-1, 1)).normalized()
		var turn := Basis(axis, random.randf_range(-20, 20) * DELTA)
		# It begins in front of the board, at a share of its frame that differs from hand to hand.
		var begin := Transform(Basis(axis, random.randf_range(-PI, PI)), -aim * (0.12 + speed * DELTA * random.randf()) / aim.x)
		var steps := int(ceil((0.24 / aim.x + speed * DELTA) / (speed * DELTA)))
		for way in ["Foretouch", "move_and_collide"]:
			_lead(way, hand, body, begin, turn, aim * speed * DELTA, steps)
		if i % 100 == 99:
			yield(self, "physics_frame")  # nothing of the test needs it, but a server wants to breathe
	print("%d hands, %s: behind the board %d by Foretouch, %d by move_and_collide(); a finger through it %d and %d" % [count,
			ProjectSettings.get_setting("physics/3d/physics_engine"), _behind.get("Foretouch", 0), _behind.get("move_and_collide", 0),
			_through.get("Foretouch", 0), _through.get("move_and_collide", 0)])
	check(_behind.get("Foretouch", 0) == 0 and _through.get("Foretouch", 0) == 0, "none by Foretouch")
	finish()


# The hand is where the tracker was as far as each way lets it come; the tracker goes through the board.
func _lead(way: String, hand: KinematicBody, body, begin: Transform, turn: Basis, motion: Vector3, steps: int) -> void:
	var place := begin
	var tracked := begin
	var is_through := false
	for _step in steps:
		tracked = Transform((turn * tracked.basis).orthonormalized(), tracked.origin + motion)
		if way == "Foretouch":
			if body.rotate_and_collide(place, tracked) == null:
				place = tracked  # else it stays where it was proven free
		else:
			hand.global_transform = Transform(tracked.basis, place.origin)
			var _collision := hand.move_and_collide(tracked.origin - place.origin)
			place = hand.global_transform
		is_through = is_through or _is_through(place)
	if place.origin.x > 0:
		_behind[way] = _behind.get(way, 0) + 1
	if is_through:
		_through[way] = _through.get(way, 0) + 1


# The capsule's axis is along the node's x.
func _is_through(place: Transform) -> bool:
	return place.origin.x + HALF * abs(place.basis.x.x) > 0
