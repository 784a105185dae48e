// Components.cs: the components in a player that FakeUnity.cs plays: what they report, beside the library's
// own answers in its own frame; and what they say about a host's bad habits.
using System;
using System.Collections.Generic;
using System.Linq;
using Foretouch;
using UnityEngine;

static class Components {
  // A wall across z = 1 m, for Unity, of 4 m by 4 m.
  static readonly Vector3[] WallVertices = {
    new Vector3(-2, -2, 1), new Vector3(2, -2, 1), new Vector3(2, 2, 1), new Vector3(-2, 2, 1)
  };
  static readonly int[] WallTriangles = { 0, 1, 2, 0, 2, 3 };

  static MeshFilter MeshAt(string name, Transform parent, Vector3[] vertices, int[] triangles) {
    var filter = new Transform(name, parent).AddComponent<MeshFilter>();
    filter.sharedMesh = new Mesh { vertices = vertices, triangles = triangles };
    return filter;
  }

  static ForetouchScene Wall() {
    var level = new Transform("Level", null);
    MeshAt("Wall", level, WallVertices, WallTriangles);
    var scene = level.AddComponent<ForetouchScene>();
    Player.Enable(scene);
    return scene;
  }

  static ForetouchBody Ball(string name, ForetouchScene scene, Transform parent = null) {
    var ball = new Transform(name, parent);
    ball.AddComponent<SphereCollider>().radius = 0.05f;
    var body = ball.AddComponent<ForetouchBody>();
    body.scene = scene;
    Player.Enable(body);
    return body;
  }

  static void Clear() {
    Debug.Errors.Clear();
    Debug.Warnings.Clear();
  }
  static string Said() { return string.Join(" / ", Debug.Errors.ToArray()); }
  static void NothingSaid(string where) { Check.Equal(Said(), "", where); }

  static List<BodyTouch> TouchesOf(ForetouchBody body) {
    var touches = new List<BodyTouch>();
    body.Touched += touches.Add;
    return touches;
  }

  /// The same ball and wall in the library's frame: z is negated.
  static FtContact Expected(double toX, double toZ, double radius) {
    var mirrored = WallVertices.SelectMany(v => new double[] { v.x, v.y, -(double)v.z }).ToArray();
    using (FtScene scene = FtScene.Create(mirrored, WallTriangles))
    using (FtAvatar avatar = FtAvatar.Create(new[] { "Ball" }, new[] { -1 }, new double[] { 0, 0, 0 }, new double[0],
                                             new[] { new FtLss(new FtVector(0, 0, -0.0), new FtVector(0, 0, -0.0), radius) }, new[] { 0 }))
    using (var query = FtQuery.Create(scene, avatar))
    using (FtPoseBuffer from = new FtPoseBuffer(1), to = new FtPoseBuffer(1)) {
      to.SetPosition(0, new FtVector(toX, 0, -toZ));
      query.Step(from, to);
      return query.Contacts()[0];
    }
  }

  static void ABodyTellsWhatTheLibrarySays() {
    ForetouchBody ball = Ball("Ball", Wall());
    List<BodyTouch> touches = TouchesOf(ball);
    Player.FixedUpdate(ball);
    ball.transform.localPosition = new Vector3(0.25f, 0, 1.5f);
    Player.FixedUpdate(ball);
    Check.Equal(touches.Count, 1, "touches");
    BodyTouch touch = touches[0];
    FtContact expected = Expected(0.25, 1.5, 0.05f);
    Check.Equal(BitConverter.DoubleToInt64Bits(touch.share), BitConverter.DoubleToInt64Bits(expected.toi), "share, bit by bit");
    Check.Equal(touch.jointName, "Ball", "joint");
    Check.Equal(touch.objectName, "Wall", "object");
    Check.Equal(touch.normal.z, -1f, "normal, towards the ball");
    Check.Equal(touch.point.z, 1f, "point, on the wall");
    Check.That(!touch.startsInContact && !touch.isUndecided, "a contact");
    NothingSaid("a body");
    ball.Restart();
    ball.transform.localPosition = new Vector3(0, 0, -1);
    Player.FixedUpdate(ball);
    Check.Equal(touches.Count, 1, "a teleport sweeps through nothing");
  }

