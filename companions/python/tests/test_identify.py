"""Parameters from arrays."""

import numpy as np
import pytest

import robot_dynamics as rd
from test_files import PENDULUM


def test_a_pendulum_from_uneven_times(tmp_path):
    file = tmp_path / "pendulum.urdf"
    file.write_text(PENDULUM)
    truth = rd.Robot.from_text(PENDULUM.replace('mass value="2"', 'mass value="2.4"'))
    rng = np.random.default_rng(1)
    t = np.arange(0, 30, 0.004) + rng.uniform(-4e-4, 4e-4, 7500)
    waves = [(0.5, 1.7), (0.3, 4.1)]
    q, qd, qdd = (sum(a * w**k * np.sin(w * t + k * np.pi / 2) for a, w in waves)[:, None] for k in range(3))
    tau = truth.rnea(q, qd, qdd) + 0.3 * qd + 0.2 * np.tanh(qd / 0.02)
    found = rd.identify(file, 1.7e9 + t, q, tau, joints=["pivot"])
    viscous, coulomb, *_ = found["joints"][0]["after"]
    assert found["mistake"] is None and found["sampling"]["is_resampled"]
    assert abs(viscous - 0.3) < 0.02 and abs(coulomb - 0.2) < 0.02
    body = found["bodies"][0]["after"]
    assert abs(body["mass"] * body["com"][2] / -1.2 - 1) < 0.01
    wrong = rd.identify(file, t, q, -tau)
    assert wrong["mistake"]["kind"] == "torque_sign" and wrong["mistake"]["joints"] == ["pivot"]
    for bad in (dict(effects=["friction"]), dict(width=0.0), dict(cutoff=100.0)):
        with pytest.raises(rd.IdentificationError):
            rd.identify(file, t, q, tau, **bad)
    for q_bad, tau_bad in ((q[:-1], tau), (np.hstack([q, q]), np.hstack([tau, tau])), (np.nan * q, tau)):
        with pytest.raises(rd.IdentificationError):
            rd.identify(file, t, q_bad, tau_bad)
