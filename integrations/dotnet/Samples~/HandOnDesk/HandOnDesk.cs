// HandOnDesk.cs: a hand is led into a desk and along it, as a tracker would, and the shown hand stays on it.
// Add this to an empty object of an empty scene and press Play: the red ball is where the hand is tracked, the
// white one is shown.
using Foretouch;
using UnityEngine;

public sealed class HandOnDesk : MonoBehaviour {
  Transform tracked;
  SolidHand hand;
  float time;

  /// <summary>Metres between the tracked and the shown place, to look at.</summary>
  public double deviation;

  void Awake() {
    var level = new GameObject("Level");
    GameObject desk = GameObject.CreatePrimitive(PrimitiveType.Cube);
    desk.name = "Desk";
    desk.transform.SetParent(level.transform, false);
    desk.transform.localScale = new Vector3(1.6f, 0.04f, 0.8f);  // its top is at y = 0.02
    var scene = level.AddComponent<ForetouchScene>();

    GameObject ball = GameObject.CreatePrimitive(PrimitiveType.Sphere);
    ball.name = "Tracked hand";
    ball.transform.localScale = new Vector3(0.1f, 0.1f, 0.1f);  // its collider has the radius 0.5
    tracked = ball.transform;
    tracked.localPosition = At(0);
    var body = ball.AddComponent<ForetouchBody>();

    GameObject shown = GameObject.CreatePrimitive(PrimitiveType.Sphere);
    shown.name = "Shown hand";
    shown.transform.localScale = ball.transform.localScale;
    hand = shown.AddComponent<SolidHand>();
    hand.scene = scene;
    hand.tracked = body;
    hand.shown = new[] { shown.transform };
  }

  // Down into the desk, along it and up again, every four seconds.
  static Vector3 At(float t) {
    float phase = t % 4 / 4;
    return new Vector3(phase - 0.5f, 0.3f - 0.5f * Mathf.Sin(Mathf.PI * phase), 0);
  }

  void FixedUpdate() {
    time += Time.fixedDeltaTime;
    tracked.localPosition = At(time);
    deviation = hand.Tick.deviation;
  }
}
