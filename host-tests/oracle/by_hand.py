"""The same robot by products of transforms and Jacobians in numpy, against which Pinocchio's model is held
before anything is recorded. An error in building the model, or in the order of coordinates, shows here."""

import sys

import numpy as np
import pinocchio as pin
from joints import SIZES, six, unit

Z = np.array([0.0, 0.0, 1.0])


def symmetric(entries):
    xx, xy, xz, yy, yz, zz = entries
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def placement(body):
    p = body["placement"]
    return np.array(p["rotation"]).reshape(3, 3), np.array(p["position"])


def turn(u, q):
    ux = np.cross(u, np.eye(3)).T  # [u]×
    return np.eye(3) + np.sin(q) * ux + (1 - np.cos(q)) * ux @ ux


def attitude(quaternion):
    """v + 2 w e × v + 2 e × (e × v) for each unit vector v."""
    e, w = np.array(quaternion[:3]), quaternion[3]
    return np.array([v + 2 * w * np.cross(e, v) + 2 * np.cross(e, np.cross(e, v)) for v in np.eye(3)]).T


def joint_transform(body, q):
    """Attitude and position of the body in its joint's frame, and S, angular rows first."""
    kind, still = body["joint"], np.zeros(3)
    column = lambda *parts: np.concatenate(parts).reshape(6, 1)
    if kind == "fixed":
        return np.eye(3), still, np.zeros((6, 0))
    if kind == "spherical":
        return attitude(q), still, np.eye(6)[:, :3]
    if kind == "free":
        return attitude(q[:4]), np.array(q[4:]), np.eye(6)
    if kind == "planar":
        return turn(Z, q[0]), np.array([q[1], q[2], 0.0]), np.eye(6)[:, 2:5]
    u = unit(body["axis"])
    if kind in ("revolute", "continuous"):
        return turn(u, q[0]), still, column(u, still)
    if kind == "prismatic":
        return np.eye(3), u * q[0], column(still, u)
    if kind == "helical":
        return turn(u, q[0]), u * body["pitch"] * q[0], column(u, body["pitch"] * u)
    if kind == "cylindrical":
        return turn(u, q[0]), u * q[1], np.hstack([column(u, still), column(still, u)])
    second = turn(unit(body["axis2"]), q[1])  # universal
    s = np.hstack([column(second.T @ u, still), column(unit(body["axis2"]), still)])
    return turn(u, q[0]) @ second, still, s


def bodies(robot, q):
    """For every body its pose and its geometric Jacobian about its own origin in base axes."""
    found, q_at, v_at = [], 0, 0
    n = sum(SIZES[body["joint"]][1] for body in robot["bodies"])
    for body in robot["bodies"]:
        nq, nv = SIZES[body["joint"]]
        r, p, j = found[body["parent"]] if body["parent"] >= 0 else (np.eye(3), np.zeros(3), np.zeros((6, n)))
        r1, p1 = placement(body)
        r2, p2, s = joint_transform(body, q[q_at : q_at + nq])
        here = p + r @ (p1 + r1 @ p2)
        j = j.copy()
        j[3:] += np.cross(j[:3].T, here - p).T  # the same motion at the new origin
        r = r @ r1 @ r2
        j[:3, v_at : v_at + nv], j[3:, v_at : v_at + nv] = r @ s[:3], r @ s[3:]
        found.append((r, here, j))
        q_at, v_at = q_at + nq, v_at + nv
    return found


def totals(robot, q, free_fall, wrenches=None):
    """Mass and centre of mass of all bodies; M(q); g(q); what wrenches in body frames do to the joints.

    M = Σ m Jvᵀ Jv + Jωᵀ I Jω and g = −Σ m Jvᵀ g₀, with the Jacobians of the centres of mass.
    """
    mass, moment, matrix, gravity, forces = 0.0, np.zeros(3), 0.0, 0.0, 0.0
    for k, (body, (r, p, j)) in enumerate(zip(robot["bodies"], bodies(robot, q))):
        arm = r @ np.array(body["com"])
        jv, jw = j[3:] + np.cross(j[:3].T, arm).T, j[:3]
        mass, moment = mass + body["mass"], moment + body["mass"] * (p + arm)
        matrix = matrix + body["mass"] * jv.T @ jv + jw.T @ (r @ symmetric(body["inertia_com"]) @ r.T) @ jw
        gravity = gravity - body["mass"] * jv.T @ np.array(free_fall)
        if wrenches is not None:
            forces = forces + jw.T @ r @ wrenches[k][:3] + j[3:].T @ r @ wrenches[k][3:]
    return mass, moment / mass, matrix, gravity, forces