  // Below a turned parent of scale 2, with something that is no joint in between.
  static void ScaleAndWhatLiesBetweenCount() {
    var rig = new Transform("Rig", null) { localScale = new Vector3(2, 2, 2), localRotation = new Quaternion(0, 1, 0, 0) };
    var root = new Transform("Root", rig);
    root.AddComponent<SphereCollider>().radius = 0.05f;
    var between = new Transform("Between", root) { localPosition = new Vector3(0, 0.25f, 0) };
    var tip = new Transform("Tip", between);
    var capsule = tip.AddComponent<CapsuleCollider>();
    capsule.radius = 0.025f;
    capsule.height = 0.2f;
    capsule.direction = 1;
    var body = rig.AddComponent<ForetouchBody>();
    body.scene = Wall();
    Player.Enable(body);
    List<BodyTouch> touches = TouchesOf(body);
    Player.FixedUpdate(body);
    root.localPosition = new Vector3(0, 0, -0.75f);  // turned and scaled: z = 1.5
    Player.FixedUpdate(body);
    Check.Equal(touches.Count, 2, "both joints touch");
    Check.Equal(touches.Select(t => t.jointName).OrderBy(n => n).Aggregate((a, b) => a + b), "RootTip", "names");
    double root10cm = touches.Single(t => t.jointName == "Root").share, tip5cm = touches.Single(t => t.jointName == "Tip").share;
    Check.That(Math.Abs(root10cm - 0.9 / 1.5) < 1e-3 && root10cm <= 0.9 / 1.5, "radius of 10 cm in the world: " + root10cm);
    Check.That(Math.Abs(tip5cm - 0.95 / 1.5) < 1e-3 && tip5cm <= 0.95 / 1.5, "radius of 5 cm in the world: " + tip5cm);
    Check.That(Math.Abs(touches.Single(t => t.jointName == "Tip").point.y - 0.5f) < 0.2f, "the capsule is at 0.5 m");
    NothingSaid("scales");
  }

  static void AHandStopsAndComesBack() {
    ForetouchScene scene = Wall();
    ForetouchBody tracked = Ball("Tracked", null);
    var hand = new Transform("Hand", null).AddComponent<SolidHand>();
    var shown = new Transform("Shown", null);
    hand.scene = scene;
    hand.tracked = tracked;
    hand.shown = new[] { shown };
    Player.Enable(hand);
    var presses = new List<HandPress>();
    hand.Pressed += presses.Add;
    float furthest = 0;
    for (int frame = 0; frame <= 100; ++frame) {
      tracked.transform.localPosition = new Vector3(0, 0, 1.2f * (1 - Math.Abs(frame / 50f - 1)));
      Player.FixedUpdate(tracked, hand);
      Check.Equal(hand.Tick.isCertified, 1, "proven");
      furthest = Math.Max(furthest, shown.localPosition.z);
    }
    Check.That(furthest > 0.94f && furthest < 0.95f, "it stops at the wall, not in it: " + furthest);
    Check.That(presses.Count > 0 && presses.All(p => p.objectName == "Wall" && p.normal.z == -1 && p.push > 0), "it presses");
    Check.Equal(hand.Tick.state, FtSolid.Equal, "it is back");
    NothingSaid("a hand");
    Player.Disable(hand);
  }

  // A door of another scale along each axis swings away from the wall through a ball that stands.
  static void EventsAreToldOnce() {
    ForetouchBody ball = Ball("Ball", null);
    ball.transform.localPosition = new Vector3(0, 0, 0.5f);
    MeshFilter door = MeshAt("Door", null, WallVertices, WallTriangles);
    door.transform.localScale = new Vector3(1, 0.5f, 2);  // its plane is at z = 2
    var events = new Transform("Events", null).AddComponent<TouchEvents>();
    events.still = Wall();
    events.bodies = new[] { ball };
    events.props = new[] { door };
    Player.Enable(events);
    var told = new List<TouchEvent>();
    events.Happened += told.Add;
    for (int frame = 0; frame <= 50; ++frame) {
      door.transform.localPosition = new Vector3(0, 0, -3f * frame / 50);
      Player.FixedUpdate(events);
    }
    NothingSaid("events");
    Check.Equal(string.Join(" ", told.Select(e => e.kind).ToArray()), FtEvent.Enter + " " + FtEvent.Leave, "enter and leave");
    Check.Equal(told[0].jointName, "Ball", "joint");
    Check.Equal(told[0].otherName, "Door", "prop");
    Check.Equal(told[0].otherBody, 1, "its number");
    // 3 m/s from z = 2: within 5 cm of z = 0.5 from 1.45 m on.
    Check.That(Math.Abs(told[0].time - 1.45 / 3) < 1e-3 && told[0].time <= 1.45 / 3, "when it enters: " + told[0].time);
    Check.That(Math.Abs(told[1].time - 1.55 / 3) < 2e-3 && told[1].time >= 1.55 / 3, "when it leaves: " + told[1].time);
    Check.That(Math.Abs(told[0].approachSpeed - 3) < 1e-3, "how fast: " + told[0].approachSpeed);
  }

