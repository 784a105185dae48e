// examples/choreography.cpp: see the header.
#include "examples/choreography.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace foretouch::examples {
namespace {

/// Standing soles stay this far (m) above the floor: between two poses a few samples apart the
/// joints turn at constant rate, which lets a planted foot dip by up to about a centimetre. Nearer,
/// a standing person would touch the floor in most steps and say little about the room.
constexpr double kSoleClearance = 0.014;

// Every table: seconds first, then metres or degrees as in posture.h.

/// t, x, y, z, yaw of the hips.
constexpr double kHipsKeys[][5] = {
    // In through the string curtain (x = -1.7), faster than a stride a pose at 10 Hz.
    {0.00, -2.90, 0.94, -1.75, 90},
    {0.35, -2.93, 0.92, -1.75, 90},
    {0.70, -2.80, 0.86, -1.75, 90},
    {0.90, -2.45, 0.90, -1.73, 90},
    {1.00, -2.17, 0.96, -1.71, 90},
    {1.10, -1.86, 1.00, -1.70, 90},
    {1.20, -1.53, 1.02, -1.68, 90},
    {1.30, -1.22, 0.98, -1.66, 90},
    {1.42, -0.90, 0.90, -1.63, 90},
    {1.60, -0.60, 0.86, -1.60, 90},
    // Past the plant to the railing (z = -2.08), which is on the left hand.
    {2.00, -0.05, 0.93, -1.56, 90},
    {2.50, 0.75, 0.92, -1.52, 90},
    {2.90, 0.90, 0.90, -1.52, 86},
    {3.30, 0.80, 0.89, -1.54, 94},
    {3.70, 0.78, 0.92, -1.50, 90},
    // To the middle of the room, and more than two turns beside the floor lamp.
    {4.15, 0.40, 0.92, -0.80, 10},
    {4.60, 0.00, 0.92, -0.08, 0},
    {4.85, 0.00, 0.89, 0.02, -15},
    {5.00, 0.00, 0.93, 0.03, 10},
    {6.60, 0.00, 0.96, 0.03, 770},
    {6.85, 0.05, 0.91, -0.02, 812},
    // Kicks over the chair and at the table's edge.
    {7.20, 0.62, 0.92, -0.18, 810},
    {7.45, 0.70, 0.93, -0.18, 812},
    {7.65, 0.70, 0.94, -0.18, 830},
    {7.85, 0.68, 0.93, -0.18, 808},
    {8.10, 0.60, 0.91, -0.10, 810},
    {8.45, 0.52, 0.92, 0.45, 810},
    {8.75, 0.55, 0.93, 0.47, 805},
    // Reaches about the lamps on and over the table.
    {9.05, 0.64, 0.90, 0.72, 810},
    {9.80, 0.74, 0.91, 0.74, 810},
    {10.0, 0.66, 0.92, 0.74, 820},
    // Across to the coffee table, through its glass with a heel.
    {10.4, -0.10, 0.92, 0.86, 930},
    {10.8, -0.92, 0.91, 1.02, 985},
    {11.1, -1.00, 0.93, 1.05, 990},
    {11.4, -1.02, 0.92, 1.05, 985},
    // Through the floor lamp, and out through the strings.
    {11.7, -0.92, 0.90, 0.66, 930},
    {11.8, -0.86, 0.91, 0.41, 912},
    {11.9, -0.79, 0.92, 0.13, 905},
    {12.0, -0.73, 0.92, -0.15, 910},
    {12.3, -0.72, 0.92, -0.98, 945},
    {12.5, -0.98, 0.93, -1.40, 980},
    {12.7, -1.53, 1.00, -1.64, 990},
    {12.8, -1.87, 1.01, -1.69, 990},
    {12.9, -2.17, 0.97, -1.72, 990},
    {13.05, -2.48, 0.89, -1.75, 990},
    {13.3, -2.75, 0.87, -1.75, 990},
    {13.6, -2.85, 0.93, -1.75, 990}};

/// t, pitch and roll of the hips, twist, bend and lean of the chest.
constexpr double kTorsoKeys[][6] = {
    {0.00, 0, 0, 0, 2, 0},     {0.60, 6, 0, -15, 18, 0},  {0.95, 4, 0, 15, 8, 0},
    {1.20, 0, 0, 20, -6, 0},   {1.50, 6, 0, -8, 16, 0},   {2.00, 0, 0, 10, 4, 0},
    {2.55, 0, -3, -20, 4, -6}, {2.80, 0, -3, 25, 2, -8},  {3.10, 0, -3, -20, 4, -8},
    {3.40, 0, -3, 25, 2, -8},  {3.70, 0, 0, 0, 4, 0},     {4.15, 0, 0, 10, 6, 0},
    {4.85, 0, 0, -30, 6, 0},   {5.10, 0, 0, 10, -2, 0},   {6.50, 0, 0, 12, 0, 0},
    {6.85, 0, 0, -10, 5, 0},   {7.25, 0, 0, 12, 2, 0},    {7.55, -8, 0, -15, -8, 0},
    {8.10, 0, 0, 8, 8, 0},     {8.60, -6, 0, -15, -6, 0}, {9.05, 0, 0, 20, 12, 0},
    {9.25, 0, 0, -35, 18, 0},  {9.50, 0, 0, 32, 16, 0},   {9.75, 4, 0, -25, 14, 0},
    {10.1, 0, 0, 10, 5, 0},    {10.8, 0, 0, 0, 4, 0},     {11.05, -10, 0, -8, -6, 0},
    {11.4, 0, 0, 8, 14, 0},    {11.9, 4, 0, 12, 6, 0},    {12.2, 4, 0, -10, 8, 0},
    {12.5, 5, 0, -12, 10, 0},  {12.75, 0, 0, 15, -4, 0},  {13.1, 6, 0, -8, 16, 0},
    {13.6, 0, 0, 0, 2, 0}};

/// t, gaze, nod.
constexpr double kHeadKeys[][3] = {
    {0.0, 0, 0},   {0.7, 5, -5},  {1.2, -10, -8}, {2.4, 30, 5},  {3.5, 25, 8},  {4.1, -10, 0},
    {5.0, 25, 0},  {5.6, -20, 0}, {6.5, 15, 0},   {7.5, 0, 6},   {8.6, 5, 8},   {9.2, -5, 0},
    {9.7, 5, -18}, {10.3, 20, 0}, {11.1, 0, 10},  {11.8, 0, -3}, {12.7, 0, -5}, {13.6, 0, 0}};

/// A foot on its way between two places: ball of the foot and its height (m) at the end, the most
/// it rises above both ends in between, and the pitches (degrees) in between and at the end.
struct FootMove {
  double from, to, x, z, yaw, arc, pitchMid, height = 0.0, pitch = 0.0;
};
constexpr double kOnRug = 0.009;
constexpr FootMove kLeftMoves[] = {
    {0.00, 0.00, -2.84, -1.87, 85, 0, 0},
    {0.42, 0.66, -2.48, -1.85, 90, 0.07, 15},
    {1.02, 1.66, -0.42, -1.72, 90, 0.30, 45},
    {1.98, 2.32, 0.62, -1.62, 85, 0.08, 20},
    {2.85, 3.05, 0.72, -1.68, 76, 0.05, 12},
    {3.75, 4.05, 0.42, -0.85, 20, 0.08, 20},
    {4.36, 4.62, 0.10, 0.02, 0, 0.07, 15},
    {5.00, 6.60, 0.00, 0.05, 770, 0.02, 14},
    {6.60, 6.84, 0.00, 0.05, 800, 0.005, 12},
    {6.86, 7.15, 0.66, -0.32, 800, 0.07, 15},
    {8.12, 8.40, 0.55, 0.30, 800, 0.06, 15},
    {8.95, 9.15, 0.70, 0.58, 800, 0.05, 12},
    {10.0, 10.28, 0.06, 0.82, 905, 0.08, 20, 0.0, 22},
    {10.46, 10.76, -0.95, 1.18, 975, 0.09, 20, kOnRug},
    {11.46, 11.70, -0.98, 0.42, 920, 0.08, 20, kOnRug},
    {11.94, 12.24, -0.84, -0.84, 925, 0.10, 30},
    {12.52, 13.10, -2.62, -1.62, 990, 0.28, 20},
};
constexpr FootMove kRightMoves[] = {
    {0.00, 0.00, -2.84, -1.62, 95, 0, 0},
    {0.70, 1.36, -0.84, -1.58, 90, 0.34, 10},
    {1.66, 1.98, 0.22, -1.40, 92, 0.09, 20},
    {2.34, 2.62, 1.02, -1.36, 95, 0.07, 18},
    {3.45, 3.74, 0.70, -1.25, 50, 0.07, 18},
    {4.05, 4.34, -0.08, -0.30, -5, 0.08, 20},
    {4.66, 4.86, -0.16, 0.10, -20, 0.04, 12},
    {4.94, 5.20, -0.05, -0.02, 100, 0.0, 30, 0.35, 40},
    {5.20, 6.40, 0.02, -0.05, 690, 0.0, 40, 0.35, 40},
    {6.40, 6.70, 0.06, 0.14, 800, 0.0, 15},
    {7.02, 7.24, 0.55, -0.02, 815, 0.05, 15},
    {7.26, 7.46, 1.30, 0.25, 810, 0.0, 30, 0.75, 30},
    {7.46, 7.66, 1.45, -0.60, 830, 0.08, 30, 0.80, 30},
    {7.66, 7.86, 1.38, 0.22, 815, 0.05, 30, 0.70, 30},
    {7.86, 8.12, 0.52, 0.06, 815, 0.0, 30},
    {8.36, 8.52, 0.90, 0.52, 810, 0.0, 30, 0.30, 35},
    {8.52, 8.70, 1.32, 0.50, 810, 0.0, 0, 1.02, -25},
    {8.70, 8.95, 0.58, 0.72, 815, 0.0, 30},
    {9.20, 9.40, 0.60, 0.90, 815, 0.03, 12},
    {9.96, 10.20, 0.60, 0.90, 868, 0.01, 35, 0.0, 30},
    {10.20, 10.50, -0.42, 0.72, 945, 0.08, 20},
    {10.72, 11.02, -1.52, 1.02, 990, 0.0, -25, 0.95, -60},
    {11.02, 11.17, -1.62, 1.10, 990, 0.0, -35, 0.18, -15},
    {11.17, 11.46, -1.10, 0.72, 960, 0.22, 5, kOnRug},
    {11.68, 11.96, -0.64, -0.30, 915, 0.09, 30},
    {12.22, 12.50, -1.12, -1.58, 980, 0.10, 30},
    {12.70, 13.32, -2.84, -1.87, 990, 0.25, 45},
};

/// t, the wrist to its side, up and forward, grip.
constexpr double kLeftHandKeys[][5] = {
    {0.00, 0.24, -0.50, 0.05, 0.2},  {0.70, 0.30, -0.38, -0.28, 0.3},
    {1.10, 0.25, 0.15, 0.50, 0.1},   {1.50, 0.50, -0.05, 0.25, 0.1},
    {1.75, 0.30, -0.35, 0.20, 0.2},  {2.05, 0.45, -0.30, -0.25, 0.2},
    {2.54, 0.50, -0.08, 0.46, 0.1},  {2.78, 0.66, -0.10, -0.10, 0.1},
    {3.10, 0.50, -0.05, 0.46, 0.1},  {3.36, 0.66, -0.12, -0.12, 0.1},
    {3.70, 0.30, -0.40, 0.10, 0.2},  {4.20, 0.30, -0.30, 0.30, 0.2},
    {4.85, 0.55, -0.05, 0.35, 0.0},  {5.10, 0.68, -0.08, 0.05, 0.0},
    {6.40, 0.68, -0.10, 0.05, 0.0},  {6.85, 0.35, -0.25, 0.30, 0.4},
    {7.25, 0.30, -0.15, 0.35, 0.6},  {7.60, 0.55, -0.15, -0.20, 0.6},
    {8.05, 0.30, -0.20, 0.30, 0.6},  {8.60, 0.50, -0.15, -0.15, 0.6},
    {9.02, 0.55, -0.20, 0.20, 1.0},  {9.25, 0.05, -0.42, 0.50, 1.0},
    {9.50, 0.35, 0.20, 0.30, 0.2},   {9.75, 0.00, 0.38, 0.55, 0.0},
    {10.1, 0.35, -0.30, 0.25, 0.2},  {10.5, 0.28, -0.38, -0.15, 0.2},
    {11.0, 0.55, -0.05, 0.10, 0.3},  {11.5, 0.26, -0.30, 0.30, 0.3},
    {11.8, 0.28, -0.38, -0.20, 0.3}, {12.1, 0.26, -0.25, 0.32, 0.3},
    {12.4, 0.28, -0.38, -0.28, 0.3}, {12.7, 0.25, 0.15, 0.50, 0.1},
    {13.1, 0.45, -0.10, 0.20, 0.1},  {13.6, 0.24, -0.50, 0.05, 0.2}};
constexpr double kRightHandKeys[][5] = {
    {0.00, 0.24, -0.50, 0.05, 0.2},  {0.70, 0.26, -0.30, 0.30, 0.3},
    {1.10, 0.50, 0.05, -0.25, 0.1},  {1.50, 0.35, -0.25, 0.30, 0.1},
    {2.00, 0.26, -0.38, 0.22, 0.2},  {2.60, 0.50, 0.00, 0.15, 0.1},
    {3.10, 0.35, 0.35, 0.20, 0.1},   {3.60, 0.50, 0.00, 0.10, 0.1},
    {4.20, 0.28, -0.38, -0.10, 0.2}, {4.85, 0.20, -0.10, 0.50, 0.0},
    {5.10, 0.68, -0.08, 0.05, 0.0},  {6.40, 0.68, -0.10, 0.05, 0.0},
    {6.85, 0.40, -0.25, 0.25, 0.4},  {7.25, 0.35, -0.10, 0.30, 0.6},
    {7.60, 0.40, -0.10, 0.30, 0.6},  {8.05, 0.28, -0.20, 0.35, 0.6},
    {8.60, 0.40, -0.15, 0.25, 0.6},  {9.02, 0.30, -0.20, 0.30, 1.0},
    {9.30, 0.40, -0.30, 0.10, 1.0},  {9.52, 0.02, -0.36, 0.54, 1.0},
    {9.80, 0.45, -0.20, 0.10, 0.5},  {10.3, 0.28, -0.38, 0.10, 0.2},
    {10.7, 0.26, -0.30, 0.25, 0.2},  {11.0, 0.55, 0.05, 0.00, 0.3},
    {11.5, 0.28, -0.38, -0.20, 0.3}, {11.8, 0.26, -0.25, 0.32, 0.3},
    {12.1, 0.28, -0.38, -0.22, 0.3}, {12.4, 0.26, -0.30, 0.30, 0.3},
    {12.7, 0.50, 0.05, -0.25, 0.1},  {13.1, 0.35, -0.25, 0.30, 0.1},
    {13.6, 0.24, -0.50, 0.05, 0.2}};

template <std::size_t kRows, std::size_t kColumns>
void addKeys(const double (&rows)[kRows][kColumns],
             const std::array<Track*, kColumns - 1>& tracks) {
  for (const double(&row)[kColumns] : rows) {
    for (std::size_t k = 1; k < kColumns; ++k) {
      tracks[k - 1]->key(row[0], row[k]);
    }
  }
}

}  // namespace

