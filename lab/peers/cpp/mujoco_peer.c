// MuJoCo's dynamics behind the C interface of the benchmark (see pinocchio_peer.cpp).

#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <mujoco/mujoco.h>

#define EXPORT __attribute__((visibility("default")))

struct peer {
  mjModel *model;
  mjData *data;
};

EXPORT void *mujoco_f64_open(const char *path, const char *name) {
  (void)name;
  char error[1000] = "";
  struct peer *peer = malloc(sizeof *peer);
  peer->model = mj_loadXML(path, NULL, error, sizeof error);
  if (!peer->model) {
    fprintf(stderr, "mujoco: %s\n", error);
    return NULL;
  }
  peer->data = mj_makeData(peer->model);
  return peer;
}

static void load(const struct peer *peer, const double *state) {
  const size_t n = peer->model->nv;
  memcpy(peer->data->qpos, state, n * sizeof *state);
  memcpy(peer->data->qvel, state + n, n * sizeof *state);
  memcpy(peer->data->qacc, state + 2 * n, n * sizeof *state);
}

// What a user calls: the whole pipeline of inverse dynamics, more than torques alone need.
EXPORT void mujoco_f64_inverse(void *context, const double *state, size_t count, double *out) {
  const struct peer *peer = context;
  const size_t n = peer->model->nv;
  for (; count > 0; --count, state += 3 * n, out += n) {
    load(peer, state);
    mj_inverse(peer->model, peer->data);
    memcpy(out, peer->data->qfrc_inverse, n * sizeof *out);
  }
}

// The stages of it that the torques of a robot without contacts need.
EXPORT void mujoco_f64_rnea(void *context, const double *state, size_t count, double *out) {
  const struct peer *peer = context;
  const size_t n = peer->model->nv;
  for (; count > 0; --count, state += 3 * n, out += n) {
    load(peer, state);
    mj_kinematics(peer->model, peer->data);
    mj_comPos(peer->model, peer->data);
    mj_comVel(peer->model, peer->data);
    mj_rne(peer->model, peer->data, 1, out);
  }
}

// M, dense, after the stages that it needs.
EXPORT void mujoco_f64_crba(void *context, const double *state, size_t count, double *out) {
  const struct peer *peer = context;
  const size_t n = peer->model->nv;
  for (; count > 0; --count, state += 3 * n, out += n * n) {
    load(peer, state);
    mj_kinematics(peer->model, peer->data);
    mj_comPos(peer->model, peer->data);
    mj_makeM(peer->model, peer->data);
    mj_fullM(peer->model, peer->data, out);
  }
}

// The stages that the accelerations of a robot without contacts need: bias, M, its factors, their
// solution. The torque stands in the place of q̈.
EXPORT void mujoco_f64_forward(void *context, const double *state, size_t count, double *out) {
  const struct peer *peer = context;
  mjData *data = peer->data;
  const size_t n = peer->model->nv;
  for (; count > 0; --count, state += 3 * n, out += n) {
    load(peer, state);
    mj_kinematics(peer->model, data);
    mj_comPos(peer->model, data);
    mj_makeM(peer->model, data);
    mj_factorM(peer->model, data);
    mj_comVel(peer->model, data);
    mj_rne(peer->model, data, 0, data->qfrc_bias);
    for (size_t i = 0; i < n; ++i) data->qfrc_smooth[i] = state[2 * n + i] - data->qfrc_bias[i];
    mj_solveM(peer->model, data, out, data->qfrc_smooth, 1);
  }
}
