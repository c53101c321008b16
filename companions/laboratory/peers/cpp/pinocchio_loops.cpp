// Pinocchio's dynamics of robots with kinematic loops behind the C interface of the benchmark, in f64.
//
//     void *pinocchio_loops_open(const char *machine);
//     void pinocchio_loops_<inverse or forward>(void *, const double *states, size_t count, double *out);
//
// A machine is a robot with its loops as `robot.hpp` reads them; redundant constraints need the proximal solver's mu. A
// state is q, q̇ and q̈ in a row, in forward dynamics q, q̇ and τ of every joint. Inverse dynamics writes the torques of the
// actuated coordinates, forward dynamics all accelerations.

#define PINOCCHIO_DISABLE_UNSUPPORTED_WARNINGS
#include <algorithm>
#include <cstddef>
#include <iostream>
#include <sstream>

#include <Eigen/LU>
#include <Eigen/QR>

#include <pinocchio/algorithm/constrained-dynamics.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "robot.hpp"

#define EXPORT extern "C" __attribute__((visibility("default")))

using Eigen::MatrixXd;
using Eigen::VectorXd;
using View = Eigen::Map<const VectorXd>;

struct Machine {
  pinocchio::Model model;
  pinocchio::Data data;
  PINOCCHIO_ALIGNED_STD_VECTOR(pinocchio::RigidConstraintModel) loops;
  PINOCCHIO_ALIGNED_STD_VECTOR(pinocchio::RigidConstraintData) loop_data;
  pinocchio::ProximalSettings settings;
  std::vector<int> actuated, dependent;
  MatrixXd k, k_dependent;
  VectorXd v, a, zero, drift, right, part;
  Eigen::PartialPivLU<MatrixXd> lu;
  Eigen::ColPivHouseholderQR<MatrixXd> qr;

  explicit Machine(std::istream &in) {
    Placed placed;
    model = pinocchio_model(read_robot(in), Position::angle, &placed);
    data = pinocchio::Data(model);
    const Loops given = read_loops(in, placed);
    for (const auto &[one, other] : given.ends)
      loops.emplace_back(pinocchio::CONTACT_3D, model, one.first, one.second, other.first, other.second,
                         pinocchio::LOCAL_WORLD_ALIGNED);
    actuated = given.actuated;
    for (int i = 0; i < model.nv; ++i)
      if (!std::count(actuated.begin(), actuated.end(), i)) dependent.push_back(i);
    for (const auto &loop : loops) loop_data.emplace_back(loop);
    if (given.mu > 0.0) settings = pinocchio::ProximalSettings(1e-12, given.mu, 20);
    pinocchio::initConstraintDynamics(model, data, loops, loop_data);
    k = MatrixXd::Zero(3 * loops.size(), model.nv);
    k_dependent = MatrixXd::Zero(k.rows(), dependent.size());
    v = a = zero = VectorXd::Zero(model.nv);
    drift = right = VectorXd::Zero(k.rows());
    part = VectorXd::Zero(dependent.size());
  }

  bool is_square() const { return k_dependent.rows() == k_dependent.cols(); }

  // Dependent coordinates with K x = -rest, for given actuated ones.
  void complete(VectorXd &x, const VectorXd &rest) {
    right = -rest;
    for (int index : actuated) right.noalias() -= k.col(index) * x[index];
    if (is_square()) part = lu.solve(right);
    else part = qr.solve(right);
    for (std::size_t i = 0; i < dependent.size(); ++i) x[dependent[i]] = part[i];
  }

  // The acceleration of an end of a loop in the base's axes.
  static Eigen::Vector3d acceleration(const pinocchio::Data &data, pinocchio::JointIndex joint,
                                      const pinocchio::SE3 &place, const pinocchio::SE3 &in_base) {
    const pinocchio::Motion v = place.actInv(data.v[joint]), a = place.actInv(data.a[joint]);
    return in_base.rotation() * (a.linear() + v.angular().cross(v.linear()));
  }

  // The composition is the benchmark's own, of Pinocchio's algorithms: velocities and accelerations of the
  // dependent coordinates by factors of the loops' Jacobian, inverse dynamics of the tree, and the
  // multipliers by the same factors.
  void inverse(const View &q, const View &qd, const View &qdd, double *out) {
    pinocchio::computeJointJacobians(model, data, q);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      loops[i].calc(model, data, loop_data[i]);
      loops[i].jacobian(model, data, loop_data[i], k.middleRows(3 * i, 3));
    }
    for (std::size_t i = 0; i < dependent.size(); ++i) k_dependent.col(i) = k.col(dependent[i]);
    if (is_square()) lu.compute(k_dependent);
    else qr.compute(k_dependent);
    for (int index : actuated) v[index] = qd[index], a[index] = qdd[index];
    drift.setZero();
    complete(v, drift);
    pinocchio::forwardKinematics(model, data, q, v, zero);
    for (std::size_t i = 0; i < loops.size(); ++i) {
      const auto &loop = loops[i];
      const auto &at = loop_data[i];
      drift.segment<3>(3 * i) = acceleration(data, loop.joint1_id, loop.joint1_placement, at.oMc1) -
                                acceleration(data, loop.joint2_id, loop.joint2_placement, at.oMc2);
    }
    complete(a, drift);
    const VectorXd &tau = pinocchio::rnea(model, data, q, v, a);
    for (std::size_t i = 0; i < dependent.size(); ++i) part[i] = tau[dependent[i]];
    if (is_square()) right = lu.transpose().solve(part);
    else right = qr.transpose().solve(part);
    for (int index : actuated) *out++ = tau[index] - k.col(index).dot(right);
  }
};

EXPORT void *pinocchio_loops_open(const char *text) try {
  std::istringstream in(text);
  return new Machine(in);
} catch (const std::exception &error) {
  std::cerr << "pinocchio: " << error.what() << "\n";
  return nullptr;
}

EXPORT void pinocchio_loops_inverse(void *peer, const double *state, std::size_t count, double *out) {
  Machine &m = *static_cast<Machine *>(peer);
  const Eigen::Index p = m.model.nq, n = m.model.nv;
  for (; count > 0; --count, state += p + 2 * n, out += m.actuated.size())
    m.inverse(View(state, p), View(state + p, n), View(state + p + n, n), out);
}

EXPORT void pinocchio_loops_forward(void *peer, const double *state, std::size_t count, double *out) {
  Machine &m = *static_cast<Machine *>(peer);
  const Eigen::Index p = m.model.nq, n = m.model.nv;
  for (; count > 0; --count, state += p + 2 * n) {
    const View q(state, p), qd(state + p, n), tau(state + p + n, n);
    const auto &qdd = pinocchio::constraintDynamics(
        m.model, m.data, q, qd, tau, m.loops, m.loop_data, m.settings);
    out = std::copy_n(qdd.data(), n, out);
  }
}
