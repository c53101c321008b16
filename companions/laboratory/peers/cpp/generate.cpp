// Writes the C that CasADi generates for given robots: from Pinocchio's algorithms, and from those in the coordinates of
// the links (classical.hpp), with common subexpressions taken out, whose name ends with `links`.
//
//     generate ROBOTS OUT NAME...
//
// makes OUT/<robot>_<algorithm>_<inputs>_<precision>.c, each with one function of that name. Inputs are
// `q` (position, velocity, acceleration) or `cs`, where cosines and sines are given: what a control
// loop has that computes them once a tick for all its users. The C takes no heap. Coordinates are the library's: of
// a free joint attitude and position, angular before linear; in the place of cosines it has its coordinates themselves.

#include <pinocchio/autodiff/casadi.hpp>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "classical.hpp"
#include "robot.hpp"

using Model = pinocchio::ModelTpl<SX>;
using Data = pinocchio::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

// Which of the library's coordinates each of Pinocchio's is, and of positions whether it is an angle.
struct Order {
  std::vector<int> positions, velocities;
  std::vector<bool> turns;

  explicit Order(const Robot &robot) {
    for (const Body &body : robot.bodies) {
      const bool free = body.joint == "free";
      if (body.joint == "fixed") continue;
      append(positions, free ? std::vector<int>{4, 5, 6, 0, 1, 2, 3} : std::vector<int>{0});
      append(velocities, free ? std::vector<int>{3, 4, 5, 0, 1, 2} : std::vector<int>{0});
      turns.resize(positions.size(), !free);
    }
  }

  // Whether one of our coordinates is an angle.
  bool is_angle(casadi_int ours) const {
    const auto theirs = std::find(positions.begin(), positions.end(), ours);
    return turns[theirs - positions.begin()];
  }

  static void append(std::vector<int> &all, const std::vector<int> &block) {
    const int first = all.size();
    for (int k : block) all.push_back(first + k);
  }

  Vector theirs(const SX &ours) const {
    Vector result(velocities.size());
    for (std::size_t k = 0; k < velocities.size(); ++k) result[k] = ours(velocities[k]);
    return result;
  }

  template <typename Column>
  SX ours(const Column &theirs) const {
    SX result(velocities.size(), 1);
    for (std::size_t k = 0; k < velocities.size(); ++k) result(velocities[k]) = SX(theirs(k, 0));
    return result;
  }
};

// The lower triangle of a symmetric matrix by columns: what a user of M needs.
static SX lower(const SX &matrix) {
  std::vector<SX> entries;
  for (casadi_int i = 0; i < matrix.rows(); ++i)
    for (casadi_int j = i; j < matrix.rows(); ++j) entries.push_back(matrix(i, j));
  return SX::densify(SX::vertcat(entries));
}

// That of a matrix whose upper triangle is given, its coordinates in this order.
static SX triangle(const Data::MatrixXs &upper, const std::vector<int> &order) {
  const casadi_int n = order.size();
  SX sorted(n, n);
  for (casadi_int i = 0; i < n; ++i)
    for (casadi_int j = i; j < n; ++j) sorted(order[i], order[j]) = sorted(order[j], order[i]) = upper(i, j);
  return lower(sorted);
}

// Λ⁻¹ of the last body in its own frame.
static Data::MatrixXs operational_inverse(const Model &model, Data &data, const Vector &q) {
  Data::MatrixXs inverse = pinocchio::computeMinverse(model, data, q);
  for (int i = 0; i < model.nv; ++i)
    for (int j = 0; j < i; ++j) inverse(i, j) = inverse(j, i);
  Data::Matrix6x jacobian = Data::Matrix6x::Zero(6, model.nv);
  pinocchio::computeJointJacobian(model, data, q, model.njoints - 1, jacobian);
  return jacobian * inverse * jacobian.transpose();
}

// The classical algorithms; positions are angles, or cosines and sines.
static casadi::Function classical(const Robot &robot, const std::string &algorithm, Position position) {
  const Order order(robot);
  const casadi_int positions = order.positions.size(), velocities = order.velocities.size();
  const bool angle = position == Position::angle;
  const SX q = SX::sym("q", positions), s = SX::sym("s", positions);
  const SX v = SX::sym("v", velocities), u = SX::sym("u", velocities), rest = SX::zeros(velocities);
  SX cosines = q, sines = s;
  for (casadi_int k = 0; angle && k < positions; ++k) {
    if (order.is_angle(k)) cosines(k) = cos(SX(q(k))), sines(k) = sin(SX(q(k)));
  }
  const Classical of(robot, cosines, sines);
  std::vector<SX> inputs = {q};
  if (!angle) inputs.push_back(s);
  SX output;
  if (algorithm == "crba") {
    output = lower(of.crba());
  } else if (algorithm == "gravity") {
    output = of.rnea(rest, rest);
  } else if (algorithm == "bias") {
    inputs.push_back(v);
    output = of.rnea(v, rest);
  } else {
    inputs.insert(inputs.end(), {v, u});
    output = algorithm == "rnea" ? of.rnea(v, u) : of.forward_dynamics(v, u);
  }
  const std::string name = robot.name + "_" + algorithm + "links" + (angle ? "_q" : "_cs");
  return casadi::Function(name, inputs, {SX::densify(output)}, {{"cse", true}});
}

