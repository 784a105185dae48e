// FtQuery.cs: what each link meets first between two poses, and which own links are asked.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>For one thread at a time. What it returns stays as it is until the same is asked again.</summary>
  public sealed unsafe partial class FtQuery {
    readonly FtBuffer<FtContact> pairs = new FtBuffer<FtContact>();
    FtOtherLink[] others = new FtOtherLink[1];

    public static FtQuery Create(FtScene scene, FtAvatar avatar, FtQueryOptions? options = null) {
      Ft.CheckLibrary();
      var given = options.GetValueOrDefault();
      FtQuery query;
      Ft.Must(FtNative.ft_query_create(scene, avatar, options.HasValue ? &given : null, out query));
      return query;
    }

    public void SetOptions(FtQueryOptions options) { Ft.Must(FtNative.ft_query_set_options(this, &options)); }
    /// <summary>Own links are asked, too; FtPairRules.None: no longer.</summary>
    public void SetPairRules(FtPairRules rules) { Ft.Must(FtNative.ft_query_set_pair_rules(this, rules)); }

    /// <summary>The first pose, or the first after a gap: the next step begins here.</summary>
    public void Begin(FtPoseBuffer at) { Step(at, at); }

    /// <summary>From where the last step ended.</summary>
    public void Step(FtPoseBuffer to) {
      Ft.Must(FtNative.ft_query_step(this, null, to.Native));
      GC.KeepAlive(to);
    }

    public void Step(FtPoseBuffer from, FtPoseBuffer to) {
      Ft.Must(FtNative.ft_query_step(this, from.Native, to.Native));
      GC.KeepAlive(from);
      GC.KeepAlive(to);
    }

    /// <summary>With pair rules: own links that are not clear of each other, and for each the other one.</summary>
    public ReadOnlySpan<FtContact> Pairs(out ReadOnlySpan<FtOtherLink> otherLinks) {
      ulong count;
      int status;
      do {
        if (others.Length < pairs.Items.Length) others = new FtOtherLink[pairs.Items.Length];
        fixed (FtContact* first = pairs.Items) fixed (FtOtherLink* other = others) {
          first->size = (uint)sizeof(FtContact);
          status = FtNative.ft_query_pairs(this, first, other, pairs.Capacity, out count);
        }
      } while (pairs.HasGrown(status, count));
      otherLinks = new ReadOnlySpan<FtOtherLink>(others, 0, (int)count);
      return pairs.First(count);
    }

    /// <summary>What a check of only that instant would see.</summary>
    public bool TouchesAt(int link, double t) {
      int touches;
      Ft.Must(FtNative.ft_touches_at(this, link, t, out touches));
      return touches != 0;
    }
  }

  public sealed unsafe partial class FtPairRules {
    /// <summary>Leaves out neighbours, and what overlaps at rest.</summary>
    public static FtPairRules Create(FtAvatar avatar, FtPairRuleOptions? options = null) {
      var given = options.GetValueOrDefault();
      FtPairRules rules;
      Ft.Must(FtNative.ft_pair_rules_create(avatar, options.HasValue ? &given : null, out rules));
      return rules;
    }

    public static FtPairRules Load(string path, FtAvatar avatar) {
      FtPairRules rules;
      fixed (byte* text = Ft.Utf8(path)) Ft.Must(FtNative.ft_pair_rules_create_from_file(text, avatar, out rules));
      return rules;
    }
  }
}
