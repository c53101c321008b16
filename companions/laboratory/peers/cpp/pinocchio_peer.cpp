// Pinocchio's algorithms behind the C interface of the benchmark, once for each precision.
//
//     void *pinocchio_<precision>_open(const char *robots, const char *name);
//     void pinocchio_<precision>_<algorithm>(void *, const real *states, size_t count, real *out);
//
// A state is q, q̇ and q̈ (in forward dynamics τ) in a row; M and Λ⁻¹ are written as squares, by columns, of which
// the upper triangles count.

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/delassus.hpp>
#include <pinocchio/algorithm/rnea-derivatives.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "robot.hpp"

#define EXPORT extern "C" __attribute__((visibility("default")))

template <typename Real>
struct Peer {
  pinocchio::ModelTpl<Real> model;
  pinocchio::DataTpl<Real> data;
  using Matrix = Eigen::Matrix<Real, 6, 6>;
  PINOCCHIO_ALIGNED_STD_VECTOR(pinocchio::RigidConstraintModelTpl<Real>) tip;
  PINOCCHIO_ALIGNED_STD_VECTOR(pinocchio::RigidConstraintDataTpl<Real>) tip_data;
  Matrix mobility;
  // ∂τ/∂q above ∂τ/∂q̇, by rows; entries between two limbs stay zero.
  Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> both;

  explicit Peer(const Robot &robot)
      : model(pinocchio_model(robot, Position::angle).cast<Real>()), data(model) {
    tip.emplace_back(pinocchio::CONTACT_6D, model, model.njoints - 1, pinocchio::LOCAL);
    tip_data.emplace_back(tip.back());
    both.setZero(2 * model.nv, model.nv);
    pinocchio::initPvDelassus(model, data, tip);
  }

  // Λ⁻¹ of the last body in its own frame, as the Delassus matrix of a constraint that holds it.
  template <typename Q>
  const Matrix &osim(const Q &q) {
    pinocchio::computeDelassusMatrix(model, data, q, tip, tip_data, mobility);
    return mobility;
  }

  template <typename Q, typename V>
  const auto &gradient(const Q &q, const V &v, const V &a) {
    const Eigen::Index n = model.nv;
    pinocchio::computeRNEADerivatives(model, data, q, v, a, both.topRows(n), both.bottomRows(n), data.M);
    return both;
  }
};

template <typename Real>
static void *open(const char *path, const char *name) try {
  for (const Robot &robot : read_robots(path))
    if (robot.name == name) return new Peer<Real>(robot);
  return nullptr;
} catch (const std::exception &error) {
  std::cerr << "pinocchio: " << error.what() << "\n";
  return nullptr;
}

template <typename Real, typename Algorithm>
static void run(void *peer, const Real *state, std::size_t count, Real *out, Algorithm algorithm) {
  using View = Eigen::Map<const Eigen::Matrix<Real, Eigen::Dynamic, 1>>;
  auto &p = *static_cast<Peer<Real> *>(peer);
  const Eigen::Index m = p.model.nq, n = p.model.nv;
  for (; count > 0; --count, state += m + 2 * n) {
    const auto &result =
        algorithm(p, p.model, p.data, View(state, m), View(state + m, n), View(state + m + n, n));
    out = std::copy_n(result.data(), result.size(), out);
  }
}

#define ALGORITHM(NAME, REAL, PRECISION, CALL)                                              \
  EXPORT void pinocchio_##PRECISION##_##NAME(                                               \
      void *peer, const REAL *states, std::size_t count, REAL *out) {                       \
    run(peer, states, count, out,                                                           \
        [](auto &p, auto &model, auto &data, auto q, auto v, auto a) -> auto & {                     \
          (void)p, (void)model, (void)data, (void)v, (void)a;                               \
          return CALL;                                                                      \
        });                                                                                 \
  }

#define PEER(REAL, PRECISION)                                                               \
  EXPORT void *pinocchio_##PRECISION##_open(const char *path, const char *name) {           \
    return open<REAL>(path, name);                                                          \
  }                                                                                         \
  ALGORITHM(rnea, REAL, PRECISION, pinocchio::rnea(model, data, q, v, a))                   \
  ALGORITHM(bias, REAL, PRECISION, pinocchio::nonLinearEffects(model, data, q, v))          \
  ALGORITHM(gravity, REAL, PRECISION, pinocchio::computeGeneralizedGravity(model, data, q))  \
  ALGORITHM(crba, REAL, PRECISION, pinocchio::crba(model, data, q))                         \
  ALGORITHM(aba, REAL, PRECISION, pinocchio::aba(model, data, q, v, a))                     \
  ALGORITHM(osim, REAL, PRECISION, p.osim(q))                                               \
  ALGORITHM(gradient, REAL, PRECISION, p.gradient(q, v, a))

PEER(float, f32)
PEER(double, f64)
