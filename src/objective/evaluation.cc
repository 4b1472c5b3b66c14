// SPDX-License-Identifier: BSD-3-Clause
#include "icpscape/objective/evaluation.h"

#include <cmath>

namespace icpscape {

void Evaluation::Add(const BlockSums& block) {
  int entry = 0;
  for (int i = 0; i < 6; ++i) {
    for (int j = i; j < 6; ++j) {
      sums.hessian(i, j) += block.hessian[entry++];
    }
    sums.gradient[i] += block.gradient[i];
    epsilon_gradient[i] += block.epsilon_gradient[i];
  }
  sums.cost += block.cost;
  sums.num_correspondences += block.count;
  sums.upward_loss |= block.upward_loss;
  sum_squared += block.sum_squared;
  epsilon += block.epsilon;
}

void Evaluation::Add(const Evaluation& other, double weight) {
  NormalEquations scaled = other.sums;
  scaled.Scale(weight);
  sums += scaled;
  sum_squared += weight * other.sum_squared;
  epsilon += weight * other.epsilon;
  epsilon_gradient += weight * other.epsilon_gradient;
}

double Evaluation::Rmse() const { return std::sqrt(epsilon / static_cast<double>(n())); }

double Evaluation::RmsResidual() const { return std::sqrt(sum_squared / static_cast<double>(n())); }

double Evaluation::RmseSlope(const Vec6& body_twist) const {
  return epsilon_gradient.dot(body_twist) / (2 * static_cast<double>(n()) * Rmse());
}

}  // namespace icpscape
