// Errors.cs: what is refused, in the library's words; and what is forgotten is released, with its domain
// at the latest.
//   errors.exe         all of that
//   errors.exe absent  where the library cannot be found
using System;
using System.IO;
using System.Linq;
using Foretouch;

public sealed class Leaky : MarshalByRefObject {
  /// Makes scenes in this domain, and forgets them. Returns the process's memory then, in MB.
  public int Make(int count) {
    double[] positions = Errors.Field(200);
    int[] indices = Enumerable.Range(0, positions.Length / 3).ToArray();
    var scenes = new FtScene[count];
    for (int i = 0; i < count; ++i) scenes[i] = FtScene.Create(positions, indices);
    int megabytes = Errors.ResidentMegabytes();
    GC.KeepAlive(scenes);
    return megabytes;
  }
}

static class Errors {
  /// side x side triangles that stand apart.
  internal static double[] Field(int side) {
    var positions = new double[9 * side * side];
    for (int i = 0; i < side * side; ++i) {
      int x = i % side, z = i / side;
      double[] one = { x, 0, z, x + 0.5, 0, z, x, 0.5, z };
      Array.Copy(one, 0, positions, 9 * i, 9);
    }
    return positions;
  }

  internal static int ResidentMegabytes() {
    string line = File.ReadAllLines("/proc/self/status").First(one => one.StartsWith("VmRSS:"));
    return int.Parse(line.Split(new[] { ' ', '\t' }, StringSplitOptions.RemoveEmptyEntries)[1]) / 1024;
  }

  static readonly FtLss[] OneBall = { new FtLss(new FtVector(0, 0, 0), new FtVector(0, 0, 0), 0.1) };
  static FtAvatar Ball() {
    return FtAvatar.Create(new[] { "ball" }, new[] { -1 }, new double[3], new double[0], OneBall, new[] { 0 });
  }
  static FtScene Wall() { return FtScene.Create(new double[] { 1, -5, -5, 1, 5, -5, 1, 0, 5 }, new[] { 0, 1, 2 }); }

  static void TheLibrarysWordsCome() {
    var absent = Check.Throws<ForetouchException>(() => FtScene.Load("/no/such/room.obj"), "/no/such/room.obj");
    Check.Equal(absent.Status, FtStatus.ErrorFileNotFound, "status");
    Check.Equal(absent.StatusName, "file-not-found", "word");
    var orphan = Check.Throws<ForetouchException>(
        () => FtAvatar.Create(new[] { "a", "b" }, new[] { -1, 1 }, new double[6], new double[0], OneBall, new[] { 0 }), "'b'");
    Check.Equal(orphan.Index, 1L, "the joint at fault");
    Check.Throws<ForetouchException>(() => FtAvatar.Parse("{\"joints\": ", "hand.json"), "hand.json");
    Check.Throws<ForetouchException>(() => FtScene.Create(new double[] { 0, 0, 0 }, new[] { 0, 1, 2 }), "");
    using (FtScene wall = Wall())
    using (FtAvatar ball = Ball())
    using (FtQuery query = FtQuery.Create(wall, ball))
    using (FtPoseBuffer one = new FtPoseBuffer(1), two = new FtPoseBuffer(2)) {
      Check.Equal(Check.Throws<ForetouchException>(() => query.Step(one), "").Status, FtStatus.ErrorNoStep, "no step yet");
      Check.Equal(Check.Throws<ForetouchException>(() => query.Begin(two), "").Status, FtStatus.ErrorMismatch, "another's pose");
      one.SetPosition(0, new FtVector(0, double.NaN, 0));
      Check.Equal(Check.Throws<ForetouchException>(() => query.Begin(one), "").Status, FtStatus.ErrorNonFinite, "NaN");
      one.SetPosition(0, new FtVector(0, 0, 0));
      query.Begin(one);
      Check.Throws<ForetouchException>(() => ball.JointName(7), "7");
      Check.Throws<ForetouchException>(() => wall.ObjectName(-1), "-1");
      Check.Equal(ball.JointName(0), "ball", "name");
      var options = FtQueryOptions.Usual;
      options.tolerance = -1;
      Check.Throws<ForetouchException>(() => query.SetOptions(options), "tolerance");
    }
  }

