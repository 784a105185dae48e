// FakeObjects.cs: game objects of FakeUnity.cs, as the sample makes them: components are enabled when they
// are added.
namespace UnityEngine {
  public enum PrimitiveType { Sphere, Cube }

  public sealed class GameObject : Object {
    public readonly Transform transform;

    public GameObject(string name) {
      transform = new Transform(name, null);
      this.name = name;
    }

    public T AddComponent<T>() where T : Component, new() {
      T added = transform.AddComponent<T>();
      var script = added as MonoBehaviour;
      if (script == null) return added;
      Player.Call(script, "Awake");
      Player.Scripts.Add(script);
      Player.Enable(script);
      return added;
    }

    public static GameObject CreatePrimitive(PrimitiveType kind) {
      var made = new GameObject(kind.ToString());
      var filter = made.transform.AddComponent<MeshFilter>();
      filter.sharedMesh = new Mesh();  // of the sphere, nothing is asked
      if (kind == PrimitiveType.Sphere) made.transform.AddComponent<SphereCollider>().radius = 0.5f;
      if (kind == PrimitiveType.Cube) FillCube(filter.sharedMesh);
      return made;
    }

    static void FillCube(Mesh mesh) {
      mesh.vertices = new Vector3[8];
      for (int i = 0; i < 8; ++i) mesh.vertices[i] = new Vector3((i & 1) - 0.5f, (i >> 1 & 1) - 0.5f, (i >> 2) - 0.5f);
      mesh.triangles = new[] { 0, 1, 3, 0, 3, 2, 4, 7, 5, 4, 6, 7, 0, 5, 1, 0, 4, 5, 2, 3, 7, 2, 7, 6, 0, 2, 6, 0, 6, 4, 1, 5, 7, 1, 7, 3 };
    }
  }

  public static class Mathf {
    public const float PI = (float)System.Math.PI;
    public static float Sin(float x) { return (float)System.Math.Sin(x); }
  }
}