static casadi::Function function(
    const Robot &robot, const std::string &algorithm, Position position) {
  const Model model = pinocchio_model(robot, position).cast<SX>();
  Data data(model);
  const Order order(robot);
  const SX qd = SX::sym("v", model.nv), last = SX::sym("u", model.nv);
  const casadi_int positions = order.positions.size();
  std::vector<SX> inputs = {SX::sym("q", positions)};
  if (position == Position::cos_sin) inputs.push_back(SX::sym("s", positions));
  Vector q(model.nq);
  Eigen::Index next = 0;
  for (casadi_int k = 0; k < positions; ++k) {
    q[next++] = inputs[0](order.positions[k]);
    if (inputs.size() == 2 && order.turns[k]) q[next++] = inputs[1](order.positions[k]);
  }
  const Vector v = order.theirs(qd), u = order.theirs(last);
  SX output;
  if (algorithm == "rnea") {
    inputs.insert(inputs.end(), {qd, last});
    output = order.ours(pinocchio::rnea(model, data, q, v, u));
  } else if (algorithm == "bias") {
    inputs.push_back(qd);
    output = order.ours(pinocchio::nonLinearEffects(model, data, q, v));
  } else if (algorithm == "gravity") {
    output = order.ours(pinocchio::computeGeneralizedGravity(model, data, q));
  } else if (algorithm == "crba") {
    output = triangle(pinocchio::crba(model, data, q), order.velocities);
  } else if (algorithm == "osim") {
    output = triangle(operational_inverse(model, data, q), {3, 4, 5, 0, 1, 2});
  } else {
    inputs.insert(inputs.end(), {qd, last});
    output = order.ours(pinocchio::aba(model, data, q, v, u));
  }
  const std::string name =
      robot.name + "_" + algorithm + (position == Position::angle ? "_q" : "_cs");
  return casadi::Function(name, inputs, {output});
}

// In f32 CasADi still writes sines, cosines and numbers in f64.
static std::string single(std::string code) {
  code = std::regex_replace(code, std::regex(R"(\b(sin|cos|sqrt|fabs)\()"), "$1f(");
  const std::regex number(R"((^|[^\w.])((?:\d+\.\d*|\.\d+)(?:[eE][+-]?\d+)?)(?![\w.]))");
  return std::regex_replace(code, number, "$1$2f");
}

// CasADi's function behind one that a person would call, the same for every algorithm: (q or c and s),
// v, u, output. Pointers may not be null, so that the compiler drops CasADi's tests for that. Whether
// they may overlap is left to who compiles it: knowing that they do not lets the compiler move loads,
// which makes some functions faster and others slower.
static std::string wrapper(const casadi::Function &made, const std::string &name, bool angle) {
  const casadi_int positions = angle ? 1 : 2;
  std::ostringstream code;
  code << "\n__attribute__((nonnull)) void PEER(" << name << ")(";
  for (casadi_int i = 0; i < positions + 2; ++i) code << "const casadi_real *RESTRICT i" << i << ", ";
  code << "casadi_real *RESTRICT o) {\n  const casadi_real *arg[] = {";
  for (casadi_int i = 0; i < made.n_in(); ++i) code << "i" << i << ", ";
  code << "};\n  casadi_real *res[] = {o};\n";
  for (casadi_int i = made.n_in(); i < positions + 2; ++i) code << "  (void)i" << i << ";\n";
  code << "  casadi_f0(arg, res, 0, 0, 0);\n}\n";
  return code.str();
}

static void write(const casadi::Function &made, const std::string &precision, const std::string &out) {
  const bool f32 = precision == "f32", angle = made.name().back() == 'q';
  casadi::CodeGenerator generator(
      made.name(), {{"casadi_real", f32 ? "float" : "double"}, {"include_math", angle}, {"static_aux", true}});
  generator.add(made);
  const std::string name = made.name() + "_" + precision, code = generator.dump();
  std::ofstream file(out + "/" + name + ".c");
  file << "#define CASADI_SYMBOL_EXPORT __attribute__((unused)) static\n"
       << "#ifndef PEER  // another name for another build\n#define PEER(name) name\n#endif\n"
       << "#ifndef RESTRICT  // or `restrict`\n#define RESTRICT\n#endif\n"
       << (f32 ? single(code) : code) << wrapper(made, name, angle);
  if (!file.flush()) throw std::runtime_error("cannot write " + out + "/" + name + ".c");
}

int main(int count, char **arguments) try {
  if (count < 3) throw std::runtime_error("usage: generate ROBOTS OUT NAME...");
  const std::vector<Robot> all = read_robots(arguments[1]);
  for (int i = 3; i < count; ++i) {
    // ROBOT_ALGORITHM_INPUTS_PRECISION
    const std::string name = arguments[i];
    static const std::regex parts(R"((.+)_([a-z]+?)(links)?_(q|cs)_(f32|f64))");
    std::smatch found;
    if (!std::regex_match(name, found, parts)) throw std::runtime_error(name + " is no function");
    const Position position = found[4] == "q" ? Position::angle : Position::cos_sin;
    const auto make = found[3].matched ? classical : function;
    for (const Robot &robot : all)
      if (robot.name == found[1]) write(make(robot, found[2], position), found[5], arguments[2]);
  }
  return 0;
} catch (const std::exception &error) {
  std::cerr << "generate: " << error.what() << "\n";
  return 1;
}
