// Writes the C that CasADi generates from Pinocchio's algorithms for given robots.
//
//     generate ROBOTS OUT
//
// makes OUT/<robot>_<algorithm>_<inputs>_<precision>.c, each with one function of that name. Inputs are
// `q` (position, velocity, acceleration) or `cs`, where cosines and sines are given: what a control
// loop has that computes them once a tick for all its users. The C takes no heap.

#include <pinocchio/autodiff/casadi.hpp>

#include <fstream>
#include <iostream>
#include <regex>
#include <sstream>

#include <pinocchio/algorithm/aba.hpp>
#include <pinocchio/algorithm/crba.hpp>
#include <pinocchio/algorithm/rnea.hpp>

#include "robot.hpp"

using casadi::SX;
using Model = pinocchio::ModelTpl<SX>;
using Data = pinocchio::DataTpl<SX>;
using Vector = Eigen::Matrix<SX, Eigen::Dynamic, 1>;

static Vector vector(const SX &values) {
  Vector result(values.size1());
  for (Eigen::Index i = 0; i < result.size(); ++i) result[i] = values(i);
  return result;
}

template <typename Derived>
static SX column(const Eigen::MatrixBase<Derived> &values) {
  SX result(values.rows(), 1);
  for (Eigen::Index i = 0; i < values.rows(); ++i) result(i) = values(i, 0);
  return result;
}

// The lower triangle by columns: what a user of M needs.
static SX triangle(const Data::MatrixXs &upper) {
  std::vector<SX> entries;
  for (Eigen::Index i = 0; i < upper.rows(); ++i)
    for (Eigen::Index j = i; j < upper.cols(); ++j) entries.push_back(upper(i, j));
  return SX::vertcat(entries);
}

static casadi::Function function(
    const Robot &robot, const std::string &algorithm, Position position) {
  const Model model = pinocchio_model(robot, position).cast<SX>();
  Data data(model);
  const SX v = SX::sym("v", model.nv), u = SX::sym("u", model.nv);
  std::vector<SX> inputs;
  Vector q(model.nq);
  if (position == Position::angle) {
    inputs = {SX::sym("q", model.nq)};
    q = vector(inputs[0]);
  } else {
    inputs = {SX::sym("c", model.nv), SX::sym("s", model.nv)};
    for (int i = 0; i < model.nv; ++i) {
      q[2 * i] = inputs[0](i);
      q[2 * i + 1] = inputs[1](i);
    }
  }
  SX output;
  if (algorithm == "rnea") {
    inputs.insert(inputs.end(), {v, u});
    output = column(pinocchio::rnea(model, data, q, vector(v), vector(u)));
  } else if (algorithm == "bias") {
    inputs.push_back(v);
    output = column(pinocchio::nonLinearEffects(model, data, q, vector(v)));
  } else if (algorithm == "gravity") {
    output = column(pinocchio::computeGeneralizedGravity(model, data, q));
  } else if (algorithm == "crba") {
    output = triangle(pinocchio::crba(model, data, q));
  } else {
    inputs.insert(inputs.end(), {v, u});
    output = column(pinocchio::aba(model, data, q, vector(v), vector(u)));
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
  if (count != 3) throw std::runtime_error("usage: generate ROBOTS OUT");
  for (const Robot &robot : read_robots(arguments[1]))
    for (const char *algorithm : {"rnea", "bias", "gravity", "crba", "aba"})
      for (const Position position : {Position::angle, Position::cos_sin}) {
        const casadi::Function made = function(robot, algorithm, position);
        for (const char *precision : {"f32", "f64"}) write(made, precision, arguments[2]);
      }
  return 0;
} catch (const std::exception &error) {
  std::cerr << "generate: " << error.what() << "\n";
  return 1;
}