  static void ArraysThatDoNotFitAreRefusedHere() {
    Check.Throws<ArgumentException>(() => FtScene.Create(new double[4], new int[3]), "three numbers per vertex");
    Check.Throws<ArgumentException>(() => FtScene.Create(new double[9], new[] { 0, 1, 2 }, new int[2]), "an object per triangle");
    Check.Throws<ArgumentException>(
        () => FtAvatar.Create(new[] { "a" }, new[] { -1 }, new double[2], new double[0], OneBall, new[] { 0 }), "3 numbers");
    Check.Throws<ArgumentException>(() => new FtPoseBuffer(0), "1 or more");
    Check.Throws<ArgumentException>(() => FtScene.Load("a\0b"), "NUL");
    using (var pose = new FtPoseBuffer(2))
      Check.Throws<ArgumentException>(() => pose.FromFloats(new Float4[2], new Float3[1], FtAxes.YUpLeft), "one per joint");
  }

  static void WhatWasDisposedIsNotUsed() {
    FtScene wall = Wall();
    FtAvatar ball = Ball();
    FtQuery query = FtQuery.Create(wall, ball);
    var pose = new FtPoseBuffer(ball);
    wall.Dispose();  // the query keeps it
    ball.Dispose();
    query.Begin(pose);
    Check.Equal(query.Links().Length, 1, "links");
    Check.Throws<ObjectDisposedException>(() => FtQuery.Create(wall, FtAvatar.None), "");
    query.Dispose();
    query.Dispose();
    Check.Throws<ObjectDisposedException>(() => query.Step(pose), "");
    pose.Dispose();
    Check.Throws<ObjectDisposedException>(() => pose.Rotations.ToString(), "FtPoseBuffer");
    Check.Throws<ArgumentNullException>(() => FtWorld.Create(null), "");
    using (FtWorld world = FtWorld.Create(FtScene.None)) Check.Equal(world.BodyCount, 0, "a world with nothing still");
    Check.Throws<ForetouchException>(() => FtQuery.Create(FtScene.None, FtAvatar.None), "scene");
  }

  static void AxesAreUnitys() {
    FtVector there = FtAxes.Position(new Float3(1, 2, 3), FtAxes.YUpLeft);
    Check.Equal(there.ToString(), new FtVector(1, 2, -3).ToString(), "z is negated");
    Check.Equal(FtAxes.ToFloats(there, FtAxes.YUpLeft).ToString(), new Float3(1, 2, 3).ToString(), "and back");
    Check.Equal(FtAxes.Length(100, FtAxes.ZUpLeft), 1.0, "centimetres");
  }

  static void ADomainReleasesWhatItForgot() {
    int before = 0, within = 0, after = 0;
    for (int i = 0; i < 8; ++i) {
      AppDomain domain = AppDomain.CreateDomain("reload " + i);
      var leaky = (Leaky)domain.CreateInstanceAndUnwrap(typeof(Leaky).Assembly.FullName, typeof(Leaky).FullName);
      if (i == 1) before = ResidentMegabytes();
      within = leaky.Make(4);
      AppDomain.Unload(domain);
    }
    after = ResidentMegabytes();
    Console.WriteLine("resident: {0} MB before, {1} within a domain, {2} after seven", before, within, after);
    Check.That(within > before + 10, "scenes take memory");
    Check.That(after < before + 2 * (within - before), "and domains give it back");
  }

  static int Main(string[] arguments) {
    if (arguments.Length > 0) {
      Check.Throws<DllNotFoundException>(() => FtScene.Load("room.obj"), "expected libforetouch.so (Linux) or foretouch.dll");
      return Check.Done("without the library");
    }
    TheLibrarysWordsCome();
    ArraysThatDoNotFitAreRefusedHere();
    WhatWasDisposedIsNotUsed();
    AxesAreUnitys();
    ADomainReleasesWhatItForgot();
    return Check.Done("errors");
  }
}