def torque(robot, free_fall, behind, here, ahead, h, qd, qdd):
    """ID from the bodies' Jacobians now and at ∓h s, by d'Alembert: Σ Jvᵀ m (c̈ − g₀) + Jωᵀ (I ω̇ + ω × I ω)."""
    total = 0.0
    for body, (r, _, j), (_, _, j0), (_, _, j1) in zip(robot["bodies"], here, behind, ahead):
        arm = r @ np.array(body["com"])
        jv, jw = j[3:] + np.cross(j[:3].T, arm).T, j[:3]
        rate = (j1 - j0) / (2 * h) @ qd + j @ qdd
        turning, w = rate[:3], jw @ qd
        moving = rate[3:] + np.cross(turning, arm) + np.cross(w, np.cross(w, arm)) - np.array(free_fall)
        inertia = r @ symmetric(body["inertia_com"]) @ r.T
        total = total + jv.T @ (body["mass"] * moving) + jw.T @ (inertia @ turning + np.cross(w, inertia @ w))
    return total


def close(robot, what, found, expected, tolerance=1e-13):
    scale = max(1.0, np.max(np.abs(expected)))
    error = np.max(np.abs(np.asarray(found) - expected)) / scale
    if not error <= tolerance:
        sys.exit(f"{robot['name']}: {what} is off by {error:.1e} of {scale:.3g}:\n{found}\nnot\n{expected}")


def check(robot, model, order, tip, q, qd, qdd):
    """Pinocchio's model at q, and how it moves with qd, against the above."""
    data, theirs = model.createData(), order.q(q)
    _, _, matrix, gravity, _ = totals(robot, q, model.gravity.linear)
    now = bodies(robot, q)
    r, p, j = now[-1]
    pin.framesForwardKinematics(model, data, theirs)
    close(robot, "attitude of the last body", data.oMf[tip].rotation, r)
    close(robot, "position of the last body", data.oMf[tip].translation, p)
    close(robot, "mass matrix", order.square(pin.crba(model, data, theirs)), matrix)
    close(robot, "gravity", order.v_back(pin.computeGeneralizedGravity(model, data, theirs)), gravity)
    # Moving q along v, in Pinocchio's sense, moves the last body as our Jacobian says.
    h = 1e-6
    move = lambda sign: pin.integrate(model, theirs, order.v(sign * h * qd))
    back, ahead = (bodies(robot, order.q_back(move(sign))) for sign in (-1, 1))
    spin = (ahead[-1][0] - back[-1][0]) / (2 * h) @ r.T
    rate = np.concatenate([[spin[2, 1], spin[0, 2], spin[1, 0]], (ahead[-1][1] - back[-1][1]) / (2 * h)])
    close(robot, "velocity of the last body by differences", rate, j @ qd, 1e-8)
    by_differences = torque(robot, model.gravity.linear, back, now, ahead, h, qd, qdd)
    recursive = order.v_back(pin.rnea(model, data, theirs, order.v(qd), order.v(qdd)))
    close(robot, "torque by differences", recursive, by_differences, 1e-8)
    # Its accelerations with q̈ = 0, each the rate of the velocity in the same frame.
    frames = {"local": pin.LOCAL, "world": pin.WORLD, "mixed": pin.LOCAL_WORLD_ALIGNED}
    for name, frame in frames.items():
        velocity = []
        for sign in (1, -1):
            pin.forwardKinematics(model, data, move(sign), order.v(qd))
            velocity.append(six(pin.getFrameVelocity(model, data, tip, frame)))
        rate = (velocity[0] - velocity[1]) / (2 * h)
        pin.forwardKinematics(model, data, theirs, order.v(qd), np.zeros(model.nv))
        if name == "mixed":
            drift = six(pin.getFrameClassicalAcceleration(model, data, tip, frame))
        else:
            drift = six(pin.getFrameAcceleration(model, data, tip, frame))
        close(robot, f"drift of the last body, {name}", rate, drift, 1e-7)
