// FakeUnity.cs: as much of UnityEngine as Runtime/Unity uses, with Unity's manners: what was destroyed
// equals null, fixed updates come in the order of execution, and a reload of scripts disables and enables.
using System;
using System.Collections.Generic;
using System.Reflection;

namespace UnityEngine {
  public struct Vector3 {
    public float x, y, z;
    public Vector3(float x, float y, float z) { this.x = x; this.y = y; this.z = z; }
    public static Vector3 operator +(Vector3 a, Vector3 b) { return new Vector3(a.x + b.x, a.y + b.y, a.z + b.z); }
    public static Vector3 Scale(Vector3 a, Vector3 b) { return new Vector3(a.x * b.x, a.y * b.y, a.z * b.z); }
  }

  public struct Quaternion {
    public float x, y, z, w;
    public Quaternion(float x, float y, float z, float w) { this.x = x; this.y = y; this.z = z; this.w = w; }
    public static readonly Quaternion identity = new Quaternion(0, 0, 0, 1);
    public static Quaternion operator *(Quaternion a, Quaternion b) {
      return new Quaternion(a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                            a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z);
    }
    public static Vector3 operator *(Quaternion q, Vector3 v) {
      var turned = q * new Quaternion(v.x, v.y, v.z, 0) * new Quaternion(-q.x, -q.y, -q.z, q.w);
      return new Vector3(turned.x, turned.y, turned.z);
    }
  }

  /// The scale in the world of a transform whose scales do not skew.
  public struct Matrix4x4 {
    internal Transform of;
    public Vector3 MultiplyPoint3x4(Vector3 v) { return of.position + MultiplyVector(v); }
    public Vector3 MultiplyVector(Vector3 v) { return of.rotation * Vector3.Scale(of.lossyScale, v); }
  }

  public class Object {
    public string name = "";
    internal bool isDestroyed;
    public static bool operator ==(Object a, Object b) {
      bool noA = ReferenceEquals(a, null) || a.isDestroyed, noB = ReferenceEquals(b, null) || b.isDestroyed;
      return noA || noB ? noA && noB : ReferenceEquals(a, b);
    }
    public static bool operator !=(Object a, Object b) { return !(a == b); }
    public override bool Equals(object other) { return this == other as Object; }
    public override int GetHashCode() { return 0; }
  }

  public class Component : Object {
    public Transform transform;
    public T[] GetComponents<T>() where T : class {
      var found = new List<T>();
      foreach (Component one in transform.components) if (one is T) found.Add(one as T);
      return found.ToArray();
    }
    public T[] GetComponentsInChildren<T>() where T : class {
      var found = new List<T>(GetComponents<T>());
      foreach (Transform child in transform.children) found.AddRange(child.GetComponentsInChildren<T>());
      return found.ToArray();
    }
  }

  public class Transform : Component {
    internal readonly List<Component> components = new List<Component>();
    internal readonly List<Transform> children = new List<Transform>();
    public Transform parent;
    public Vector3 localPosition, localScale = new Vector3(1, 1, 1);
    public Quaternion localRotation = Quaternion.identity;
    public Transform(string name, Transform parent) {
      this.name = name;
      this.parent = parent;
      transform = this;
      components.Add(this);
      if (parent != null) parent.children.Add(this);
    }
    public Vector3 position {
      get { return parent == null ? localPosition : parent.position + parent.rotation * Vector3.Scale(parent.lossyScale, localPosition); }
    }
    public Quaternion rotation { get { return parent == null ? localRotation : parent.rotation * localRotation; } }
    public Vector3 lossyScale { get { return parent == null ? localScale : Vector3.Scale(parent.lossyScale, localScale); } }
    public Matrix4x4 localToWorldMatrix { get { return new Matrix4x4 { of = this }; } }
    /// For roots only: those that hands are shown by in the tests.
    public void SetPositionAndRotation(Vector3 to, Quaternion turn) {
      if (parent != null) throw new NotSupportedException("only of roots");
      localPosition = to;
      localRotation = turn;
    }
    public void SetParent(Transform to, bool worldPositionStays) {
      if (worldPositionStays) throw new NotSupportedException("only in place");
      parent = to;
      to.children.Add(this);
    }
    public T AddComponent<T>() where T : Component, new() {
      var added = new T { transform = this, name = name };
      components.Add(added);
      return added;
    }
  }

