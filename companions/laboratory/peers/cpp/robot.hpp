// A robot from the command `peers`' text form, as Pinocchio's model.
#pragma once

#include <array>
#include <utility>

#include <pinocchio/multibody.hpp>

#include "robot_text.hpp"

// What joints take as their position: the angle, or its cosine and sine.
enum class Position { angle, cos_sin };

inline pinocchio::JointModel joint_model(const Body &body, Position position) {
  using namespace pinocchio;
  const Eigen::Vector3d axis(body.axis);
  const bool angle = position == Position::angle;
  if (body.joint == "free") return JointModel(JointModelFreeFlyer());
  if (body.joint == "universal") return JointModel(JointModelUniversal(axis, Eigen::Vector3d(body.axis2)));
  if (body.joint == "prismatic") {
    if (axis == Eigen::Vector3d::UnitZ()) return JointModel(JointModelPZ());
    return JointModel(JointModelPrismaticUnaligned(axis));
  }
  if (body.joint != "revolute") throw std::runtime_error("a joint of a kind that is not compared");
  if (axis == Eigen::Vector3d::UnitX())
    return angle ? JointModel(JointModelRX()) : JointModel(JointModelRUBX());
  if (axis == Eigen::Vector3d::UnitY())
    return angle ? JointModel(JointModelRY()) : JointModel(JointModelRUBY());
  if (axis == Eigen::Vector3d::UnitZ())
    return angle ? JointModel(JointModelRZ()) : JointModel(JointModelRUBZ());
  if (angle) return JointModel(JointModelRevoluteUnaligned(axis));
  return JointModel(JointModelRevoluteUnboundedUnaligned(axis));
}

// A joint and a place on the body that it carries.
using Place = std::pair<pinocchio::JointIndex, pinocchio::SE3>;
// Those of each body.
using Placed = std::vector<Place>;

inline pinocchio::Model pinocchio_model(const Robot &robot, Position position, Placed *out = nullptr) {
  using namespace pinocchio;
  Model model;
  model.name = robot.name;
  Placed placed;
  for (const Body &body : robot.bodies) {
    JointIndex joint = 0;
    SE3 at = SE3::Identity();
    if (body.parent >= 0) std::tie(joint, at) = placed.at(body.parent);
    const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> rotation(body.rotation);
    SE3 here = at * SE3(Eigen::Matrix3d(rotation), Eigen::Vector3d(body.position));
    if (body.joint != "fixed") {
      joint = model.addJoint(joint, joint_model(body, position), here, body.name);
      here = SE3::Identity();
    }
    placed.emplace_back(joint, here);
    const double *i = body.inertia;  // xx, xy, xz, yy, yz, zz
    const Symmetric3 inertia(i[0], i[1], i[3], i[2], i[4], i[5]);
    model.appendBodyToJoint(joint, Inertia(body.mass, Eigen::Vector3d(body.com), inertia), here);
  }
  if (out) *out = placed;
  return model;
}

// The loops of a robot: pairs of points that coincide, and the coordinates with a motor.
struct Loops {
  std::vector<std::array<Place, 2>> ends;
  std::vector<int> actuated;
  // Of the proximal solver.
  double mu = 0.0;
};

inline pinocchio::SE3 read_place(std::istream &in) {
  double rotation[9], position[3];
  read(in, rotation);
  read(in, position);
  const Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>> r(rotation);
  return pinocchio::SE3(Eigen::Matrix3d(r), Eigen::Vector3d(position));
}

// The lines below those of a robot: the number of loops, and of each the body, -1 for the base, and the place on it of one
// point and the other; the number of actuated coordinates, and their indices; mu.
inline Loops read_loops(std::istream &in, const Placed &placed) {
  Loops loops;
  std::size_t count;
  for (in >> count; in && count > 0; --count) {
    loops.ends.emplace_back();
    for (Place &end : loops.ends.back()) {
      int body;
      in >> body;
      if (body >= 0) end = placed.at(body);
      else end = {0, pinocchio::SE3::Identity()};
      end.second = end.second * read_place(in);
    }
  }
  loops.actuated.resize((in >> count, in ? count : 0));
  for (int &index : loops.actuated) in >> index;
  if (!(in >> loops.mu)) throw std::runtime_error("an incomplete robot with loops");
  return loops;
}
