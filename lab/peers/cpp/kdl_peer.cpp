// Orocos KDL behind the C interface of the benchmark (see pinocchio_peer.cpp): f64, chains, built as kdl_parser builds
// them from a URDF.

#include <algorithm>
#include <cstddef>
#include <iostream>

#include <kdl/chain.hpp>
#include <kdl/chaindynparam.hpp>
#include <kdl/chainfdsolver_recursive_newton_euler.hpp>
#include <kdl/chainidsolver_recursive_newton_euler.hpp>

#include "robot_text.hpp"

#define EXPORT extern "C" __attribute__((visibility("default")))

static KDL::Chain chain(const Robot &robot) {
  KDL::Chain chain;
  for (const Body &body : robot.bodies) {
    if (body.parent + 1 != static_cast<int>(chain.getNrOfSegments())) throw std::runtime_error("not a chain");
    const double *r = body.rotation, *p = body.position, *c = body.com, *i = body.inertia;
    const KDL::Frame place(KDL::Rotation(r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]),
                           KDL::Vector(p[0], p[1], p[2]));
    const KDL::Vector axis(body.axis[0], body.axis[1], body.axis[2]);
    const KDL::Joint joint = body.joint == "fixed"
                                 ? KDL::Joint(body.name, KDL::Joint::Fixed)
                                 : KDL::Joint(body.name, place.p, place.M * axis, KDL::Joint::RotAxis);
    // Ours are xx, xy, xz, yy, yz, zz; its arguments xx, yy, zz, xy, xz, yz.
    const KDL::RotationalInertia inertia(i[0], i[3], i[5], i[1], i[2], i[4]);
    const KDL::RigidBodyInertia link(body.mass, KDL::Vector(c[0], c[1], c[2]), inertia);
    chain.addSegment(KDL::Segment(body.name, joint, place, link));
  }
  return chain;
}

struct Peer {
  KDL::Chain chain;
  KDL::ChainIdSolver_RNE inverse;
  KDL::ChainDynParam parameters;
  KDL::ChainFdSolver_RNE forward;
  KDL::JntArray q, qd, last, out;
  KDL::JntSpaceInertiaMatrix matrix;
  KDL::Wrenches wrenches;

  explicit Peer(const Robot &robot, const KDL::Vector &gravity = KDL::Vector(0, 0, -9.81))
      : chain(::chain(robot)), inverse(chain, gravity), parameters(chain, gravity), forward(chain, gravity),
        wrenches(chain.getNrOfSegments(), KDL::Wrench::Zero()) {
    for (KDL::JntArray *array : {&q, &qd, &last, &out}) array->resize(chain.getNrOfJoints());
    matrix.resize(chain.getNrOfJoints());
  }
};

EXPORT void *kdl_f64_open(const char *path, const char *name) try {
  for (const Robot &robot : read_robots(path))
    if (robot.name == name) return new Peer(robot);
  return nullptr;
} catch (const std::exception &error) {
  std::cerr << "kdl: " << error.what() << "\n";
  return nullptr;
}

template <typename Algorithm>
static void run(void *peer, const double *state, std::size_t count, double *out, Algorithm algorithm) {
  Peer &p = *static_cast<Peer *>(peer);
  const std::size_t n = p.chain.getNrOfJoints();
  for (; count > 0; --count, state += 3 * n) {
    std::copy_n(state, n, p.q.data.data());
    std::copy_n(state + n, n, p.qd.data.data());
    std::copy_n(state + 2 * n, n, p.last.data.data());
    const auto &result = algorithm(p).data;
    out = std::copy_n(result.data(), result.size(), out);
  }
}

#define ALGORITHM(NAME, CALL, RESULT)                                                           \
  EXPORT void kdl_f64_##NAME(void *peer, const double *states, std::size_t count, double *out) { \
    run(peer, states, count, out, [](Peer &p) -> auto & {                                       \
      p.CALL;                                                                                   \
      return p.RESULT;                                                                          \
    });                                                                                         \
  }

ALGORITHM(rnea, inverse.CartToJnt(p.q, p.qd, p.last, p.wrenches, p.out), out)
ALGORITHM(gravity, parameters.JntToGravity(p.q, p.out), out)
ALGORITHM(crba, parameters.JntToMass(p.q, p.matrix), matrix)
ALGORITHM(aba, forward.CartToJnt(p.q, p.qd, p.last, p.wrenches, p.out), out)
