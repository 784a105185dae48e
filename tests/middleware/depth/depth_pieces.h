// tests/middleware/depth/depth_pieces.h: what is asked, in the judge's own types.
#pragma once

#include <vector>

#include "judge/depth_oracle.h"
#include "lss/lss.h"

namespace foretouch::test {

inline oracle::DepthPiece pieceOf(const Lss& lss) {
  return {2, {oracle::Vec3d(lss.a), oracle::Vec3d(lss.b), oracle::Vec3d(lss.b)}, lss.radius};
}
inline oracle::DepthPiece pieceOf(const Triangle& triangle) {
  const auto& v = triangle.vertices;
  return {3, {oracle::Vec3d(v[0]), oracle::Vec3d(v[1]), oracle::Vec3d(v[2])}, 0.0};
}
template <typename Piece>
std::vector<oracle::DepthPiece> piecesOf(const std::vector<Piece>& pieces) {
  std::vector<oracle::DepthPiece> all;
  for (const Piece& piece : pieces) all.push_back(pieceOf(piece));
  return all;
}

}  // namespace foretouch::test
