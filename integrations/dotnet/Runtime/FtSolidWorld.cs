// FtSolidWorld.cs: solid avatars among what moves: doors push them, and what they hold is solid too.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtWorld {
    /// <summary>A world in which some avatars are solid, followed from `beginUs` on.</summary>
    public static FtWorld CreateSolid(FtScene still, long beginUs, int reach = FtSolidReach.Skin,
                                      FtWorldOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtWorld world;
      Ft.Must(FtNative.ft_solid_world_create(still, beginUs, reach, options.HasValue ? &given : null, out world));
      return world;
    }

    /// <summary>Returns the body's number; ticks push its poses.</summary>
    public int AddSolid(FtAvatar avatar, FtSolidOptions? options = null, FtBodyOptions? body = null) {
      var given = options.GetValueOrDefault();
      var asBody = body.GetValueOrDefault();
      int number;
      Ft.Must(FtNative.ft_solid_world_add(this, avatar, options.HasValue ? &given : null, body.HasValue ? &asBody : null,
                                          out number));
      return number;
    }

    /// <summary>A tick until then, to where one solid avatar is tracked; the others keep their targets.</summary>
    public void Tick(long timeUs, int body, FtPoseBuffer tracked) {
      var target = new FtSolidTarget { body = body, pose = tracked.Native };
      Ft.Must(FtNative.ft_solid_world_tick(this, timeUs, &target, 1));
      GC.KeepAlive(tracked);
    }

    /// <summary>The same for several, one pose per body; with none of them, all keep their targets.</summary>
    public void Tick(long timeUs, ReadOnlySpan<int> bodies, FtPoseBuffer[] tracked) {
      if (tracked.Length != bodies.Length)
        throw new ArgumentException("tracked: expected one per body, " + bodies.Length + ", found " + tracked.Length);
      FtSolidTarget* targets = stackalloc FtSolidTarget[Math.Max(1, bodies.Length)];
      for (int i = 0; i < bodies.Length; ++i)
        targets[i] = new FtSolidTarget { body = bodies[i], pose = tracked[i].Native };
      Ft.Must(FtNative.ft_solid_world_tick(this, timeUs, targets, (ulong)bodies.Length));
      GC.KeepAlive(tracked);
    }

    public FtSolidTick SolidTick(int body, out bool isAssumed) {
      var tick = new FtSolidTick { size = (uint)sizeof(FtSolidTick) };
      int assumed;
      Ft.Must(FtNative.ft_solid_world_get_tick(this, body, &tick, out assumed));
      isAssumed = assumed != 0;
      return tick;
    }
  }
}
