// Film.cs: the sample in the player of FakeUnity.cs, a line per fixed update: where the hand is tracked and where it
// is shown (x, y). For the picture of docs/integrations.md.
using System;
using System.Globalization;
using System.Linq;
using Foretouch;
using UnityEngine;

static class Film {
  static int Main() {
    new GameObject("Sample").AddComponent<HandOnDesk>();
    SolidHand hand = Player.Scripts.OfType<SolidHand>().Single();
    for (int frame = 0; frame < 200; ++frame) {
      Player.FixedUpdate(Player.Scripts.ToArray());
      Vector3 tracked = hand.tracked.transform.localPosition, shown = hand.shown[0].localPosition;
      Console.WriteLine(string.Format(CultureInfo.InvariantCulture, "film: {0:F6} {1:F6} {2:F6} {3:F6}", tracked.x, tracked.y, shown.x, shown.y));
    }
    return Debug.Errors.Count;
  }
}
