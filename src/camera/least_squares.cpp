// Copyright (c) 2026, trk_bridge maintainers. SPDX-License-Identifier: BSD-3-Clause
#include "least_squares.h"

#include <Eigen/QR>

namespace trk_bridge::camera {

Unknowns least_squares(const Terms& terms, const Values& wanted) noexcept {
  const Eigen::ColPivHouseholderQR<Terms> qr(terms);
  Values values = wanted;
  // Applies the reflections and the permutation one by one: solve() and householderQ() do the same, but take more time
  // to compile than all the rest.
  for (Eigen::Index i = 0; i < terms.cols(); ++i) {
    const Eigen::Index below = terms.rows() - i - 1;
    double workspace = 0;
    values.tail(below + 1).applyHouseholderOnTheLeft(qr.matrixQR().col(i).tail(below), qr.hCoeffs()[i], &workspace);
  }
  const Eigen::Index rank = qr.rank();
  qr.matrixQR().topLeftCorner(rank, rank).triangularView<Eigen::Upper>().solveInPlace(values.head(rank));
  Unknowns x = Unknowns::Zero(terms.cols());
  for (Eigen::Index i = 0; i < rank; ++i) x[qr.colsPermutation().indices()[i]] = values[i];
  return x;
}

}  // namespace trk_bridge::camera
