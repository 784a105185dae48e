// Rigid.cs: places in the world, and in the frame of a parent, in doubles.
namespace Foretouch {
  struct Rigid {
    internal FtRotation rotation;
    internal FtVector position;

    static FtVector Turned(FtRotation q, FtVector v) {
      // v + 2 w (u x v) + 2 u x (u x v), for a unit q = (w, u).
      double x = 2 * (q.y * v.z - q.z * v.y), y = 2 * (q.z * v.x - q.x * v.z), z = 2 * (q.x * v.y - q.y * v.x);
      return new FtVector(v.x + q.w * x + q.y * z - q.z * y, v.y + q.w * y + q.z * x - q.x * z, v.z + q.w * z + q.x * y - q.y * x);
    }

    static FtRotation Product(FtRotation a, FtRotation b) {
      return new FtRotation(a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w);
    }

    /// The place in the world of what has `local` in this frame.
    internal Rigid Times(Rigid local) {
      FtVector turned = Turned(rotation, local.position);
      return new Rigid {
        rotation = Product(rotation, local.rotation),
        position = new FtVector(position.x + turned.x, position.y + turned.y, position.z + turned.z)
      };
    }

    /// The other way round: where `world` is in this frame.
    internal Rigid Local(Rigid world) {
      var back = new FtRotation(rotation.w, -rotation.x, -rotation.y, -rotation.z);
      var apart = new FtVector(world.position.x - position.x, world.position.y - position.y, world.position.z - position.z);
      return new Rigid { rotation = Product(back, world.rotation), position = Turned(back, apart) };
    }
  }
}
