// SPDX-License-Identifier: BSD-3-Clause
// This work is based on M. Alexa, J. Behr, D. Cohen-Or, S. Fleishman, D. Levin, C. T. Silva, "Computing and
// rendering point set surfaces", TVCG 2003: a bivariate polynomial over a local reference plane.
#include "height_fit.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace mlsmesh::core {
namespace {

template <int kTerms>
Eigen::Matrix<double, kTerms, 1> basis(double u, double v) {
  Eigen::Matrix<double, kTerms, 1> b;
  b[0] = 1;
  if constexpr (kTerms >= 3) {
    b[1] = u;
    b[2] = v;
  }
  if constexpr (kTerms >= 6) {
    b[3] = u * u;
    b[4] = u * v;
    b[5] = v * v;
  }
  if constexpr (kTerms >= 10) {
    b[6] = b[3] * u;
    b[7] = b[3] * v;
    b[8] = b[5] * u;
    b[9] = b[5] * v;
  }
  return b;
}

// Adds a b^T, of whose upper triangle the decomposition reads nothing; in steps of two columns, as the rest
// of each is added two numbers at a time.
template <int kTerms>
void addLower(const Eigen::Matrix<double, kTerms, 1>& a, const Eigen::Matrix<double, kTerms, 1>& b,
              Eigen::Matrix<double, kTerms, kTerms>& sum) {
  if constexpr (kTerms == 6) {
    sum.template block<6, 2>(0, 0).noalias() += a * b.template head<2>().transpose();
    sum.template block<4, 2>(2, 2).noalias() += a.template tail<4>() * b.template segment<2>(2).transpose();
    sum.template block<2, 2>(4, 4).noalias() += a.template tail<2>() * b.template tail<2>().transpose();
  } else {
    sum.noalias() += a * b.transpose();
  }
}

// Weighted least squares of the heights over the frame at `center`; lengths in units of the support. A small
// ridge on all but the constant keeps ill-posed fits finite without biasing good ones.
template <int kTerms>
Height fitHeight(const std::vector<Vec3>& points, const Vec3& center, const Frame& frame, double support,
                 const Neighborhood& around) {
  using Vector = Eigen::Matrix<double, kTerms, 1>;
  Eigen::Matrix<double, kTerms, kTerms> normal_matrix = Eigen::Matrix<double, kTerms, kTerms>::Zero();
  Vector right = Vector::Zero();
  for (int i = 0; i < around.count; ++i) {
    const Vec3 local = frame.axes.transpose() * (points[around.index[i]] - center) / support;
    const Vector b = basis<kTerms>(local[1], local[2]);
    const Vector weighted = around.weight[i] * b;
    addLower(weighted, b, normal_matrix);
    right += local[0] * weighted;
  }
  const double ridge = 1e-10 * normal_matrix(0, 0);
  for (int i = 1; i < kTerms; ++i) normal_matrix(i, i) += ridge;
  Height height;
  height.g.template head<kTerms>() = normal_matrix.ldlt().solve(right);
  height.valid = height.g.allFinite();
  return height;
}

Height fitHeight(int degree, const std::vector<Vec3>& points, const Vec3& center, const Frame& frame,
                 double support, const Neighborhood& around) {
  switch (degree) {
    case 0:
      return fitHeight<1>(points, center, frame, support, around);
    case 1:
      return fitHeight<3>(points, center, frame, support, around);
    case 2:
      return fitHeight<6>(points, center, frame, support, around);
    default:
      return fitHeight<10>(points, center, frame, support, around);
  }
}

}  // namespace

Frame principalFrame(const std::vector<Vec3>& points, const Vec3& origin, const Neighborhood& around) {
  double total = 0;
  Vec3 mean = Vec3::Zero();
  for (int i = 0; i < around.count; ++i) {
    mean += around.weight[i] * (points[around.index[i]] - origin);
    total += around.weight[i];
  }
  mean /= total;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (int i = 0; i < around.count; ++i) {
    const Vec3 d = points[around.index[i]] - origin - mean;
    covariance.noalias() += around.weight[i] * d * d.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(covariance);
  const Vec3 values = solver.eigenvalues().cwiseMax(0.0);
  const double sum = values.sum();
  return {origin + mean, solver.eigenvectors(), sum > 0 ? values[0] / sum : 0.0};
}

void fitWithFallback(const std::vector<Vec3>& points, int degree, double support, const Neighborhood& around,
                     Fit& fit) {
  fit.degree = degree;
  fit.height = fitHeight(fit.degree, points, fit.foot, fit.frame, support, around);
  while (!fit.height.valid && fit.degree > 0) {
    fit.height = fitHeight(--fit.degree, points, fit.foot, fit.frame, support, around);
  }
}

void fitInOneStep(const std::vector<Vec3>& points, const Vec3& x, int degree, double support,
                  const Neighborhood& around, Fit& fit) {
  fit.foot = x;
  fit.frame = principalFrame(points, x, around);
  fitWithFallback(points, degree, support, around, fit);
}

// Distance of neighbour i from the fitted polynomial along the normal of the frame.
double miss(const std::vector<Vec3>& points, const Fit& fit, double support, const Neighborhood& around,
            int i) {
  const Vec3 local = fit.frame.axes.transpose() * (points[around.index[i]] - fit.foot) / support;
  return support * (local[0] - fit.height.g.dot(basis<10>(local[1], local[2])));
}

double rmsResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                   const Neighborhood& around) {
  double sum = 0;
  double total = 0;
  for (int i = 0; i < around.count; ++i) {
    const double residual = miss(points, fit, support, around, i);
    sum += around.weight[i] * residual * residual;
    total += around.weight[i];
  }
  return std::sqrt(sum / total);
}

double medianResidual(const std::vector<Vec3>& points, const Fit& fit, double support,
                      const Neighborhood& around) {
  std::array<double, Neighborhood::kMost> residual;
  for (int i = 0; i < around.count; ++i) residual[i] = std::abs(miss(points, fit, support, around, i));
  std::nth_element(residual.begin(), residual.begin() + around.count / 2, residual.begin() + around.count);
  return residual[around.count / 2];
}

}  // namespace mlsmesh::core
