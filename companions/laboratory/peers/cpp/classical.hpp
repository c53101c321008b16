// Dynamics in the coordinates of the links, as an expert writes them for CasADi: Newton-Euler (Luh, Walker, Paul 1980),
// composite bodies with mass, first and second moments (Walker, Orin 1982), and forward dynamics by LᵀDL of both
// (Featherstone 2008, table 6.3). Velocities and forces are pairs of 3-vectors; a free base has the first six coordinates.
#pragma once

#include <casadi/casadi.hpp>

#include "robot.hpp"

using casadi::DM;
using casadi::SX;

class Classical {
 public:
  // Positions are cosines and sines, or a free base's own coordinates: attitude x, y, z, w and position.
  Classical(const Robot &robot, const SX &cosines, const SX &sines) {
    const pinocchio::Model model = pinocchio_model(robot, Position::angle);
    casadi_int position = 0, velocity = 0;
    for (const Body &body : robot.bodies) {
      if (body.joint == "fixed") continue;
      Link link;
      const std::size_t joint = links.size() + 1;
      link.parent = static_cast<int>(model.parents[joint]) - 1;
      const pinocchio::Inertia &inertia = model.inertias[joint];
      link.mass = inertia.mass();
      link.com = numbers(inertia.lever());
      link.inertia = numbers(inertia.inertia().matrix());
      link.first = velocity;
      if (body.joint == "free") {
        link.axis = -1;
        const SX a = cosines(casadi::Slice(0, 3)), w = cosines(3);
        // The rows of E are the axes of the world in the base.
        link.rotation = SX::eye(3) + 2 * SX::mtimes(w * SX::eye(3) + skew(a), skew(a));
        link.place = SX::zeros(3);
        position += 7;
        velocity += 6;
      } else {
        const Eigen::Vector3d axis(body.axis);
        Eigen::Index k;
        if (axis.cwiseAbs().maxCoeff(&k) != 1.0) throw std::runtime_error(robot.name + ": an axis that is no axis of its frame");
        link.axis = static_cast<int>(k);
        link.sign = axis[k];
        const pinocchio::SE3 &placement = model.jointPlacements[joint];
        link.rotation = SX::mtimes(numbers(placement.rotation()), turn(link.axis, cosines(position), link.sign * sines(position)));
        link.place = numbers(placement.translation());
        ++position;
        ++velocity;
      }
      // A coordinate's parent in M: of a free base, the coordinate before it.
      for (casadi_int k = link.first; k < velocity; ++k)
        above.push_back(k > link.first ? k - 1 : link.parent < 0 ? -1 : links[link.parent].last());
      links.push_back(link);
    }
  }

  SX rnea(const SX &qd, const SX &qdd) const {
    std::vector<SX> w, dw, a, f, n;
    for (const Link &link : links) {
      const SX axis = link.direction(), own = qd(link.first);
      SX parent_w = SX(3, 1), parent_dw = SX(3, 1), parent_a = SX(DM({0, 0, GRAVITY}));
      if (link.parent >= 0) {
        parent_w = w[link.parent];
        parent_dw = dw[link.parent];
        parent_a = a[link.parent];
      }
      const SX &p = link.place;
      const SX at = SX::mtimes(link.rotation.T(), parent_a + cross(parent_dw, p) + cross(parent_w, cross(parent_w, p)));
      if (link.axis < 0) {
        w.push_back(qd(casadi::Slice(0, 3)));
        dw.push_back(qdd(casadi::Slice(0, 3)));
        a.push_back(at + qdd(casadi::Slice(3, 6)) + cross(w.back(), qd(casadi::Slice(3, 6))));
      } else {
        const SX turned = SX::mtimes(link.rotation.T(), parent_w);
        w.push_back(turned + axis * own);
        dw.push_back(SX::mtimes(link.rotation.T(), parent_dw) + axis * qdd(link.first) + cross(turned, axis) * own);
        a.push_back(at);
      }
      const SX &c = link.com, own_w = w.back(), own_dw = dw.back();
      f.push_back(link.mass * (a.back() + cross(own_dw, c) + cross(own_w, cross(own_w, c))));
      n.push_back(SX::mtimes(link.inertia, own_dw) + cross(own_w, SX::mtimes(link.inertia, own_w)) + cross(c, f.back()));
    }
    SX tau(above.size(), 1);
    for (int i = links.size() - 1; i >= 0; --i) {
      const Link &link = links[i];
      if (link.axis < 0) {
        for (int k = 0; k < 3; ++k) tau(k) = n[i](k), tau(3 + k) = f[i](k);
      } else {
        tau(link.first) = link.sign * n[i](link.axis);
      }
      if (link.parent < 0) continue;
      const SX force = SX::mtimes(link.rotation, f[i]);
      f[link.parent] += force;
      n[link.parent] += SX::mtimes(link.rotation, n[i]) + cross(link.place, force);
    }
    return tau;
  }

