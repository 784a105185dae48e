// ForetouchScene.cs: all meshes below an object, as what bodies touch.
#if UNITY_5_3_OR_NEWER
using UnityEngine;

namespace Foretouch {
  [AddComponentMenu("Foretouch/Foretouch Scene")]
  [DefaultExecutionOrder(-100)]
  public sealed class ForetouchScene : ForetouchComponent {
    FtScene made;

    /// <summary>As built when this was enabled: what moves since then is not seen. Rebuild() takes it anew.</summary>
    public FtScene Scene { get { return made; } }
    /// <summary>Counts up with each build.</summary>
    public int Version { get; private set; }

    public void Rebuild() {
      OnDisable();
      OnEnable();
    }

    void OnEnable() { bool isReady = IsReady; }

    protected override void Build() {
      made = SceneMaker.Make(Owner, UnityHost.Meshes(GetComponentsInChildren<MeshFilter>()), FtAxes.YUpLeft, Warn);
      ++Version;
    }
    void Warn(string message) { Debug.LogWarning(message, this); }
    protected override void Release() { Drop(ref made); }
  }
}
#endif
