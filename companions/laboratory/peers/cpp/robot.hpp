// A robot from the command `peers`' text form, as Pinocchio's model.
#pragma once

#include <tuple>
#include <utility>
#include <vector>

#include <pinocchio/multibody.hpp>

#include "robot_text.hpp"

// What joints take as their position: the angle, or its cosine and sine.
enum class Position { angle, cos_sin };

inline pinocchio::JointModel joint_model(const Body &body, Position position) {
  using namespace pinocchio;
  const Eigen::Vector3d axis(body.axis);
  const bool angle = position == Position::angle;
  if (body.joint == "free") return JointModel(JointModelFreeFlyer());
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

inline pinocchio::Model pinocchio_model(const Robot &robot, Position position) {
  using namespace pinocchio;
  Model model;
  model.name = robot.name;
  // Of each body, its joint and its place on what that carries.
  std::vector<std::pair<JointIndex, SE3>> placed;
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
  return model;
}
