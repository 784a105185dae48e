// ForetouchComponent.cs: what all components share: they build when they are first needed, so that it does
// not matter which one Unity enables first, nor that fields are set after a component was added; they
// release when they are disabled (as Unity does to all before it reloads scripts), and say once what is wrong.
#if UNITY_5_3_OR_NEWER
using System;
using UnityEngine;

namespace Foretouch {
  public abstract class ForetouchComponent : MonoBehaviour {
    bool isBuilt;

    /// <summary>Makes handles; Release() disposes of those that were made, also of half of them.</summary>
    protected abstract void Build();
    protected abstract void Release();
    protected string Owner { get { return GetType().Name + " '" + name + "'"; } }

    /// <summary>Built, if need be: a component asks this of another that it needs at the begin. False: it is
    /// disabled, or something is wrong, and it has said what.</summary>
    public bool IsReady {
      get {
        if (!isBuilt && isActiveAndEnabled) Try(BuildOnce);
        return isBuilt;
      }
    }

    void BuildOnce() {
      Build();
      isBuilt = true;
    }

    /// <summary>Runs it; if the engine gave something wrong, says so and disables this.</summary>
    protected void Try(Action action) {
      try {
        action();
        return;
      } catch (HostProblem problem) {
        Debug.LogError(problem.Message, this);
      } catch (ForetouchException problem) {
        Debug.LogError(Owner + ": " + problem.Message, this);
      } catch (DllNotFoundException problem) {
        Debug.LogError(Owner + ": " + problem.Message, this);
      }
      OnDisable();
      enabled = false;
    }

    protected virtual void OnDisable() {
      isBuilt = false;
      Release();
    }

    /// <summary>A scene that another component uses; says so if it is not there any more.</summary>
    protected FtScene SceneOf(ForetouchScene scene) {
      if (scene == null)
        throw new HostProblem(Owner + ": its ForetouchScene is missing or was destroyed: assign one, and enable it again");
      if (!scene.IsReady) throw new HostProblem(Owner + ": its " + scene.Owner + " is disabled, or has said what is wrong");
      return scene.Scene;
    }

    protected static void Drop<T>(ref T handle) where T : class, IDisposable {
      if (handle != null) handle.Dispose();
      handle = null;
    }
  }
}
#endif
