// A function that CasADi generated, behind the C interface of the benchmark (see
// pinocchio_peer.cpp). Compiled once for each, with its file, its name and its coordinates:
//
//     cc -DFILE='"ur5e_rnea_q_f64.c"' -DNAME=ur5e_rnea_q_f64 -DPOSITIONS=6 -DVELOCITIES=6 -DOUTPUTS=6 -DCS=0 …

#include <stddef.h>

#define PEER(name) name
#include FILE

#define CONCAT(a, b) a##b
#define RUN(name) CONCAT(casadi_, name)

// With CS a state is cosines, sines, q̇ and q̈ in a row.
__attribute__((visibility("default"))) void RUN(NAME)(
    void *unused, const casadi_real *state, size_t count, casadi_real *out) {
  (void)unused;
  for (; count > 0; --count, out += OUTPUTS) {
    const casadi_real *qd = state + (1 + CS) * POSITIONS;
#if CS
    NAME(state, state + POSITIONS, qd, qd + VELOCITIES, out);
#else
    NAME(state, qd, qd + VELOCITIES, out);
#endif
    state = qd + 2 * VELOCITIES;
  }
}
