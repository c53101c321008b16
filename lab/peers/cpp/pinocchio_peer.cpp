// Pinocchio's algorithms behind the C interface of the benchmark, once for each precision.
//
//     void *pinocchio_<precision>_open(const char *robots, const char *name);
//     void pinocchio_<precision>_<algorithm>(void *, const real *states, size_t count, real *out);
//
// A state is q, q̇ and q̈ (in forward dynamics τ) in a row; M is written as a square, by columns, of which
// the upper triangle counts.

#include <algorithm>
#include <cstddef>
#include <iostream>
#include <memory>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "robot.hpp"

#define EXPORT extern "C" __attribute__((visibility("default")))

template <typename Real>
struct Peer {
  pinocchio::ModelTpl<Real> model;
  pinocchio::DataTpl<Real> data;

  explicit Peer(const Robot &robot)
      : model(pinocchio_model(robot, Position::angle).cast<Real>()), data(model) {}
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
  auto &[model, data] = *static_cast<Peer<Real> *>(peer);
  const Eigen::Index n = model.nv;
  for (; count > 0; --count, state += 3 * n) {
    const auto &result =
        algorithm(model, data, View(state, n), View(state + n, n), View(state + 2 * n, n));
    out = std::copy_n(result.data(), result.size(), out);
  }
}

#define ALGORITHM(NAME, REAL, PRECISION, CALL)                                              \
  EXPORT void pinocchio_##PRECISION##_##NAME(                                               \
      void *peer, const REAL *states, std::size_t count, REAL *out) {                       \
    run(peer, states, count, out,                                                           \
        [](auto &model, auto &data, auto q, auto v, auto a) -> auto & {                     \
          (void)v, (void)a;                                                                 \
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
  ALGORITHM(aba, REAL, PRECISION, pinocchio::aba(model, data, q, v, a))

PEER(float, f32)
PEER(double, f64)
