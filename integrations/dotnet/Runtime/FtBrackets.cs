// FtBrackets.cs: what a person surely touched between two poses, may have touched, and cannot have.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  public sealed unsafe partial class FtBrackets {
    public static FtBrackets Create(FtScene scene, FtAvatar avatar, FtBracketOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtBrackets brackets;
      Ft.Must(FtNative.ft_brackets_create(scene, avatar, options.HasValue ? &given : null, out brackets));
      return brackets;
    }

    /// <summary>A step of `seconds` between two poses, at FtBetween.ConstantRate, with a bound per link.</summary>
    public void Answer(FtPoseBuffer from, FtPoseBuffer to, double seconds, ReadOnlySpan<FtLinkBound> bounds) {
      FtPosedStep step = Step(from, to, seconds);
      fixed (FtLinkBound* first = &MemoryMarshal.GetReference(bounds))
        Ft.Must(FtNative.ft_brackets_answer(this, &step, first, (ulong)bounds.Length));
      GC.KeepAlive(from);
      GC.KeepAlive(to);
    }

    /// <summary>The same, where poses were lost in between.</summary>
    public void AnswerGap(FtPoseBuffer from, FtPoseBuffer to, double seconds, ReadOnlySpan<FtLinkBound> bounds) {
      FtPosedStep step = Step(from, to, seconds);
      fixed (FtLinkBound* first = &MemoryMarshal.GetReference(bounds))
        Ft.Must(FtNative.ft_brackets_answer_gap(this, &step, first, (ulong)bounds.Length));
      GC.KeepAlive(from);
      GC.KeepAlive(to);
    }

    /// <summary>For FtNative, with poses around it, and other ways between.</summary>
    public static FtPosedStep Step(FtPoseBuffer from, FtPoseBuffer to, double seconds) {
      FtPosedStep step = FtPosedStep.Usual;
      step.from = from.Native;
      step.to = to.Native;
      step.seconds = seconds;
      return step;
    }
  }
}
