// Answers.cs: asks in C# what answers.c asks in C, and prints the same: every field of every answer about
// the bundled example. The last line, on standard error, says how much that is.
using System;
using System.IO;
using System.Linq;
using System.Text;
using Foretouch;

static class Answers {
  static Dump dump;
  static FtScene scene;
  static FtAvatar avatar;
  static FtClip clip;
  static FtPoseBuffer pose;
  static int frames, linkSteps;

  static void Load(string folder, string place, string who) {
    scene = FtScene.Load(folder + "/" + place + ".obj");
    avatar = FtAvatar.Load(folder + "/" + who + ".avatar.json");
    clip = FtClip.Load(folder + "/" + who + ".bvh", avatar);
    pose = new FtPoseBuffer(avatar);
    frames = (int)clip.GetInfo().frameCount;
  }

  static void Release() {
    foreach (FtHandle handle in new FtHandle[] { pose, clip, avatar, scene }) handle.Dispose();
  }

  static void Steps(int stride) {
    var options = FtQueryOptions.Usual;
    options.scope = FtScope.EveryObject;
    using (var rules = FtPairRules.Create(avatar))
    using (var query = FtQuery.Create(scene, avatar, options)) {
      query.SetPairRules(rules);
      clip.Pose(0, pose);
      query.Begin(pose);
      for (int frame = stride; frame < frames; frame += stride) {
        clip.Pose(frame, pose);
        query.Step(pose);
        ReadOnlySpan<FtContact> links = query.Links();
        dump.Each(links);
        linkSteps += links.Length;
        dump.Each(query.Objects());
        ReadOnlySpan<FtOtherLink> others;
        ReadOnlySpan<FtContact> pairs = query.Pairs(out others);
        for (int i = 0; i < pairs.Length; ++i) {
          dump.One(pairs[i]);
          dump.One(others[i]);
        }
        ReadOnlySpan<FtContact> contacts = query.Contacts();
        for (int i = 0; i < contacts.Length && contacts[i].verdict == FtVerdict.Contact; ++i) {
          dump.One(query.Details(FtList.Contacts, i));
          dump.Each(query.MotionTransforms(contacts[i].toi));
        }
        dump.One(query.Counters());
      }
    }
  }

  static void Solid() {
    using (var shown = FtSolid.Create(scene, avatar)) {
      for (int frame = 0; frame < frames; ++frame) {
        clip.Pose(frame, pose);
        dump.One(shown.Follow(pose, 1.0 / 60));
        shown.Shown(pose);
        dump.Pose(pose);
        dump.Each(shown.Joints());
        dump.Each(shown.Contacts());
      }
    }
  }

  static FtScene Panel() {
    return FtScene.Create(new double[] { 0, 0, 0, -0.9, 0, 0, -0.9, 2, 0, 0, 2, 0 }, new[] { 0, 1, 2, 0, 2, 3 });
  }

  static void PanelAt(int k, FtPoseBuffer at) {
    double p = 0.01 * (k % 100), norm = 1 + p * p;
    at.SetRotation(0, new FtRotation((1 - p * p) / norm, 0, 2 * p / norm, 0));
    at.SetPosition(0, new FtVector(0.02 * (k % 50), 0, -0.3));
  }

  static void World(int stride, long usPerFrame) {
    using (FtScene mesh = Panel())
    using (var swung = new FtPoseBuffer(1))
    using (FtWorld moving = FtWorld.Create(scene)) {
      int box;
      int body = moving.AddAvatar(avatar), door = moving.AddMesh(mesh);
      int trigger = moving.AddTriggerBox(new FtVector(0.5, 1, 0.5), out box);
      moving.Watch(trigger, body);
      PanelAt(0, swung);
      moving.StandTrigger(trigger, 0, swung);
      moving.FollowFrom(0);
      moving.WeighAvatar(body, 70);
      long at = 0;
      for (int frame = 0; frame < frames; frame += stride, at += stride * usPerFrame) {
        PanelAt(frame, swung);
        clip.Pose(frame, pose);
        moving.Push(body, at, pose);
        moving.Push(door, at + 500, swung);
        if (frame == 0) continue;
        int waitsFor;
        long until = moving.KnownUntil(out waitsFor);
        moving.Answer(until - stride * usPerFrame, until);
        dump.Each(moving.Contacts());
        moving.Follow(until);
        dump.Each(moving.Events());
        dump.Each(moving.Parts());
        dump.Each(moving.OpenParts());
        dump.Each(moving.TriggerEvents());
        dump.Each(moving.Occupants());
        dump.One(moving.Depth(new FtDepthQuestion {
          body = body, link = Ft.EveryLink, fromBody = door, fromLink = Ft.EveryLink, timeUs = until - 1000, timeFraction = 0.25
        }));
        Ask(moving, body, door, until);
        moving.ThinBefore(until - stride * usPerFrame, 1e-3);
        ulong kept = moving.PoseBytes();
        moving.ForgetBefore(until - stride * usPerFrame);
        if (moving.PoseBytes() > kept || moving.ForgetBeyond(kept) < until - stride * usPerFrame) throw new Exception("remembers more than it did");
      }
    }
  }

