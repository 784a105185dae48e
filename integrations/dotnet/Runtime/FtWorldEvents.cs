// FtWorldEvents.cs: what enters and leaves what, from FollowFrom() on; triggers; and depths.
using System;

namespace Foretouch {
  public sealed unsafe partial class FtWorld {
    /// <summary>Events are reported from here on.</summary>
    public void FollowFrom(long fromUs, int threads = 1, long cutUs = 0) {
      var options = new FtFollowOptions { size = (uint)sizeof(FtFollowOptions), threads = threads, cutUs = cutUs };
      Ft.Must(FtNative.ft_world_follow_from(this, fromUs, &options));
    }

    /// <summary>kg, of a rigid body around `center` of its frame.</summary>
    public void Weigh(int body, double kg, FtVector center, FtMatrix inertia) {
      Ft.Must(FtNative.ft_world_weigh(this, body, kg, &center.x, &inertia.m00));
    }
    public void WeighAvatar(int body, double kg) { Ft.Must(FtNative.ft_world_weigh_avatar(this, body, kg)); }

    /// <summary>What happens until then; Events() and Parts() have it.</summary>
    public void Follow(long untilUs) { Ft.Must(FtNative.ft_world_follow(this, untilUs)); }

    /// <summary>Around the origin of its frame. Returns the trigger's number; its body's is for poses.</summary>
    public int AddTriggerBox(FtVector halfExtents, out int body, FtTriggerOptions? options = null) {
      var given = options.GetValueOrDefault();
      int trigger;
      Ft.Must(FtNative.ft_world_add_trigger_box(this, &halfExtents.x, options.HasValue ? &given : null, out trigger, out body));
      return trigger;
    }
    public int AddTriggerSphere(double radius, out int body, FtTriggerOptions? options = null) {
      var given = options.GetValueOrDefault();
      int trigger;
      Ft.Must(FtNative.ft_world_add_trigger_sphere(this, radius, options.HasValue ? &given : null, out trigger, out body));
      return trigger;
    }
    /// <summary>Every object of `closed` is closed: no edge is open.</summary>
    public int AddTriggerMesh(FtScene closed, out int body, FtTriggerOptions? options = null) {
      var given = options.GetValueOrDefault();
      int trigger;
      Ft.Must(FtNative.ft_world_add_trigger_mesh(this, closed, options.HasValue ? &given : null, out trigger, out body));
      return trigger;
    }
    public void Watch(int trigger, int body, int link = Ft.EveryLink) {
      Ft.Must(FtNative.ft_world_watch(this, trigger, body, link));
    }
    public void StandTrigger(int trigger, long fromUs, FtPoseBuffer pose) {
      Ft.Must(FtNative.ft_world_stand_trigger(this, trigger, fromUs, pose.Native));
      GC.KeepAlive(pose);
    }

    /// <summary>How deep a body is in another, and which way out.</summary>
    public FtDepth Depth(FtDepthQuestion question) {
      question.size = (uint)sizeof(FtDepthQuestion);
      var depth = new FtDepth { size = (uint)sizeof(FtDepth) };
      Ft.Must(FtNative.ft_world_depth(this, &question, &depth));
      return depth;
    }
  }
}
