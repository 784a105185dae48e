// Touch.cs: what components report, in the engine's axes.
namespace Foretouch {
  /// <summary>A link that meets an object of the scene, between two fixed updates.</summary>
  public struct BodyTouch {
    /// <summary>The joint, by number and name, and the object.</summary>
    public int joint;
    public string jointName, objectName;
    /// <summary>True: it touched already where the step began. False: nothing before `share` of the step.</summary>
    public bool startsInContact;
    /// <summary>True: the question was given up at `share`; from there on nothing is claimed.</summary>
    public bool isUndecided;
    public double share;
    public Float3 point, normal;

    internal static BodyTouch Of(FtContact contact, FtAvatar avatar, FtScene scene, int axes) {
      return new BodyTouch {
        joint = contact.link, jointName = avatar.JointName(contact.link),
        objectName = contact.@object < 0 ? null : scene.ObjectName(contact.@object),
        startsInContact = contact.verdict == FtVerdict.StartsInContact, isUndecided = contact.verdict == FtVerdict.Undecided,
        share = contact.freeUntil, point = FtAxes.ToFloats(contact.pointScene, axes),
        normal = FtAxes.ToFloats(contact.normal, axes)
      };
    }
  }

  /// <summary>Where a surface holds a solid hand from its tracked place.</summary>
  public struct HandPress {
    public int joint;
    public string jointName, objectName;
    public Float3 point, normal;
    /// <summary>Metres; times a stiffness (N/m) it is a force.</summary>
    public double push;

    internal static HandPress Of(FtSolidContact contact, FtAvatar avatar, FtScene scene, int axes) {
      return new HandPress {
        joint = contact.link, jointName = avatar.JointName(contact.link),
        objectName = contact.@object < 0 ? null : scene.ObjectName(contact.@object),
        point = FtAxes.ToFloats(contact.point, axes), normal = FtAxes.ToFloats(contact.normal, axes), push = contact.push
      };
    }
  }

  /// <summary>A body enters or leaves another, or it is not known any more.</summary>
  public struct TouchEvent {
    /// <summary>FtEvent.Enter, .Leave, .StartsInside, .UnresolvedFrom or .UnresolvedTo.</summary>
    public int kind;
    /// <summary>Seconds since events are reported.</summary>
    public double time;
    /// <summary>`body` is the number that AddBody() and AddProp() returned; Ft.StillScene: what is still.</summary>
    public int body, otherBody;
    public string jointName, otherName;
    public Float3 point, normal;
    /// <summary>m/s along the normal, above zero while the two approach.</summary>
    public double approachSpeed;
  }
}
