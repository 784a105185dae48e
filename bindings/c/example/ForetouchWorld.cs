// ForetouchWorld.cs: worlds in which things move, for Unity, beside Foretouch.cs: what of world.h,
// events.h and solid_world.h is there to be called, and SolidWorld: bodies that pass through nothing
// among props that move, and what they meet and leave.
// Without Unity: mcs -unsafe -define:FORETOUCH_TRY_WORLD Foretouch.cs ForetouchWorld.cs && mono ForetouchWorld.exe
using System;
using System.Collections.Generic;
using System.Runtime.InteropServices;

public unsafe sealed partial class Foretouch {
  [StructLayout(LayoutKind.Sequential)]
  public struct WorldOptions {
    public uint size; public int asksMeshes;
    public double tolerance;
    public ulong workPerPair, workPerWindow, mostNear;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct BodyOptions { public uint size; public int group, whenSilent, fidelity; public IntPtr self; }
  [StructLayout(LayoutKind.Sequential)]
  public struct Carrier { public uint size; public int body, link, movesInFrame; }
  [StructLayout(LayoutKind.Sequential)]
  public struct WorldSide {
    public int body, link, lss, triangle, obj, reserved;
    public fixed double point[3];
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct WorldContact {
    public uint size; public int verdict, reason, isAssumed;
    public long timeUs;
    public double timeFraction, separation, penetration;
    public fixed double normal[3];
    public WorldSide a, b;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct FollowOptions { public uint size; public int threads; public long cutUs; }
  [StructLayout(LayoutKind.Sequential)]
  public struct EventPoint {
    public fixed double pointA[3];
    public fixed double pointB[3];
    public double separation;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct Event {
    public uint size; public int kind, cause, reason;
    public long timeUs; public double timeFraction;
    public long sinceUs; public double sinceFraction;
    public double separation, penetration;
    public fixed double normal[3];
    public fixed double velocity[3];
    public double approachSpeed, approachLower, approachUpper, effectiveMass;
    public WorldSide a, b;
    public int isAssumed, pointCount;
    public EventPoint points, points1, points2, points3;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct Part {
    public uint size; public int isContact, reason, isAssumed, beganBefore, goesOn;
    public long fromUs; public double fromFraction;
    public long toUs; public double toFraction;
    public long sinceUs; public double sinceFraction;
    public WorldSide a, b;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidTarget { public int body, reserved; public IntPtr pose; public byte* isTracked; }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidBodyContact {
    public uint size; public int body, link, lss, triangle, obj;
    public fixed double point[3];
    public fixed double normal[3];
    public double gap, push, slipSpeed;
  }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidCrush { public uint size; public int body, link, isOver; public long sinceUs; public double depth; }
  [StructLayout(LayoutKind.Sequential)]
  public struct SolidHeld { public uint size; public int body, state, reserved; }

  public const int Leave = 0, UnresolvedTo = 1, StartsInside = 2, Enter = 3, UnresolvedFrom = 4;
  public const int StillScene = -1;

  [DllImport(Lib)] static extern int ft_world_options_init(out WorldOptions options, ulong size);
  [DllImport(Lib)] static extern int ft_world_create(IntPtr still, WorldOptions* options, out IntPtr world);
  [DllImport(Lib)] static extern int ft_body_options_init(out BodyOptions options, ulong size);
  [DllImport(Lib)] static extern int ft_world_add_avatar(IntPtr world, IntPtr avatar, BodyOptions* options, out int body);
  [DllImport(Lib)] static extern int ft_world_add_mesh(IntPtr world, IntPtr mesh, BodyOptions* options, out int body);
  [DllImport(Lib)] static extern int ft_world_ask(IntPtr world, int group, int other, int isAsked);
  [DllImport(Lib)] static extern int ft_world_push(IntPtr world, int body, long utimeUs, Pose* pose);
  [DllImport(Lib)] static extern int ft_world_attach(IntPtr world, int body, ref Carrier carrier, long utimeUs, Pose* pose);
  [DllImport(Lib)] static extern int ft_world_detach(IntPtr world, int body, long utimeUs, Pose* pose);
  [DllImport(Lib)] static extern int ft_world_known_until(IntPtr world, out long utimeUs, out int waitsFor);
  [DllImport(Lib)] static extern int ft_world_forget_before(IntPtr world, long utimeUs);
  [DllImport(Lib)] static extern int ft_world_answer(IntPtr world, long fromUs, long toUs);
  [DllImport(Lib)] static extern int ft_world_contacts(IntPtr world, WorldContact* contacts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_follow_options_init(out FollowOptions options, ulong size);
  [DllImport(Lib)] static extern int ft_world_follow_from(IntPtr world, long fromUs, FollowOptions* options);
  [DllImport(Lib)] static extern int ft_world_follow(IntPtr world, long untilUs);
  [DllImport(Lib)] static extern int ft_world_events(IntPtr world, Event* events, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_world_open_parts(IntPtr world, Part* parts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_world_create(IntPtr still, long beginUs, int reach, WorldOptions* options, out IntPtr world);
  [DllImport(Lib)] static extern int ft_solid_world_add(IntPtr world, IntPtr avatar, IntPtr options, BodyOptions* body, out int number);
  [DllImport(Lib)] static extern int ft_solid_world_tick(IntPtr world, long utimeUs, SolidTarget* targets, ulong count);
  [DllImport(Lib)] static extern int ft_solid_world_get_tick(IntPtr world, int body, ref SolidTick tick, out int isAssumed);
  [DllImport(Lib)] static extern int ft_solid_world_shown(IntPtr world, int body, double[] rotations, double[] translations, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_world_contacts(IntPtr world, int body, [In, Out] SolidContact[] contacts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_world_body_contacts(IntPtr world, int body, SolidBodyContact* contacts, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_world_crushes(IntPtr world, int body, SolidCrush* crushes, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern int ft_solid_world_held(IntPtr world, int body, SolidHeld* held, ulong capacity, out ulong required);
  [DllImport(Lib)] static extern void ft_world_destroy(IntPtr world);

  /// Bodies of Foretouch in a level, that of `still`, among props that move. Time is in whole
  /// microseconds. Of a prop, the level's mesh is what touches. All arrays are Unity's.
  public sealed class SolidWorld : IDisposable {
    IntPtr world;
    readonly Dictionary<int, Foretouch> solids = new Dictionary<int, Foretouch>();
    public SolidWorld(Foretouch still, long beginUs) {
      Must(ft_solid_world_create(still.scene, beginUs, 0, null, out world));
    }
    public int Add(Foretouch body) {
      Must(ft_solid_world_add(world, body.avatar, IntPtr.Zero, null, out int number));
      solids[number] = body;
      return number;
    }
    public int AddProp(Foretouch prop) {
      Must(ft_world_add_mesh(world, prop.scene, null, out int number));
      return number;
    }
    /// Where a prop is at an instant: its localRotation and localPosition.
    public void Push(int prop, long us, float[] xyzw, float[] xyz) {
      double[] rotation = new double[4], translation = Positions(xyz);
      Must(ft_rotations_from_floats(xyzw, 1, UnityAxes, rotation));
      fixed (double* r = rotation) fixed (double* t = translation) {
        var pose = new Pose { size = (uint)sizeof(Pose), jointCount = 1, rotations = r, translations = t };
        Must(ft_world_push(world, prop, us, &pose));
      }
    }
    /// One solid body's tick, to where its joints are tracked: fills shownRotations and shownPositions
    /// of the body. The others keep their last target.
    public SolidTick Tick(long us, int number, float[] xyzw, float[] xyz) {
      Foretouch body = solids[number];
      body.ReadPose(xyzw, xyz);
      fixed (double* r = body.rotations) fixed (double* t = body.translations) {
        var pose = new Pose { size = (uint)sizeof(Pose), jointCount = (uint)body.joints, rotations = r, translations = t };
        var target = new SolidTarget { body = number, pose = (IntPtr)(&pose) };
        Must(ft_solid_world_tick(world, us, &target, 1));
      }
      var tick = new SolidTick { size = (uint)sizeof(SolidTick) };
      Must(ft_solid_world_get_tick(world, number, ref tick, out int isAssumed));
      Must(ft_solid_world_shown(world, number, body.rotations, body.translations, (ulong)body.joints, out ulong all));
      Must(ft_rotations_to_floats(body.rotations, (ulong)body.joints, UnityAxes, body.shownRotations));
      Must(ft_array_to_floats(body.translations, (ulong)body.joints, UnityAxes, body.shownPositions));
      return tick;
    }
    /// What has happened until the last tick's end, at `us`: from enter to leave.
    public Event[] Follow(long us) {
      Must(ft_world_follow(world, us));
      Must(ft_world_events(world, null, 0, out ulong count));
      var events = new Event[count];
      if (count > 0) events[0].size = (uint)sizeof(Event);
      fixed (Event* first = events) Must(ft_world_events(world, first, count, out count));
      Must(ft_world_forget_before(world, us));
      return events;
    }
    public void Dispose() {
      ft_world_destroy(world);
      world = IntPtr.Zero;
    }
  }
}

#if FORETOUCH_TRY_WORLD
static class TryWorld {
  // A ball of 5 cm is moved through a wall at x = 1 m, in steps of 2 cm, and back: it stops before it.
  static int Main() {
    var ball = new[] { Foretouch.Capsule(new float[] { 0, 0, 0 }, new float[] { 0, 0, 0 }, 0.05) };
    var turn = new float[] { 0, 0, 0, 1 };
    using (var hand = new Foretouch(new float[] { 1, -2, -2, 1, 2, -2, 1, 0, 4 }, new[] { 0, 1, 2 },
                                    new[] { "hand" }, new[] { -1 }, new float[] { 0, 0, 0 }, ball, new[] { 0 }))
    using (var world = new Foretouch.SolidWorld(hand, 0)) {
      int body = world.Add(hand);
      int enters = 0, leaves = 0;
      float most = 0;
      for (int frame = 1; frame <= 100; ++frame) {
        long us = 10000 * frame;
        float x = 0.5f + 0.02f * Math.Min(frame, 100 - frame);
        var tick = world.Tick(us, body, turn, new float[] { x, 0, 0 });
        if (tick.isCertified != 1) return 1;
        most = Math.Max(most, hand.shownPositions[0]);
        foreach (Foretouch.Event e in world.Follow(us)) {
          if (e.b.body != Foretouch.StillScene) return 1;
          enters += e.kind == Foretouch.Enter ? 1 : 0;
          leaves += e.kind == Foretouch.Leave ? 1 : 0;
        }
      }
      Console.WriteLine("entered {0} and left {1}, at most at x = {2:F3} m", enters, leaves, most);
      return enters == 1 && leaves == 1 && most > 0.9f && most < 0.951f ? 0 : 1;
    }
  }
}
#endif