  static unsafe void Ask(FtWorld moving, int body, int door, long until) {
    var question = FtQuestion.Usual;
    question.which = FtAsk.All;
    question.shape = new FtLss(new FtVector(-2, 1, 0.1), new FtVector(-2, 1, 0.1), 0.02);
    question.direction = new FtVector(1, 0, 0);
    question.reach = 9;
    question.timeUs = until - 700;
    FtAskPart[] without = { new FtAskPart { body = door, link = Ft.EveryLink, @object = -1 } };
    FtAskInstant[] instants = { new FtAskInstant { body = body, timeUs = until - 900, timeFraction = 0.5 } };
    moving.Probe(question);
    dump.Each(moving.Hits());
    moving.Probe(question, without, instants);
    dump.Each(moving.Hits());
    dump.Each(moving.Unknown());
    fixed (FtAskPart* parts = without)
    fixed (FtAskInstant* seen = instants) {
      var whom = FtAskWhom.Usual;
      whom.without = parts;
      whom.withoutCount = 1;
      question.whom = &whom;
      question.instants = seen;
      question.instantCount = 1;
      FtQuestion[] many = { question, question };
      many[1].which = FtAsk.Closest;
      many[1].solids = 1;
      var probed = new FtProbed[2];
      moving.Probe(many, probed);
      dump.One(probed[0]);
      dump.One(probed[1]);
      dump.Each(moving.Hits());
    }
    var flight = FtFlight.Usual;
    flight.shape = question.shape;
    flight.way = new FtVector(3, 0, 0);
    flight.fromUs = until - 900;
    flight.toUs = until;
    dump.One(moving.Fly(flight));
  }

  static void SolidWorld() {
    using (FtScene mesh = Panel())
    using (var swung = new FtPoseBuffer(1))
    using (FtWorld moving = FtWorld.CreateSolid(scene, 0)) {
      int body = moving.AddSolid(avatar), door = moving.AddMesh(mesh);
      for (int frame = 0; frame < frames; ++frame) {
        long us = 16667L * (frame + 1);
        bool isAssumed;
        PanelAt(frame, swung);
        if (frame == 0) moving.Push(door, 0, swung);
        moving.Push(door, us, swung);
        clip.Pose(frame, pose);
        moving.Tick(us, body, pose);
        dump.One(moving.SolidTick(body, out isAssumed));
        moving.SolidShown(body, pose);
        dump.Pose(pose);
        dump.Each(moving.SolidContacts(body));
        dump.Each(moving.SolidBodyContacts(body));
        dump.Each(moving.SolidCrushes(body));
        moving.Follow(us);
        dump.Each(moving.Events());
        moving.ForgetBefore(us);
      }
    }
  }

  static void NearAndPerson() {
    var reach = new double[avatar.JointCount];
    var bounds = new FtLinkBound[avatar.JointCount];
    for (int i = 0; i < reach.Length; ++i) {
      reach[i] = 0.05;
      bounds[i] = FtLinkBound.Usual;
      bounds[i].acceleration = 20;
    }
    using (var later = new FtPoseBuffer(avatar))
    using (var near = FtNear.Create(scene, avatar))
    using (var brackets = FtBrackets.Create(scene, avatar)) {
      for (int frame = 0; frame + 6 < frames; frame += 6) {
        clip.Pose(frame, pose);
        near.Ask(pose, reach);
        dump.Each(near.Features());
        dump.Each(near.Ranges());
        clip.Pose(frame + 6, later);
        brackets.Answer(pose, later, 0.1, bounds);
        dump.Each(brackets.Links());
      }
    }
  }

  static void Edges() {
    const int Count = 200;
    var kinds = new FtRobotJoint[avatar.JointCount];
    for (int i = 0; i < kinds.Length; ++i)
      kinds[i] = new FtRobotJoint { kind = FtJoint.Continuous, mimicOf = -1, axis = new FtVector(0, 0, 1) };
    kinds[0].kind = FtJoint.Planar;
    kinds[0].axis = new FtVector(0, 1, 0);
    using (FtRobot robot = FtRobot.Create(avatar, kinds))
    using (FtEdges asked = FtEdges.Create(robot, scene)) {
      int coordinates = robot.CoordinateCount;
      var q = new double[Count * coordinates];
      uint drawn = 1;
      for (int i = 0; i < q.Length; ++i) {
        drawn = 1664525 * drawn + 1013904223;
        q[i] = ((double)(drawn >> 8) / 16777216 - 0.5) * 2;
      }
      var answers = new FtEdge[Count - 1];
      ReadOnlySpan<double> all = q;
      asked.Answer(all.Slice(0, q.Length - coordinates), all.Slice(coordinates), answers);
      for (int i = 0; i < answers.Length; ++i) {
        dump.One(answers[i]);
        if (answers[i].verdict == FtVerdict.Clear) continue;
        FtOtherLink other;
        dump.One(asked.Contact(i, out other));
        dump.One(other);
      }
      dump.One(asked.AnswerPath(q));
      robot.Pose(all.Slice(0, coordinates), pose);
      dump.Pose(pose);
    }
  }

  static int Main(string[] arguments) {
    using (var to = new StreamWriter(Console.OpenStandardOutput(), new UTF8Encoding(false), 1 << 16)) {
      dump = new Dump(to);
      Load(arguments[0], "room", "dancer");
      Steps(1);
      World(6, 16667);
      NearAndPerson();
      Release();
      Load(arguments[0], "desk", "hand");
      Steps(1);
      World(1, 16667);
      Solid();
      SolidWorld();
      NearAndPerson();
      Edges();
      Release();
    }
    Console.Error.WriteLine(linkSteps + " link-steps; " + string.Join(", ", dump.Counts.OrderBy(one => one.Key).Select(one => one.Value + " " + one.Key).ToArray()));
    return 0;
  }
}
