#include "tools/repair/banded.h"

#include <algorithm>

#include <Eigen/Cholesky>

namespace foretouch::tools {

using Eigen::MatrixXd;

BandedSystem::BandedSystem(std::size_t blocks, Eigen::Index size) : size_(size), blocks_(blocks) {
  for (auto& row : blocks_) row.fill(MatrixXd::Zero(size, size));
}

Eigen::VectorXd BandedSystem::times(const Eigen::VectorXd& x) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(x.size());
  const auto begin = [&](std::size_t at) { return static_cast<Eigen::Index>(at) * size_; };
  for (std::size_t at = 0; at < blocks_.size(); ++at) {
    product.segment(begin(at), size_).noalias() += blocks_[at][0] * x.segment(begin(at), size_);
    for (std::size_t back = 1; back <= std::min(kBand, at); ++back) {
      const MatrixXd& block = blocks_[at][back];
      product.segment(begin(at), size_).noalias() += block * x.segment(begin(at - back), size_);
      product.segment(begin(at - back), size_).noalias() +=
          block.transpose() * x.segment(begin(at), size_);
    }
  }
  return product;
}

bool BandedSystem::factorize() {
  for (std::size_t at = 0; at < blocks_.size(); ++at) {
    for (std::size_t back = std::min(kBand, at); back > 0; --back) {
      const std::size_t other = at - back;
      MatrixXd& block = blocks_[at][back];
      for (std::size_t further = back + 1; further <= std::min(kBand, at); ++further) {
        block.noalias() -= blocks_[at][further] * blocks_[other][further - back].transpose();
      }
      const MatrixXd& factor = blocks_[other][0];
      factor.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(block);
    }
    MatrixXd& own = blocks_[at][0];
    for (std::size_t back = 1; back <= std::min(kBand, at); ++back) {
      own.selfadjointView<Eigen::Lower>().rankUpdate(blocks_[at][back], -1.0);
    }
    Eigen::LLT<Eigen::Ref<MatrixXd>> factor(own);  // in place
    if (factor.info() != Eigen::Success) return false;
  }
  return true;
}

void BandedSystem::solve(Eigen::VectorXd& x) const {
  const auto part = [&](std::size_t at) {
    return x.segment(static_cast<Eigen::Index>(at) * size_, size_);
  };
  for (std::size_t at = 0; at < blocks_.size(); ++at) {
    for (std::size_t back = 1; back <= std::min(kBand, at); ++back) {
      part(at).noalias() -= blocks_[at][back] * part(at - back);
    }
    auto own = part(at);
    blocks_[at][0].triangularView<Eigen::Lower>().solveInPlace(own);
  }
  for (std::size_t at = blocks_.size(); at-- > 0;) {
    for (std::size_t back = 1; back <= kBand && at + back < blocks_.size(); ++back) {
      part(at).noalias() -= blocks_[at + back][back].transpose() * part(at + back);
    }
    auto own = part(at);
    blocks_[at][0].triangularView<Eigen::Lower>().transpose().solveInPlace(own);
  }
}

}  // namespace foretouch::tools
