// FtWorld.cs: bodies that move by clocks of their own, and the first contacts of every two.
using System;

namespace Foretouch {
  /// <summary>For one thread at a time. What it returns stays as it is until the same is asked again.
  /// Times are whole microseconds.</summary>
  public sealed unsafe partial class FtWorld {
    /// <summary>`still`: what never moves; FtScene.None: nothing.</summary>
    public static FtWorld Create(FtScene still, FtWorldOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtWorld world;
      Ft.Must(FtNative.ft_world_create(still, options.HasValue ? &given : null, out world));
      return world;
    }

    /// <summary>Returns the body's number.</summary>
    public int AddAvatar(FtAvatar avatar, FtBodyOptions? options = null) {
      var given = options.GetValueOrDefault();
      int body;
      Ft.Must(FtNative.ft_world_add_avatar(this, avatar, options.HasValue ? &given : null, out body));
      return body;
    }

    /// <summary>A rigid prop, in its own frame: its one joint is 0.</summary>
    public int AddMesh(FtScene mesh, FtBodyOptions? options = null) {
      var given = options.GetValueOrDefault();
      int body;
      Ft.Must(FtNative.ft_world_add_mesh(this, mesh, options.HasValue ? &given : null, out body));
      return body;
    }

    public int BodyCount {
      get {
        ulong count;
        Ft.Must(FtNative.ft_world_body_count(this, out count));
        return (int)count;
      }
    }

    public void Ask(int group, int other, bool isAsked) {
      Ft.Must(FtNative.ft_world_ask(this, group, other, isAsked ? 1 : 0));
    }
    public void AskStill(int group, bool isAsked) { Ft.Must(FtNative.ft_world_ask_still(this, group, isAsked ? 1 : 0)); }

    public void Push(int body, long timeUs, FtPoseBuffer pose) {
      Ft.Must(FtNative.ft_world_push(this, body, timeUs, pose.Native));
      GC.KeepAlive(pose);
    }

    /// <summary>From then on `carrier` carries it, at `pose` in the carrier's frame.</summary>
    public void Attach(int body, FtCarrier carrier, long timeUs, FtPoseBuffer pose) {
      carrier.size = (uint)sizeof(FtCarrier);
      Ft.Must(FtNative.ft_world_attach(this, body, &carrier, timeUs, pose.Native));
      GC.KeepAlive(pose);
    }
    public void Detach(int body, long timeUs, FtPoseBuffer pose) {
      Ft.Must(FtNative.ft_world_detach(this, body, timeUs, pose.Native));
      GC.KeepAlive(pose);
    }

    /// <summary>Until when all is known, and the body that is waited for (-1: none).</summary>
    public long KnownUntil(out int waitsFor) {
      long us;
      Ft.Must(FtNative.ft_world_known_until(this, out us, out waitsFor));
      return us;
    }
    public void ForgetBefore(long timeUs) { Ft.Must(FtNative.ft_world_forget_before(this, timeUs)); }
    /// <summary>The instant before which all is forgotten; by memory (PoseBytes).</summary>
    public long ForgetBeyond(ulong bytes) {
      long us;
      Ft.Must(FtNative.ft_world_forget_beyond(this, bytes, out us));
      return us;
    }
    public ulong PoseBytes() {
      ulong bytes;
      Ft.Must(FtNative.ft_world_pose_bytes(this, out bytes));
      return bytes;
    }
    /// <summary>No point is ever farther than so many metres from where all poses have it.</summary>
    public void ThinBefore(long timeUs, double metres) {
      Ft.Must(FtNative.ft_world_thin_before(this, timeUs, metres));
    }

    public void Answer(long fromUs, long toUs) { Ft.Must(FtNative.ft_world_answer(this, fromUs, toUs)); }

    /// <summary>FtAsk.Clear, .Hit or .Unknown; then see Hits() and Unknown().</summary>
    public int Probe(FtQuestion question) {
      question.size = (uint)sizeof(FtQuestion);
      int verdict;
      Ft.Must(FtNative.ft_world_probe(this, &question, out verdict));
      return verdict;
    }

    /// <summary>Without these, and some bodies at instants of their own: a shot at what its player saw.</summary>
    public int Probe(FtQuestion question, ReadOnlySpan<FtAskPart> without, ReadOnlySpan<FtAskInstant> instants = default) {
      var whom = FtAskWhom.Usual;
      fixed (FtAskPart* parts = without)
      fixed (FtAskInstant* seen = instants) {
        whom.without = parts;
        whom.withoutCount = (ulong)without.Length;
        question.whom = &whom;
        question.instants = seen;
        question.instantCount = (ulong)instants.Length;
        return Probe(question);
      }
    }

    /// <summary>Many in one call, each with its answer alone; `probed` says how many of Hits() and Unknown() are whose.</summary>
    public void Probe(Span<FtQuestion> questions, Span<FtProbed> probed) {
      if (probed.Length < questions.Length) throw new ArgumentException("expected room for " + questions.Length, nameof(probed));
      for (int i = 0; i < questions.Length; ++i) questions[i].size = (uint)sizeof(FtQuestion);
      fixed (FtQuestion* all = questions)
      fixed (FtProbed* found = probed) Ft.Must(FtNative.ft_world_probe_many(this, all, (ulong)questions.Length, found));
    }

    /// <summary>The first hit of something that flies while the bodies move; see its `verdict`.</summary>
    public FtFlightHit Fly(FtFlight flight) {
      flight.size = (uint)sizeof(FtFlight);
      var hit = new FtFlightHit { size = (uint)sizeof(FtFlightHit) };
      Ft.Must(FtNative.ft_world_fly(this, &flight, &hit));
      return hit;
    }
  }
}
