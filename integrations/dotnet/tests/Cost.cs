// Cost.cs: what the border costs per step: a clip's steps and contacts by C# and by C (cost.c), in turns,
// in one process. Prints medians of the rounds; nothing fails here.
//   cost.exe FOLDER_OF_EXAMPLES
using System;
using System.Diagnostics;
using System.Linq;
using System.Runtime.InteropServices;
using Foretouch;

static unsafe class Cost {
  const int Rounds = 31;

  [DllImport("cost")] static extern long cost_loop(FtQuery query, double* rotations, double* translations, ulong joints, ulong frames);

  static double Seconds(Action work) {
    var watch = Stopwatch.StartNew();
    work();
    return watch.Elapsed.TotalSeconds;
  }

  static double Median(double[] values) { return values.OrderBy(one => one).ElementAt(values.Length / 2); }

  static void Measure(string folder, string place, string who) {
    using (FtScene scene = FtScene.Load(folder + "/" + place + ".obj"))
    using (FtAvatar avatar = FtAvatar.Load(folder + "/" + who + ".avatar.json"))
    using (FtClip clip = FtClip.Load(folder + "/" + who + ".bvh", avatar))
    using (FtQuery query = FtQuery.Create(scene, avatar))
    using (var pose = new FtPoseBuffer(avatar)) {
      int frames = (int)clip.GetInfo().frameCount, joints = avatar.JointCount;
      var poses = new FtPoseBuffer[frames];
      var rotations = new double[4 * joints * frames];
      var translations = new double[3 * joints * frames];
      for (int i = 0; i < frames; ++i) {
        poses[i] = new FtPoseBuffer(avatar);
        clip.Pose(i, poses[i]);
        poses[i].Rotations.CopyTo(new Span<double>(rotations, 4 * joints * i, 4 * joints));
        poses[i].Translations.CopyTo(new Span<double>(translations, 3 * joints * i, 3 * joints));
      }
      long byC = 0, byCSharp = 0;
      var inC = new double[Rounds];
      var inCSharp = new double[Rounds];
      query.Begin(poses[0]);
      for (int round = 0; round < Rounds; ++round) {
        inC[round] = Seconds(() => {
          fixed (double* rotation = rotations, translation = translations)
            byC = cost_loop(query, rotation, translation, (ulong)joints, (ulong)frames);
        });
        inCSharp[round] = Seconds(() => {
          byCSharp = 0;
          for (int i = 0; i < frames; ++i) {
            query.Step(poses[i]);
            byCSharp += query.Contacts().Length;
          }
        });
      }
      if (byC != byCSharp || byC <= 0) throw new Exception("C found " + byC + " contacts, C# " + byCSharp);
      double c = 1e6 * Median(inC) / frames, sharp = 1e6 * Median(inCSharp) / frames;
      Console.WriteLine("{0,-7} in {1,-5} {2,3} joints: C {3:F3} us a step, C# {4:F3} us: the border {5:F3} us, {6:F3} times",
                        who, place, joints, c, sharp, sharp - c, sharp / c);
      foreach (FtPoseBuffer one in poses) one.Dispose();
    }
  }

  static int Main(string[] arguments) {
    Measure(arguments[0], "desk", "hand");
    Measure(arguments[0], "room", "dancer");
    return 0;
  }
}
