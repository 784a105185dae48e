// Written by generator/generate.py of foretouch/mechanics.h. Change that, not this.
using System;
using System.Runtime.InteropServices;

namespace Foretouch {
  /// <summary>A point where a and b meet, as an ft_event has it.</summary>
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtCollisionPoint {
    public uint size;
    /// <summary>0</summary>
    public int reserved;
    /// <summary>unit, from b to a</summary>
    public FtVector normal;
    /// <summary>of a's point less b's</summary>
    public FtVector velocity;
    /// <summary>the sum of both; a body that nothing moves adds nothing</summary>
    public FtMatrix inverseMass;
    /// <summary>0 to 1</summary>
    public double restitution;
    /// <summary>Coulomb's coefficient, at least 0</summary>
    public double friction;
  }
  [StructLayout(LayoutKind.Sequential)]
  public partial struct FtCollisionImpulse {
    public uint size;
    /// <summary>1: they do not slide on each other afterwards</summary>
    public int sticks;
    /// <summary>N s; b gets the opposite</summary>
    public FtVector onA;
    /// <summary>the one applied: less where more would have made energy</summary>
    public double restitution;
    /// <summary>the one applied, as above</summary>
    public double friction;
    /// <summary>kg that meet along the normal; infinite if neither can be moved</summary>
    public double effectiveMass;
  }
  public static unsafe partial class FtNative {
    /// <summary>How a free rigid body's point answers an impulse there: velocity change per N s, row after
    /// row in inverse_mass[9], symmetric. `center[3]` and `inertia[9]` (about the centre) are in the body's
    /// frame, which `rotation` (w, x, y, z) and `translation` put into W; `point` is in W. Errors: a mass
    /// that nothing can have, a rotation that is not unit, numbers that are not finite.</summary>
    [DllImport(Library)] public static extern int ft_inverse_mass_at(double kg, double* center, double* inertia, double* rotation, double* translation, double* point, double* inverseMass);
    /// <summary>No impulse if they part, or if neither can be moved. It pushes, stays in the cone of
    /// friction, and never adds kinetic energy. Errors: numbers that are not finite, a restitution outside
    /// [0, 1], a friction below 0.</summary>
    [DllImport(Library)] public static extern int ft_collide(FtCollisionPoint* point, FtCollisionImpulse* impulse);
  }
}