  public class Behaviour : Component {
    public bool enabled = true;
    public bool isActiveAndEnabled { get { return enabled && !isDestroyed; } }
  }
  public class MonoBehaviour : Behaviour {}

  public class Mesh : Object {
    public Vector3[] vertices = new Vector3[0];
    public int[] triangles = new int[0];
    public bool isReadable = true;
  }
  public class MeshFilter : Component { public Mesh sharedMesh; }
  public class CapsuleCollider : Component {
    public Vector3 center;
    public float radius, height;
    public int direction;
  }
  public class SphereCollider : Component {
    public Vector3 center;
    public float radius;
  }

  public static class Time { public static float fixedDeltaTime = 0.02f; }

  public static class Debug {
    public static readonly List<string> Errors = new List<string>(), Warnings = new List<string>();
    public static void LogError(string message, Object about) { Errors.Add(message); }
    public static void LogWarning(string message, Object about) { Warnings.Add(message); }
  }

  [AttributeUsage(AttributeTargets.Class)]
  public sealed class AddComponentMenu : Attribute { public AddComponentMenu(string menu) {} }
  [AttributeUsage(AttributeTargets.Class)]
  public sealed class DefaultExecutionOrder : Attribute { public DefaultExecutionOrder(int order) {} }
  [AttributeUsage(AttributeTargets.Field)]
  public sealed class TooltipAttribute : Attribute { public TooltipAttribute(string text) {} }

  /// The player's loop, as a test drives it.
  public static class Player {
    /// The game objects' scripts: all that get fixed updates.
    public static readonly List<MonoBehaviour> Scripts = new List<MonoBehaviour>();
    public static void Call(MonoBehaviour of, string message, params object[] arguments) {
      MethodInfo method = null;
      for (Type type = of.GetType(); method == null && type != null; type = type.BaseType)
        method = type.GetMethod(message, BindingFlags.NonPublic | BindingFlags.Public | BindingFlags.Instance | BindingFlags.DeclaredOnly);
      if (method == null) return;
      try {
        method.Invoke(of, arguments);
      } catch (TargetInvocationException reason) {
        throw new Exception(of.name + "." + message + ": " + reason.InnerException, reason.InnerException);
      }
    }
    public static void Enable(MonoBehaviour one) {
      one.enabled = true;
      Call(one, "OnEnable");
    }
    public static void Disable(MonoBehaviour one) {
      one.enabled = false;
      Call(one, "OnDisable");
    }
    public static void Destroy(MonoBehaviour one) {
      if (one.enabled) Call(one, "OnDisable");
      one.isDestroyed = true;
    }
    public static void Destroy(Transform one) { one.isDestroyed = true; }
    public static void FixedUpdate(params MonoBehaviour[] all) {
      foreach (MonoBehaviour one in all) if (one.isActiveAndEnabled) Call(one, "FixedUpdate");
    }
    public static void Pause(params MonoBehaviour[] all) {
      foreach (bool isPaused in new[] { true, false })
        foreach (MonoBehaviour one in all) Call(one, "OnApplicationPause", isPaused);
    }
    /// As the editor does when scripts were changed.
    public static void Reload(params MonoBehaviour[] all) {
      foreach (MonoBehaviour one in all) if (one.enabled) Call(one, "OnDisable");
      foreach (MonoBehaviour one in all) if (one.enabled) Call(one, "OnEnable");
    }
  }
}
