#@ -Eprecision=128
# articulated/robot.cpp, turned(), between(), valueOf(), boundRounding(); robot.md 2. M is the
# largest coordinate. One joint's quaternion: sine and cosine 2 u, the unit axis 4 u, the product
# with the rest pose 8 u, its normalisation 6 u: twice their sum as an angle, and on the arc 1.4
# of it. The coordinate at a cut: a difference of at most 2 M, its product with t, a sum; a
# mimic's product and sum. poseRounding() is twice the sum of what the constants give.
kTurnOfPose = 256 * 0x1p-53;
kTurnPerCoordinate = 8 * 0x1p-53;
quaternion = 2b-53 + 2b-53 + 4b-53 + 8b-53 + 6b-53 + 1b-53;
turn = 1.4 * 2 * quaternion + 8b-53;
perCoordinate = 1.4 * (2b-53 + 2b-53 + 1b-53 + 2b-53);
{ one in [1, 1] -> one * turn / (2 * kTurnOfPose) <= 1 /\ one * perCoordinate / (2 * kTurnPerCoordinate) <= 1 }