  // The entries of M on the tree's paths; the others are zero.
  SX crba() const {
    std::vector<double> mass;
    std::vector<SX> moment, inertia;
    for (const Link &link : links) {
      const SX c = skew(link.com);
      mass.push_back(link.mass);
      moment.push_back(link.mass * link.com);
      inertia.push_back(link.inertia - link.mass * SX::mtimes(c, c));
    }
    SX m(above.size(), above.size());
    for (int i = links.size() - 1; i >= 0; --i) {
      const Link &link = links[i];
      if (link.axis < 0) {
        const SX h = skew(moment[i]);
        for (int j = 0; j < 3; ++j) {
          for (int k = 0; k < 3; ++k) m(j, k) = inertia[i](j, k), m(3 + j, k) = -h(j, k), m(k, 3 + j) = -h(j, k);
          m(3 + j, 3 + j) = mass[i];
        }
        continue;
      }
      const SX axis = link.direction();
      SX f = cross(axis, moment[i]), n = SX::mtimes(inertia[i], axis);
      for (int j = i; j >= 0; j = links[j].parent) {
        const Link &on = links[j];
        if (on.axis < 0) {
          for (int k = 0; k < 3; ++k) {
            m(link.first, k) = m(k, link.first) = n(k);
            m(link.first, 3 + k) = m(3 + k, link.first) = f(k);
          }
        } else {
          m(link.first, on.first) = m(on.first, link.first) = on.sign * n(on.axis);
          f = SX::mtimes(on.rotation, f);
          n = SX::mtimes(on.rotation, n) + cross(on.place, f);
        }
      }
      if (link.parent < 0) continue;
      const SX h = SX::mtimes(link.rotation, moment[i]), p = skew(link.place), s = skew(h);
      const SX turned = SX::mtimes(SX::mtimes(link.rotation, inertia[i]), link.rotation.T());
      SX &to = inertia[link.parent];
      to = SX::triu2symm(SX::triu(to + turned - SX::mtimes(p, s) - SX::mtimes(s, p) - mass[i] * SX::mtimes(p, p)));
      moment[link.parent] += h + mass[i] * link.place;
      mass[link.parent] += mass[i];
    }
    return m;
  }

  // By LᵀDL, whose pivots are inverted once.
  SX forward_dynamics(const SX &qd, const SX &tau) const {
    const int count = above.size();
    SX m = crba(), x = tau - rnea(qd, SX(count, 1)), inverse(count, 1);
    for (int k = count - 1; k >= 0; --k) {
      inverse(k) = 1 / SX(m(k, k));
      for (int i = above[k]; i >= 0; i = above[i]) {
        const SX share = SX(m(k, i)) * SX(inverse(k));
        for (int j = i; j >= 0; j = above[j]) m(i, j) -= share * SX(m(k, j));
        m(k, i) = share;
      }
    }
    for (int k = count - 1; k >= 0; --k)
      for (int i = above[k]; i >= 0; i = above[i]) x(i) -= SX(m(k, i)) * SX(x(k));
    x *= inverse;
    for (int k = 0; k < count; ++k)
      for (int i = above[k]; i >= 0; i = above[i]) x(k) -= SX(m(k, i)) * SX(x(i));
    return x;
  }

 private:
  static constexpr double GRAVITY = 9.81;

  struct Link {
    // The axis of its frame about which it turns; −1 of a free base.
    int parent, axis;
    double sign = 1, mass;
    casadi_int first;
    SX rotation, place, com, inertia;

    casadi_int last() const { return axis < 0 ? first + 5 : first; }
    SX direction() const {
      SX e(3, 1);
      if (axis >= 0) e(axis) = sign;
      return e;
    }
  };

  std::vector<Link> links;
  // The coordinate before each coordinate on the way to the root.
  std::vector<casadi_int> above;

  // Rounded to 0, 1 and −1 where a merge of bodies left a rounding error, since CasADi drops products with these.
  template <typename Matrix>
  static SX numbers(const Matrix &matrix) {
    const double size = 1e-15 * std::max(1e-3, matrix.cwiseAbs().maxCoeff());
    SX result(matrix.rows(), matrix.cols());
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      for (Eigen::Index j = 0; j < matrix.cols(); ++j) {
        const double x = matrix(i, j), whole = std::round(x);
        const double rounded = std::abs(x - whole) < size ? whole : x;
        if (rounded != 0) result(i, j) = rounded;
      }
    return result;
  }

  static SX skew(const SX &x) { return SX::skew(x); }
  static SX cross(const SX &a, const SX &b) { return SX::cross(a, b); }

  static SX turn(int axis, const SX &c, const SX &s) {
    const int y = (axis + 1) % 3, z = (axis + 2) % 3;
    SX r(3, 3);
    r(axis, axis) = 1;
    r(y, y) = r(z, z) = c;
    r(y, z) = -s;
    r(z, y) = s;
    return r;
  }
};