  static void AReloadOfScriptsIsAGap() {
    ForetouchScene scene = Wall();
    ForetouchBody ball = Ball("Ball", scene);
    var events = new Transform("Events", null).AddComponent<TouchEvents>();
    events.still = scene;
    events.bodies = new[] { ball };
    Player.Enable(events);
    List<BodyTouch> touches = TouchesOf(ball);
    var told = new List<TouchEvent>();
    events.Happened += told.Add;
    Player.FixedUpdate(ball, events);
    Player.Reload(scene, ball, events);
    ball.transform.localPosition = new Vector3(0, 0, 2);
    Player.FixedUpdate(ball, events);
    Player.FixedUpdate(ball, events);
    Check.Equal(touches.Count + told.Count, 0, "what nobody saw is not swept through");
    ball.transform.localPosition = new Vector3(0, 0, 0);
    Player.FixedUpdate(ball, events);
    Check.Equal(touches.Count, 1, "and it goes on");
    Check.Equal(told.Count, 2, "and so do events");
    Player.Pause(ball, events);
    ball.transform.localPosition = new Vector3(0, 0, 2);
    Player.FixedUpdate(ball, events);
    ball.transform.localPosition = new Vector3(0, 0, 0);
    Player.Pause(ball, events);
    Player.FixedUpdate(ball, events);
    Check.Equal(touches.Count + told.Count, 3, "nor is what nobody saw while the program slept");
    scene.Rebuild();
    Player.FixedUpdate(ball, events);
    ball.transform.localPosition = new Vector3(0, 0, 2);
    Player.FixedUpdate(ball, events);
    Check.Equal(touches.Count, 2, "in a scene that was built anew");
    NothingSaid("a reload");
  }

  static void WhoIsToldMayDestroyWhatTells() {
    Clear();
    var rig = new Transform("Rig", null);
    foreach (string name in new[] { "Left", "Right" }) {
      var joint = new Transform(name, rig) { localPosition = new Vector3(name == "Left" ? -0.5f : 0.5f, 0, 0) };
      joint.AddComponent<SphereCollider>().radius = 0.05f;
    }
    ForetouchScene scene = Wall();
    var body = rig.AddComponent<ForetouchBody>();
    body.scene = scene;
    var events = rig.AddComponent<TouchEvents>();
    events.still = scene;
    events.bodies = new[] { body };
    int touches = 0, told = 0;
    body.Touched += touch => {
      if (++touches == 1) Player.Destroy(body);
      if (touches == 1) Player.Destroy(scene);
    };
    events.Happened += happened => {
      if (++told == 1) Player.Destroy(events);
    };
    Run(body);
    Run(events);
    rig.localPosition = new Vector3(0, 0, 2);
    Player.FixedUpdate(events, body);
    Check.Equal(touches + told, 2, "of two touches and four events, the first ones");
    NothingSaid("what is destroyed");
  }

  static void Run(MonoBehaviour one) {
    Player.Enable(one);
    Player.FixedUpdate(one);
  }