Choreography::Choreography() {
  addKeys(kHipsKeys, {&x_, &y_, &z_, &yaw_});
  addKeys(kTorsoKeys, {&pitch_, &roll_, &twist_, &bend_, &lean_});
  addKeys(kHeadKeys, {&gaze_, &nod_});
  addKeys(kLeftHandKeys, {&leftHand_.out, &leftHand_.up, &leftHand_.forward, &leftHand_.grip});
  addKeys(kRightHandKeys, {&rightHand_.out, &rightHand_.up, &rightHand_.forward, &rightHand_.grip});
  setFeet();
}

void Choreography::setFeet() {
  const auto move = [](FootTracks& foot, const FootMove& m) {
    const double end = kSoleClearance + m.height;
    if (m.to > m.from) {  // holds what it had until now
      for (Track* track : {&foot.x, &foot.y, &foot.z, &foot.yaw, &foot.pitch}) {
        track->key(m.from, track->last());
      }
      const double middle = 0.5 * (m.from + m.to), start = foot.y.last();
      if (m.arc > 0.0) {
        foot.y.key(middle, std::max(start, end) + m.arc);
      }
      foot.pitch.key(middle, m.pitchMid);
    }
    foot.x.key(m.to, m.x);
    foot.y.key(m.to, end);
    foot.z.key(m.to, m.z);
    foot.yaw.key(m.to, m.yaw);
    foot.pitch.key(m.to, m.pitch);
  };
  for (const FootMove& m : kLeftMoves) {
    move(leftFoot_, m);
  }
  for (const FootMove& m : kRightMoves) {
    move(rightFoot_, m);
  }
}

Posture::Foot Choreography::FootTracks::at(double timeS) const {
  return {{x.at(timeS), y.at(timeS), z.at(timeS)}, yaw.at(timeS), pitch.at(timeS)};
}

Posture::Hand Choreography::HandTracks::at(double timeS) const {
  return {{out.at(timeS), up.at(timeS), forward.at(timeS)}, grip.at(timeS)};
}

Posture Choreography::at(double timeS) const {
  Posture p;
  p.hips = {x_.at(timeS), y_.at(timeS), z_.at(timeS)};
  p.yaw = yaw_.at(timeS);
  p.pitch = pitch_.at(timeS);
  p.roll = roll_.at(timeS);
  p.twist = twist_.at(timeS);
  p.bend = bend_.at(timeS);
  p.lean = lean_.at(timeS);
  p.gaze = gaze_.at(timeS);
  p.nod = nod_.at(timeS);
  p.leftFoot = leftFoot_.at(timeS);
  p.rightFoot = rightFoot_.at(timeS);
  p.leftHand = leftHand_.at(timeS);
  p.rightHand = rightHand_.at(timeS);
  return p;
}

}  // namespace foretouch::examples
