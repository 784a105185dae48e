// swing.cs: the forearm of swing.c, in C#, by the binding in ../dotnet; and a forearm that is led
// into the pole and back, and whose shown motion never passes through it.
//   d=../dotnet/Runtime; mcs -unsafe -langversion:latest -r:System.Core swing.cs $d/*.cs $d/{Native,Engine}/*.cs
// Unity needs no command: docs/integrations.md has the package.
using System;
using Foretouch;

static class Swing {
  const double Quarter = 1.5708;

  static void Turn(FtPoseBuffer pose, double angle) {
    pose.SetRotation(0, new FtRotation(Math.Cos(0.5 * angle), 0, Math.Sin(0.5 * angle), 0));
  }

  static bool MeetsThePole(FtScene pole, FtAvatar forearm) {
    using (var query = FtQuery.Create(pole, forearm))
    using (FtPoseBuffer from = new FtPoseBuffer(forearm), to = new FtPoseBuffer(forearm)) {
      Turn(to, Quarter);
      query.Step(from, to);
      foreach (FtContact contact in query.Contacts()) {
        Console.WriteLine("contact at t = {0:F4}, {1:F2} mm from {2}", contact.toi, 1000 * contact.separation,
                          pole.ObjectName(contact.@object));
        return contact.verdict == FtVerdict.Contact;
      }
      return false;
    }
  }

  // Into the pole, beyond it and back: it presses somewhere, and is back in the end.
  static bool StaysAtThePole(FtScene pole, FtAvatar forearm) {
    using (var solid = FtSolid.Create(pole, forearm))
    using (var tracked = new FtPoseBuffer(forearm)) {
      var tick = new FtSolidTick();
      bool isPressed = false, isProven = true;
      for (int frame = 0; frame <= 180; ++frame) {
        Turn(tracked, Quarter * (1 - Math.Abs(frame / 90.0 - 1)));
        tick = solid.Follow(tracked, 1 / 90.0);
        isProven &= tick.isCertified == 1;
        foreach (FtSolidContact contact in solid.Contacts()) isPressed |= contact.push > 0;
      }
      return isProven && isPressed && tick.state == FtSolid.Equal;
    }
  }

  static int Main() {
    double[] corners = { 0.2, 0, -0.2, 0.2, 2, -0.2, 0.4, 1, -0.4 };
    int[] triangle = { 0, 1, 2 }, objects = { 0 }, parents = { -1 }, links = { 0 };
    FtLss[] capsule = { new FtLss(new FtVector(0, 0, 0), new FtVector(0.3, 0, 0), 0.04) };
    using (var pole = FtScene.Create(corners, triangle, objects, new[] { "pole" }))
    using (var forearm = FtAvatar.Create(new[] { "forearm" }, parents, new double[] { 0, 1, 0 }, null, capsule, links))
      return MeetsThePole(pole, forearm) && StaysAtThePole(pole, forearm) ? 0 : 1;
  }
}