  static void BadHabitsAreToldInTheHostsWords() {
    Clear();
    // Non-uniform scale, at the begin and later.
    var uneven = new Transform("Arm", null) { localScale = new Vector3(1, 2, 1) };
    uneven.AddComponent<SphereCollider>().radius = 0.05f;
    var body = uneven.AddComponent<ForetouchBody>();
    Run(body);
    Check.Has(Said(), "ForetouchBody 'Arm': transform 'Arm' has the scale (1, 2, 1)");
    Check.That(!body.enabled, "it is disabled");
    Clear();
    ForetouchScene scene = Wall();
    ForetouchBody ball = Ball("Ball", scene);
    Player.FixedUpdate(ball);
    ball.transform.localScale = new Vector3(2, 2, 2);
    Player.FixedUpdate(ball);
    Check.Has(Said(), "the scale of 'Ball' changed from 1 to 2 at run time");
    Player.FixedUpdate(ball);
    Check.Equal(Debug.Errors.Count, 1, "told once");
    Clear();
    Player.Enable(ball);
    Player.FixedUpdate(ball);
    NothingSaid("enabled again, it takes the new one");

    // A joint that is destroyed in the middle, and a scene.
    Player.Destroy(ball.transform);
    Player.FixedUpdate(ball);
    Check.Has(Said(), "the transform of joint 0 is missing or was destroyed");
    Clear();
    ball = Ball("Ball", scene);
    Player.FixedUpdate(ball);
    Player.Destroy(scene);
    Player.FixedUpdate(ball);
    Check.Has(Said(), "ForetouchBody 'Ball': its ForetouchScene is missing or was destroyed");
    Clear();

    // Meshes.
    var level = new Transform("Level", null);
    MeshAt("Empty", level, new Vector3[0], new int[0]);
    MeshFilter bare = MeshAt("Bare", level, WallVertices, WallTriangles);
    bare.sharedMesh = null;
    scene = level.AddComponent<ForetouchScene>();
    Player.Enable(scene);
    Check.Has(string.Join("/", Debug.Warnings.ToArray()), "the mesh of 'Empty' has no vertices");
    Check.Equal(Debug.Warnings.Count, 2, "both are told");
    Check.Has(Said(), "ForetouchScene 'Level' has no triangles");
    Clear();
    bare.sharedMesh = new Mesh { vertices = WallVertices, triangles = WallTriangles, isReadable = false };
    Player.Enable(scene);
    Check.Has(Said(), "tick Read/Write in its import settings");
    Clear();
    bare.sharedMesh = new Mesh { vertices = WallVertices, triangles = new[] { 0, 1, 7 } };
    Player.Enable(scene);
    Check.Has(Said(), "names vertex 7 and has 4");
    Clear();
    bare.sharedMesh = new Mesh { vertices = new[] { new Vector3(float.NaN, 0, 0) }, triangles = new[] { 0, 0, 0 } };
    Player.Enable(scene);
    Check.Has(Said(), "ForetouchScene 'Level': ");
    Clear();

    // A skeleton without capsules, out of order, and a hand that shows another number.
    var plain = new Transform("Plain", null);
    Run(plain.AddComponent<ForetouchBody>());
    Check.Has(Said(), "has no joints");
    Clear();
    var child = new Transform("Child", plain);
    var listed = plain.AddComponent<ForetouchBody>();
    listed.joints = new[] { child, plain };
    Run(listed);
    Check.Has(Said(), "joint 'Child' is listed before its parent 'Plain'");
    Clear();
    listed.joints = new[] { plain, child };
    Run(listed);
    Check.Has(Said(), "has no capsules");
    Clear();
    listed.joints = new[] { plain, null };
    Run(listed);
    Check.Has(Said(), "the transform of joint 1 is missing");
    Clear();
    var hand = new Transform("Hand", null).AddComponent<SolidHand>();
    hand.scene = Wall();
    hand.tracked = Ball("Tracked", null);
    Run(hand);
    Check.Has(Said(), "shows 0 transforms and 1 joints are tracked");
    Clear();
    hand.shown = new[] { hand.tracked.transform };
    Run(hand);
    Check.Has(Said(), "'Tracked' is tracked and shown");
    Clear();
    hand.shown = new[] { new Transform("Shown", null) };
    Run(hand);
    Player.FixedUpdate(hand);
    NothingSaid("a hand that is right");
    Player.Destroy(hand.tracked);
    Player.FixedUpdate(hand);
    Check.Has(Said(), "its ForetouchBody was destroyed or disabled");
    Clear();

    // A prop that is mirrored.
    MeshFilter door = MeshAt("Door", null, WallVertices, WallTriangles);
    door.transform.localScale = new Vector3(-1, 1, 1);
    var events = new Transform("Events", null).AddComponent<TouchEvents>();
    events.props = new[] { door };
    Run(events);
    Check.Has(Said(), "the prop 'Door' is mirrored, flat or skewed");
    Clear();
    door.transform.localScale = new Vector3(1, 1, 1);
    Run(events);
    Player.FixedUpdate(events);
    door.transform.localScale = new Vector3(1, 1, 3);
    Player.FixedUpdate(events);
    Check.Has(Said(), "the scale of the prop 'Door' changed");
    Clear();
  }

