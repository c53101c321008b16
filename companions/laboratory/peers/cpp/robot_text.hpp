// A robot in the command `peers`' text form.
#pragma once

#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

struct Body {
  std::string name, joint;
  int parent;
  double axis[3], rotation[9], position[3], mass, com[3], inertia[6];
};

struct Robot {
  std::string name;
  std::vector<Body> bodies;
};

template <int N>
void read(std::istream &in, double (&numbers)[N]) {
  for (double &number : numbers) in >> number;
}

// A robot: a line `name bodies`, then one line a body; of none the name is empty. C++ reads a decimal number to the
// nearest double, so that the numbers are the library's own.
inline Robot read_robot(std::istream &in) {
  Robot robot;
  std::size_t count;
  if (!(in >> robot.name >> count)) return {};
  robot.bodies.resize(count);
  for (Body &body : robot.bodies) {
    in >> body.name >> body.parent >> body.joint;
    read(in, body.axis);
    read(in, body.rotation);
    read(in, body.position);
    in >> body.mass;
    read(in, body.com);
    read(in, body.inertia);
  }
  if (!in) throw std::runtime_error(robot.name + " is incomplete");
  return robot;
}

// Robots of a file.
inline std::vector<Robot> read_robots(const std::string &path) {
  std::ifstream in(path);
  std::vector<Robot> robots;
  for (Robot robot = read_robot(in); !robot.name.empty(); robot = read_robot(in)) robots.push_back(robot);
  if (robots.empty()) throw std::runtime_error(path + ": no robot");
  return robots;
}
