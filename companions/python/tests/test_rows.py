"""A row with NaN marks itself, and no other, in every algorithm."""

import numpy as np
import pytest

import machines
import robot_dynamics as rd
from test_arrays import all_of, arguments, cases
from test_machines import closed

ROW = 13


def others(found):
    return [np.delete(result, ROW, 0).tobytes() for result in all_of(found)]


def marks_its_row(call, given, places, free_of=()):
    """`free_of`: arguments that the result does not depend on."""
    whole = call(*given)
    for place in places:
        for value in (np.nan, np.inf):
            for columns in (slice(None), 0):
                hurt = [x.copy() if isinstance(x, np.ndarray) else x for x in given]
                hurt[place][ROW].reshape(-1)[columns] = value
                found = call(*hurt)
                assert others(found) == others(whole), (place, value)
                marked = any(not np.isfinite(result[ROW]).all() for result in all_of(found))
                untouched = all(np.array_equal(a[ROW], b[ROW]) for a, b in zip(all_of(found), all_of(whole)))
                assert marked or (untouched and (columns == 0 or place in free_of)), (place, value, columns)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
@pytest.mark.parametrize(("method", "names", "name"), cases("ur5e", "a1_free"))
def test_a_row_that_is_not_finite_marks_itself_alone(method, names, name, dtype):
    robot = rd.Robot(name)
    given = arguments(robot, names, 24, dtype)
    places = [i for i, argument in enumerate(given) if isinstance(argument, np.ndarray)]
    # Without friction of gears it is τ.
    free_of = (0, 1) if method == "transmitted_torque" else ()
    marks_its_row(getattr(robot, method), given, places, free_of)


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_a_single_state_is_marked_too(dtype):
    robot = rd.Robot("ur5e")
    given = [x[0] for x in arguments(robot, "q v t", 3, dtype)]
    given[0][2] = np.nan
    for call in (robot.aba, robot.forward_dynamics):
        assert np.isnan(call(*given)).all()


@pytest.mark.parametrize("dtype", [np.float32, np.float64])
def test_machines_mark_their_rows(dtype):
    bars = machines.bars()
    linkages = rd.Linkages(bars, [("bar", machines.four_bar(), [0, 1, 2])])
    y = np.linspace(0.2, 0.9, 24).reshape(24, 1).astype(dtype)
    for call in (linkages.motion, linkages.rnea, linkages.forward_dynamics):
        marks_its_row(call, [y, y.copy(), y.copy()], [0, 1, 2])
    loops = rd.Loops(bars, [machines.pin()], [0])
    guess = np.tile(np.array([0.4, 0.3, 0.9], dtype), (24, 1))
    q = loops.assemble(guess)
    v, tau = 0 * q, y
    marks_its_row(loops.assemble, [guess], [0])
    marks_its_row(loops.constraints, [q, v], [0, 1])
    marks_its_row(loops.coordinate_map, [q], [0])
    marks_its_row(loops.mobility, [q], [0])
    marks_its_row(loops.inverse_dynamics, [q, y, y.copy()], [0, 1, 2])
    marks_its_row(loops.forward_dynamics, [q, v, tau], [0, 1, 2])
    boom = machines.boom()
    q, eta = np.full((24, 2), 0.3, dtype), np.full((24, 3), 1e-3, dtype)
    q = q[:]
    rates = [0 * q, 0 * q, eta, 0 * eta]
    marks_its_row(boom.rnea, [q, *rates, 0 * eta], range(6))
    marks_its_row(boom.crba, [q, eta], [0, 1])
    marks_its_row(boom.frequencies, [q, eta], [0, 1])
    marks_its_row(boom.forward_dynamics, [q, *rates], range(5))
    marks_its_row(boom.modal_dynamics, [q, *rates], range(5))
    marks_its_row(boom.at_rest, [q], [0])
    marks_its_row(lambda *given: boom.tick(*given, 1e-3), [q, *rates, 0 * eta], range(6))


def test_a_singular_row_that_is_finite_is_an_error():
    """An error that no NaN causes is a defect of the robot or the state, and is raised."""
    robot, _, (q, v, a, tau), _ = closed("fixed")
    m = np.tile(np.eye(robot.nv), (3, 1, 1))
    m[1] *= -1.0
    with pytest.raises(rd.NotPositiveDefinite) as error:
        robot.ltdl(m)
    assert error.value.state == 1
    m[1, 0, 0] = np.nan
    assert np.isnan(robot.ltdl(m)[0][1]).all() and np.isfinite(robot.ltdl(m)[0][[0, 2]]).all()
