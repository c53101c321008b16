// Dynamics of robots with kinematic loops as expressions of CasADi, composed of Pinocchio's algorithms, in its coordinates.
#pragma once

#include <pinocchio/autodiff/casadi.hpp>

#include <algorithm>

#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "robot.hpp"

class Closed {
 public:
  using SX = casadi::SX;
  using Model = pinocchio::ModelTpl<SX>;
  using Data = pinocchio::DataTpl<SX>;
  using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

  Closed(const Model &model, const Loops &loops, const Vector &q) : model(model), loops(loops), data(model), q(q) {
    pinocchio::computeJointJacobians(model, data, q);
    for (const auto &[one, other] : loops.ends) {
      const Rows of_one = jacobian(one), of_other = jacobian(other);
      for (int axis = 0; axis < 3; ++axis) {
        const SX row = of_one[axis] - of_other[axis];
        // Across a planar linkage nothing moves.
        is_row.push_back(row.nnz() > 0);
        if (is_row.back()) k = SX::vertcat({k, row});
      }
    }
    const auto &actuated = loops.actuated;
    for (int i = 0; i < model.nv; ++i)
      (std::count(actuated.begin(), actuated.end(), i) ? motors : passive).push_back(i);
    // As many coordinates depend on the others as there are rows: those without a motor, or of a robot on its feet those with one.
    const bool of_motors = passive.size() != std::size_t(k.size1());
    free = of_motors ? passive : motors;
    dependent = of_motors ? motors : passive;
    if (casadi_int(dependent.size()) != k.size1()) throw std::runtime_error(model.name + ": rows that depend on each other");
    tree = k(all_rows(), dependent);
  }

  // The torques of the motors: the dependent velocities and accelerations by K, the tree's torques, and their projection.
  SX inverse(const Vector &qd, const Vector &qdd) {
    const SX g = map();
    const Vector v = vector(complete(g, column(qd), SX(dependent.size(), 1)));
    const SX at_rest = -SX::solve(tree, drift(v));
    const Vector a = vector(complete(g, column(qdd), at_rest));
    return project(g, column(pinocchio::rnea(model, data, q, v, a)));
  }

  // The accelerations by the system of M and K, factored as L D Lᵀ: the tree from its tips, then the rows of K.
  SX kkt(const Vector &qd, const Vector &tau) {
    const casadi_int n = model.nv, rows = k.size1();
    const SX drift = this->drift(qd);
    const SX rest = column(tau) - column(pinocchio::nonLinearEffects(model, data, q, qd));
    SX system(n + rows, n + rows), right(n + rows, 1);
    std::vector<casadi_int> order(n);
    for (casadi_int i = 0; i < n; ++i) order[i] = n - 1 - i;
    system = SX::blockcat({{mass_matrix()(order, order), k(all_rows(), order).T()}, {k(all_rows(), order), SX(rows, rows)}});
    right = SX::vertcat({rest(order), -drift});
    return ldl(system, right)(order);
  }

  // The accelerations by the coordinates that determine the motion: q̈ = G ÿ + ġ and Gᵀ M G ÿ = Gᵀ (τ − C − M ġ).
  SX projected(const Vector &qd, const Vector &tau) {
    const SX g = map();
    const SX drift = this->drift(qd);
    const SX at_rest = complete(SX(dependent.size(), free.size()), SX(model.nv, 1), -SX::solve(tree, drift));
    const SX rest = column(tau) - column(pinocchio::rnea(model, data, q, qd, vector(at_rest)));
    const SX m = mass_matrix();
    const SX across = m(dependent, free) + SX::mtimes(m(dependent, dependent), g);
    const SX reduced = m(free, free) + SX::mtimes(m(free, dependent), g) + SX::mtimes(g.T(), across);
    const SX ydd = ldl(reduced, project(g, rest));
    SX all(model.nv, 1);
    all(free) = ydd;
    return at_rest + complete(g, all, SX(dependent.size(), 1));
  }

 private:
  using Rows = std::array<SX, 3>;
  using Three = Eigen::Matrix<SX, 3, 1>;

  const Model &model;
  const Loops &loops;
  Data data;
  Vector q;
  // K and what of it belongs to the dependent coordinates.
  SX k = SX(0, 0), tree;
  std::vector<bool> is_row;
  std::vector<casadi_int> motors, passive, free, dependent;

  casadi::Slice all_rows() const { return casadi::Slice(); }

  // Entries that are not zero.
  template <typename Derived>
  static SX column(const Eigen::MatrixBase<Derived> &of) {
    SX result(of.rows(), 1);
    for (Eigen::Index i = 0; i < of.rows(); ++i)
      if (!SX(of(i)).is_zero()) result(i) = of(i);
    return result;
  }

  static Vector vector(const SX &of) {
    Vector result(of.size1());
    for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = of(i);
    return result;
  }

  // Of a point, the velocity's derivative by each velocity coordinate, in the base's axes.
  Rows jacobian(const Place &end) const {
    const auto point = data.oMi[end.first].act(end.second.translation().cast<SX>().eval()).eval();
    Rows rows;
    rows.fill(SX(1, model.nv));
    for (pinocchio::JointIndex joint = end.first; joint > 0; joint = model.parents[joint])
      for (int i = 0; i < model.joints[joint].nv(); ++i) {
        const int at = model.joints[joint].idx_v() + i;
        const Three angular = data.J.col(at).tail(3), linear = data.J.col(at).head(3);
        const Three moved = linear + angular.cross(point);
        for (int axis = 0; axis < 3; ++axis)
          if (!moved[axis].is_zero()) rows[axis](0, at) = moved[axis];
      }
    return rows;
  }

  // The acceleration of a point without that of the coordinates, in the base's axes.
  Three acceleration(const Place &end) const {
    const auto place = end.second.cast<SX>();
    const auto v = place.actInv(data.v[end.first]), a = place.actInv(data.a[end.first]);
    return data.oMi[end.first].rotation() * (place.rotation() * (a.linear() + v.angular().cross(v.linear())));
  }

  // K̇ q̇.
  SX drift(const Vector &qd) {
    pinocchio::forwardKinematics(model, data, q, qd, Vector::Zero(model.nv));
    SX result(0, 1);
    std::size_t row = 0;
    for (const auto &[one, other] : loops.ends) {
      const Three relative = acceleration(one) - acceleration(other);
      for (int axis = 0; axis < 3; ++axis)
        if (is_row[row++]) result = SX::vertcat({result, relative[axis]});
    }
    return result;
  }

  // G of the dependent coordinates.
  SX map() const { return -SX::solve(tree, k(all_rows(), free)); }

  // All coordinates from the free ones among `given`, with an offset of the dependent ones.
  SX complete(const SX &g, const SX &given, const SX &offset) const {
    SX all(model.nv, 1);
    all(free) = given(free);
    all(dependent) = SX::mtimes(g, given(free)) + offset;
    return all;
  }

  // Gᵀ.
  SX project(const SX &g, const SX &torques) const { return torques(free) + SX::mtimes(g.T(), torques(dependent)); }

  SX mass_matrix() {
    const auto &upper = pinocchio::crba(model, data, q);
    SX m(model.nv, model.nv);
    for (int i = 0; i < model.nv; ++i)
      for (int j = i; j < model.nv; ++j)
        if (!upper(i, j).is_zero()) m(i, j) = m(j, i) = upper(i, j);
    return m;
  }

  // In this order, without pivoting.
  static SX ldl(const SX &system, const SX &right) {
    SX d, lt;
    std::vector<casadi_int> order;
    SX::ldl(system, d, lt, order, false);
    return SX::ldl_solve(right, d, lt, order);
  }
};