  // The sample of the package, as it comes: it makes all it needs.
  static void TheSampleStaysOnItsDesk() {
    new GameObject("Sample").AddComponent<HandOnDesk>();
    SolidHand hand = Player.Scripts.OfType<SolidHand>().Single();
    Transform shown = hand.shown[0], tracked = hand.tracked.transform;
    int onDesk = 0;
    for (int frame = 0; frame < 200; ++frame) {
      Player.FixedUpdate(Player.Scripts.ToArray());
      Check.That(shown.localPosition.y > 0.069f, "above the desk: " + shown.localPosition.y);
      if (tracked.localPosition.y < 0.05f) onDesk += shown.localPosition.y < 0.075f ? 1 : 0;
    }
    NothingSaid("the sample");
    Check.That(onDesk > 50, "it lies on the desk for a while: " + onDesk);
  }

  /// Transforms of the avatar file's names, as a rig has them.
  static Transform RigOf(List<object> links) {
    var rig = new Transform("Rig", null);
    var made = new Dictionary<string, Transform>();
    foreach (Dictionary<string, object> link in links) {
      var parent = (string)link["parent"];
      made.Add((string)link["name"], new Transform((string)link["name"], parent == null ? rig : made[parent]));
    }
    return rig;
  }

  static double[] Numbers(object list) { return ((List<object>)list).Select(n => (double)n).ToArray(); }

  /// How far a point of the avatar's frame, mirrored in z, is from the axis of a collider of the joint.
  static double Distance(Transform place, float half, double[] point) {
    Vector3 way = place.localRotation * new Vector3(0, 1, 0), middle = place.localPosition;
    double[] axis = { way.x, way.y, way.z }, from = { point[0] - middle.x, point[1] - middle.y, -point[2] - middle.z };
    double along = Math.Max(-half, Math.Min(half, axis.Zip(from, (a, b) => a * b).Sum()));
    return Math.Sqrt(axis.Zip(from, (a, b) => (b - along * a) * (b - along * a)).Sum());
  }

  /// What `foretouch avatar colliders` wrote of the bundled avatar, beside the avatar file.
  static void CollidersOfAnAvatarHoldItsCapsules(string avatar, string colliders) {
    var links = (List<object>)((Dictionary<string, object>)new FakeJson(System.IO.File.ReadAllText(avatar)).Whole())["links"];
    Transform rig = RigOf(links);
    Transform[] added = ForetouchColliders.Add(rig, System.IO.File.ReadAllText(colliders));
    int next = 0;
    foreach (Dictionary<string, object> link in links) {
      foreach (Dictionary<string, object> lss in (List<object>)link["lss"]) {
        Transform place = added[next++];
        var capsule = place.GetComponents<CapsuleCollider>().SingleOrDefault();
        float radius = capsule != null ? capsule.radius : place.GetComponents<SphereCollider>().Single().radius;
        float half = capsule != null ? 0.5f * capsule.height - radius : 0;
        Check.That(capsule == null || capsule.direction == 1, "a capsule along y");
        Check.Equal(place.parent.name, (string)link["name"], "below its joint");
        double expected = (double)lss["radius"];
        foreach (string end in new[] { "a", "b" }) {
          double lack = Distance(place, half, Numbers(lss[end])) + expected - radius;
          Check.That(lack <= 1e-7, link["name"] + " holds " + end + " but for " + lack);
        }
        Check.That(radius - expected < 1e-6, link["name"] + " is no thicker than floats need");
      }
    }
    Check.Equal(next, added.Length, "as many as the avatar has");
    Check.That(next > 20, "many of them");
    var body = rig.AddComponent<ForetouchBody>();
    Player.Enable(body);
    Check.That(body.IsReady, "a body of these colliders");
    NothingSaid("a body of these colliders");
    Check.Equal(body.Joints.Length, added.Length, "each of them moves with the body");
    Check.Throws<HostProblem>(() => ForetouchColliders.Add(new Transform("Other", null), System.IO.File.ReadAllText(colliders)),
                              "'Other' has no transform called 'Hips'");
    Check.Throws<HostProblem>(() => ForetouchColliders.Add(rig, "{\"format\": \"other\"}"), "expected a file of foretouch avatar colliders");
  }

  static int Main(string[] files) {
    if (files.Length == 2) CollidersOfAnAvatarHoldItsCapsules(files[0], files[1]);
    TheSampleStaysOnItsDesk();
    ABodyTellsWhatTheLibrarySays();
    ScaleAndWhatLiesBetweenCount();
    AHandStopsAndComesBack();
    EventsAreToldOnce();
    AReloadOfScriptsIsAGap();
    WhoIsToldMayDestroyWhatTells();
    BadHabitsAreToldInTheHostsWords();
    return Check.Done("components");
  }
}
