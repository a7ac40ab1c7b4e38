// SPDX-License-Identifier: BSD-3-Clause
// This work is based on:
// - L. Kobbelt, S. Campagna, J. Vorsatz, H.-P. Seidel, "Interactive multi-resolution modeling on arbitrary
//   meshes", SIGGRAPH 1998: membrane and thin plate by umbrella operators.
// - M. Desbrun, M. Meyer, P. Schroeder, A. H. Barr, "Implicit fairing of irregular meshes using diffusion and
//   curvature flow", SIGGRAPH 1999: umbrellas weighted by the inverse lengths of the edges.
// Departure: the thin plate is the least-squares solution over the umbrellas of the patch and its rim, which
// is positive definite whatever the weights.
#include "patch_fairing.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>

namespace mlsmesh::core {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
using Entry = Eigen::Triplet<double>;
using Columns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

constexpr double kOnRim = 2;        // weight of an umbrella on the rim: small patches must not crease there
constexpr double kShortest = 1e-3;  // of the mean edge at a vertex: a shorter one weighs no more

const Vec3 kNowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());

// Not numbers where rounding leaves no solution: edges of very different lengths.
std::vector<Vec3> solve(const Sparse& matrix, const Columns& right) {
  const Eigen::SimplicialLDLT<Sparse> solver(matrix);
  std::vector<Vec3> rows(static_cast<std::size_t>(right.rows()), kNowhere);
  if (solver.info() != Eigen::Success) return rows;
  const Columns solution = solver.solve(right);
  for (std::size_t i = 0; i < rows.size(); ++i) rows[i] = solution.row(static_cast<Eigen::Index>(i));
  return rows;
}

// The linear equations of the patch's own vertices, the columns.
class Equations {
 public:
  Equations(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex)
      : mesh_(mesh), points_(points), first_(first_vertex) {}

  // The umbrella at a vertex is what its neighbours' weighted mean differs by from it.
  void addUmbrella(Index vertex, double weight) {
    double mean = 0;
    for (Index h = mesh_.firstOutgoing(vertex); h != kNone; h = mesh_.nextOutgoing(h)) mean += length(h);
    mean /= mesh_.degree(vertex);
    double sum = 0;
    for (Index h = mesh_.firstOutgoing(vertex); h != kNone; h = mesh_.nextOutgoing(h)) {
      sum += 1 / std::max(length(h), kShortest * mean);
    }
    // Curvature goes with the umbrella over the squared edge, and a vertex stands for a squared edge of area.
    right_.push_back(Vec3::Zero());
    for (Index h = mesh_.firstOutgoing(vertex); h != kNone; h = mesh_.nextOutgoing(h)) {
      add(mesh_.target(h), weight / (std::max(length(h), kShortest * mean) * sum * mean));
    }
    add(vertex, -weight / mean);
  }

  void addMeanOfNeighbors(Index vertex) {
    right_.push_back(Vec3::Zero());
    for (Index h = mesh_.firstOutgoing(vertex); h != kNone; h = mesh_.nextOutgoing(h))
      add(mesh_.target(h), -1);
    add(vertex, mesh_.degree(vertex));
  }

  Index size() const { return mesh_.vertexCount() - first_; }

  Sparse matrix() const {
    Sparse matrix(static_cast<Eigen::Index>(right_.size()), size());
    matrix.setFromTriplets(entries_.begin(), entries_.end());
    return matrix;
  }

  Columns right() const {
    Columns columns(static_cast<Eigen::Index>(right_.size()), 3);
    for (std::size_t i = 0; i < right_.size(); ++i) columns.row(static_cast<Eigen::Index>(i)) = right_[i];
    return columns;
  }

 private:
  double length(Index half_edge) const {
    return (points_[mesh_.target(half_edge)] - points_[mesh_.origin(half_edge)]).norm();
  }

  // Adds to the equation that was begun last.
  void add(Index vertex, double weight) {
    if (vertex < first_) {
      right_.back() -= weight * points_[vertex];
    } else {
      entries_.emplace_back(static_cast<Index>(right_.size()) - 1, vertex - first_, weight);
    }
  }

  const HalfEdgeMesh& mesh_;
  const std::vector<Vec3>& points_;
  const Index first_;
  std::vector<Entry> entries_;
  std::vector<Vec3> right_;
};

}  // namespace

std::vector<Vec3> membrane(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex) {
  Equations equations(mesh, points, first_vertex);
  for (Index v = first_vertex; v < mesh.vertexCount(); ++v) equations.addMeanOfNeighbors(v);
  return solve(equations.matrix(), equations.right());
}

std::vector<double> cushion(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex) {
  Equations equations(mesh, points, first_vertex);
  for (Index v = first_vertex; v < mesh.vertexCount(); ++v) equations.addMeanOfNeighbors(v);
  const std::vector<Vec3> load = solve(equations.matrix(), Columns::Ones(equations.size(), 3));
  std::vector<double> height(load.size());
  double beside_rim = 0;
  int count = 0;
  for (std::size_t i = 0; i < load.size(); ++i) {
    height[i] = std::sqrt(load[i].x());
    const Index v = first_vertex + static_cast<Index>(i);
    for (Index h = mesh.firstOutgoing(v); h != kNone; h = mesh.nextOutgoing(h)) {
      if (mesh.target(h) >= first_vertex) continue;
      beside_rim += height[i];
      ++count;
    }
  }
  for (double& h : height) h *= count / beside_rim;
  return height;
}

std::vector<Vec3> fairSurface(const HalfEdgeMesh& mesh, const std::vector<Vec3>& points, Index first_vertex,
                              const std::vector<Index>& rim) {
  Equations equations(mesh, points, first_vertex);
  for (Index v = first_vertex; v < mesh.vertexCount(); ++v) equations.addUmbrella(v, 1);
  for (const Index v : rim) equations.addUmbrella(v, kOnRim);
  const Sparse umbrellas = equations.matrix();
  const Sparse normal_matrix = umbrellas.transpose() * umbrellas;
  return solve(normal_matrix, umbrellas.transpose() * equations.right());
}

}  // namespace mlsmesh::core
