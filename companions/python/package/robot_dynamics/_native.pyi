"""The compiled part; use it as `robot_dynamics`."""

import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, Literal, final

import numpy.typing as npt

_Array = npt.ArrayLike
_Result = npt.NDArray[Any]
_Frame = Literal["local", "world", "local_world_aligned"]
_Effects = Scene | Sequence[Scene]
_Vector = Sequence[float] | npt.NDArray[Any]
_Rotation = Sequence[_Vector] | npt.NDArray[Any]
_Body = str | int
_Coordinate = str | int

__all__ = [
    "RIGID_BODY",
    "Advice",
    "Armature",
    "AsymmetricCoulomb",
    "Beam",
    "Belt",
    "BodyWrench",
    "Cogging",
    "ConstantTorque",
    "Contact",
    "Coriolis",
    "Cost",
    "Coulomb",
    "Coupling",
    "Delta",
    "Differential",
    "EndStops",
    "FiveBar",
    "FlexibleLink",
    "FlexibleRobot",
    "FourBar",
    "Gravity",
    "GyroscopicRotors",
    "Inertia",
    "Linkage",
    "Linkages",
    "LoadFriction",
    "LoopJoint",
    "Loops",
    "Lugre",
    "Mode",
    "MovingBase",
    "MovingGoal",
    "OwnEffect",
    "ParallelAnkle",
    "Payload",
    "PoseSolver",
    "Robot",
    "Scene",
    "SensorLoad",
    "Spring",
    "Stewart",
    "Stribeck",
    "ThermalLimit",
    "TipMotion",
    "Viscous",
    "WorldWrench",
    "__version__",
    "_robot",
    "_scene",
    "identify",
    "robots",
    "threads",
]

RIGID_BODY: Scene
__version__: str

def _robot(numbers: str) -> Robot: ...
def _scene(effects: str, own: Sequence[Callable[..., Any]] | None = None) -> Scene: ...
def identify(
    robot_file: str | os.PathLike[str],
    time: npt.NDArray[Any],
    q: npt.NDArray[Any],
    tau: npt.NDArray[Any],
    *,
    joints: Sequence[str] | None = None,
    effects: Sequence[str] = ...,
    width: float = 0.02,
    cutoff: float | None = None,
) -> dict[str, Any]: "Masses, inertias and frictions of the robot of a URDF or MJCF from a recording of any motion:\ntime (n,), s, q (n, joints), rad or m, and tau (n, joints), N·m or N, all float64. Times may be\nuneven, have gaps, and start anywhere. It computes without the interpreter's lock.\n\n`joints` names the columns of q and tau; the robot's other joints are locked. Without it they\nare the robot's joints.\n`effects` are of \"viscous\", \"coulomb\", \"armature\", \"load\", \"preslide\", \"offset\", \"stribeck\" and\n\"asymmetric\"; `width` is the speed below which Coulomb friction fades, rad/s or m/s, and torques\nare compared up to `cutoff`, Hz, or the highest frequency that the rate allows. The dict is the\nJSON of `cargo xtask identify`.\n\nRaises IdentificationError; of a robot of more than eight joints, too."
def robots() -> list[str]: "The names of the library's robots."
def threads() -> int: "The number of threads that a batch uses."
@final
class Scene:
    "Effects that act together on a robot.\n\nAn effect such as ``Gravity()`` is a scene of one; ``a + b`` has the effects of both. A function\nthat takes a scene takes a tuple of scenes, too. Two effects of a kind that cannot mean two\nthings are refused, as in the library."
    def __new__(cls, *scenes: Scene) -> Scene: ...
    def __add__(self, other: _Effects, /) -> Scene: ...
    def __radd__(self, other: _Effects, /) -> Scene: ...
    def __len__(self) -> int: ...
    def __contains__(self, name: str, /) -> bool: ...
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, _memo: Any, /) -> Scene: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    @property
    def names(self) -> list[str]: "The names of its effects, in their order."

def OwnEffect(function: Callable[[_Result, _Result], _Array]) -> Scene: "A torque of one's own: ``function(q, qd)`` returns the torques (…, nv), N·m or N, that motors\nsupply, as of `Viscous`, for q (…, nq) and q̇ (…, nv) of all states of a call at once, float64.\n\nIt acts in `rnea`, `bias`, `aba` and `forward_dynamics` of a `Robot`."
def Gravity(g: float = 9.81, direction: _Vector = ...) -> Scene: "Gravity: ``g`` in m/s² along ``direction`` in the base's axes, a vector of length 1."
def Inertia() -> Scene: "The products of inertia and acceleration, M q̈."
def Coriolis() -> Scene: "The products of velocities, C(q, q̇) q̇."
def MovingBase(velocity: _Vector, acceleration: _Vector) -> Scene: "A base that moves: spatial velocity (rad/s, m/s) and acceleration (rad/s², m/s²),\nangular part first, at its origin and in its axes."
def Viscous(coefficients: _Vector) -> Scene: "Viscous friction b q̇: b of each velocity coordinate, N·m·s/rad or N·s/m."
def Coulomb(torque: _Vector, width: float) -> Scene: "Dry friction: the torque of each velocity coordinate, N·m or N, which is full beyond\nthe speed ``width``, rad/s or m/s."
def AsymmetricCoulomb(forward: _Vector, backward: _Vector, width: float) -> Scene: "Dry friction that differs by direction: torques N·m or N, width rad/s or m/s."
def Stribeck(excess: _Vector, stribeck_speed: float, width: float) -> Scene: "The excess of friction at low speed, N·m or N, which falls with the speed\n``stribeck_speed``; widths rad/s or m/s."
def Lugre(
    stiffness: _Vector,
    damping: _Vector,
    viscous: _Vector,
    sliding: _Vector,
    excess: _Vector,
    stribeck_speed: float,
    bristle: _Vector,
) -> Scene: "The LuGre model at a given deflection of its bristles, rad or m: stiffness, damping,\nviscous, sliding and excess of each velocity coordinate. The bristles stand still\nhere; a simulation advances them."
def LoadFriction(driving: _Vector, backdriving: _Vector, width: float) -> Scene: "Friction of gears that grows with the load: the factors when driving and when\ndriven, and a width, rad/s or m/s."
def Spring(stiffness: _Vector, rest: _Vector) -> Scene: "A spring at each joint: stiffness N·m/rad or N/m, rest position rad or m."
def EndStops(
    lower: _Vector, upper: _Vector, stiffness: float, damping: float, damping_depth: float
) -> Scene: "Stops at both ends of each joint: positions rad or m, stiffness N·m/rad, damping\nN·m·s/rad from a depth of ``damping_depth`` rad on."
def Cogging(per_turn: _Vector, cos: Sequence[_Vector], sin: Sequence[_Vector]) -> Scene: "Cogging: periods per turn of each joint, and per joint the torques of up to 8\nharmonics, N·m. Periods times angle may be up to 10⁴ rad in float32 and 10⁵ rad in\nfloat64."
def ConstantTorque(torque: _Vector) -> Scene: "A constant torque that the motor of each joint supplies in any state, N·m or N: the\noffset of a sensor, or the mean of a friction that differs with direction."
def Armature(inertia: _Vector) -> Scene: "The inertia of each motor at its joint, kg·m² or kg."
def GyroscopicRotors(inertia: _Vector, ratio: _Vector) -> Scene: "Rotors that spin on the links before their joints: moment of inertia of each about\nits axis, kg·m², and the ratio of its gear, rad of the rotor per rad or m of the\njoint, negative for the opposite sense; zeros where there is none.\n\n`Armature` of I ρ² has their inertia at the joints alone. `centroidal_matrix` and\n`osim_inverse` do not take them."
def Payload(body: _Body, mass: float, com: _Vector = ..., inertia: _Vector = ...) -> Scene: "A load on a body: mass kg, centre of mass m in the body's frame, inertia about it\n(xx, xy, xz, yy, yz, zz) kg·m²."
def BodyWrench(body: _Body, wrench: _Vector) -> Scene: "A wrench on a body in its own frame: couple N·m, then force N."
def WorldWrench(body: _Body, wrench: _Vector) -> Scene: "A wrench at a body's origin in the base's axes: couple N·m, then force N."
def Contact(
    points: Sequence[tuple[_Body, _Vector]],
    normal: _Vector,
    height: float,
    stiffness: float,
    damping: float,
    damping_depth: float,
    friction: float,
    slip_tolerance: float,
) -> Scene: "Points of bodies that touch a plane n·x = height (m), n being ``normal``, a vector\nof length 1: stiffness N/m, damping N·s/m from ``damping_depth`` m on, coefficient\nof friction, and the speed below which friction sticks, m/s."
@final
class Cost:
    "The cost of one call on a modelled Cortex-M4F with zero-wait memory, the slowest of 32 random\nstates."
    @property
    def algorithm(self) -> str: "The algorithm's name, such as \"rnea\"."
    @property
    def form(self) -> str: "\"core\", the textbook form, or \"engine\", the form that is specialised to the robot."
    @property
    def inputs(self) -> str: "The effects, such as \"full\": gravity, inertia and velocity products."
    @property
    def trigonometry(self) -> bool: "Whether sines and cosines are computed inside the call."
    @property
    def instructions(self) -> int: "The number of instructions, which is exact."
    @property
    def cycles(self) -> int: "The number of cycles, which is modelled."
    @property
    def microseconds(self) -> float: "The time at 168 MHz, µs."
    @property
    def code(self) -> int: "Instructions and literals, bytes."
    @property
    def stack(self) -> int: "Bytes that are written to."

@final
class Advice:
    "A piece of advice on a file, as ``cargo xtask import`` prints it."
    @property
    def topic(self) -> str: "Its kind, such as \"units\", \"torque\", \"limits\" or \"left-out\"."
    @property
    def line(self) -> int | None: "The line of the file; None if none is concerned."
    @property
    def name(self) -> str: "The name of the link or joint."
    @property
    def text(self) -> str: "A sentence with the reason."

@final
class Coupling:
    "A joint that follows another: its position is ``ratio`` times the position of ``leader``, and\n``offset``, rad or m.\n\nA robot has a coordinate for each of both; a motor drives them together."
    @property
    def joint(self) -> str: "The name of the joint that follows."
    @property
    def leader(self) -> str: "The joint that it follows."
    @property
    def ratio(self) -> float: "The travel for each rad or m of the leader."
    @property
    def offset(self) -> float: "Its position where the leader is at zero, rad or m."

@final
class Robot:
    "A robot: a tree of bodies on joints.\n\n``Robot(\"ur5e\")`` is a robot of the library, `robots()` lists their names; `Robot.from_file` and\n`Robot.from_text` read URDF and MJCF. Units are SI: rad, m, kg, N·m, N.\n\nEvery method takes arrays of one state, such as q of shape (nq,), or of many, with any leading\naxes, which broadcast as numpy's: (n, nq) and (nv,) give (n, nv). All arrays of a call are\nfloat32 or all are float64, and so is the result; lists and integers have the type of the arrays\nbeside them, else float64. In float32 the results have the bits of\nthe same algorithm (`Core`) in firmware. Batches release Python's lock and use all cores.\n\nq has the coordinates of each joint in the order of the bodies: an angle or a length; of a ball\njoint a quaternion (x, y, z, w), of a free joint that and then the position; q̇ of a free joint\nhas the angular velocity first, both in the body's axes.\n\nAngles may have any size. Sines are computed to ±10⁴ rad in float32 and to ±10⁵ rad in float64;\nof an angle beyond, whole turns are subtracted in float64 before the call. AngleError names joint\nand state where turns matter: at joints with a spring, end stops or cogging, in `elastic_inverse_dynamics`\nand `Loops.assemble`, which return positions, and in linkages.\n\nA state with a NaN or an infinite number has NaN in its own row of the results; the others of\nits batch are computed."
    def __new__(cls, name: str) -> Robot: ...
    @staticmethod
    def from_file(
        path: str | os.PathLike[str],
        *,
        base: str | None = None,
        tip: str | None = None,
        joints: Sequence[str] | None = None,
        without: Sequence[str] | None = None,
        lock: Mapping[str, float] | None = None,
        free_base: bool = False,
        exact: bool = True,
    ) -> Robot: "A robot from a URDF or MJCF.\n\nbase: the link that stands still, else the root; tip: only the joints up to this link move;\njoints: only these move; without: links that are left out with all that they carry; lock:\npositions (rad, m) of joints that stand still; free_base: the base is free; exact: right\nangles and zeros in place of their roundings."
    @staticmethod
    def from_text(
        text: str,
        folder: str | os.PathLike[str] | None = None,
        *,
        base: str | None = None,
        tip: str | None = None,
        joints: Sequence[str] | None = None,
        without: Sequence[str] | None = None,
        lock: Mapping[str, float] | None = None,
        free_base: bool = False,
        exact: bool = True,
    ) -> Robot: "A robot from the text of a URDF or MJCF; the files that an MJCF includes are in ``folder``.\nThe keywords are those of `from_file`."
    @property
    def name(self) -> str: "The name of the robot."
    @property
    def library_name(self) -> str | None: "Its name in `robots()`, or None if it was read from a file."
    @property
    def nq(self) -> int: "The number of position coordinates."
    @property
    def nv(self) -> int: "The number of velocity coordinates."
    @property
    def bodies(self) -> list[str]: "The names of the bodies, parents first: links, of which what is fixed to them is a part."
    @property
    def frames(self) -> list[str]: "The names of the frames that are fixed to bodies or the base, such as a tool's: fixed links\nof the file. Methods that ask for a body take them."
    @property
    def joints(self) -> list[str]: "The name of the joint of each body, as in the file; of a robot of the library, in the file\nof its source."
    @property
    def joint_kinds(self) -> list[str]: "The kind of the joint of each body, such as \"revolute\"."
    @property
    def parents(self) -> list[int | None]: "The parent of each body by its number, or None for the base."
    @property
    def lower_limits(self) -> _Result: "The lower limit of each velocity coordinate's position, rad or m; -inf if there is none."
    @property
    def upper_limits(self) -> _Result: "The upper limit of each velocity coordinate's position, rad or m; inf if there is none."
    @property
    def velocity_limits(self) -> _Result: "The largest speed of each velocity coordinate, rad/s or m/s; inf if there is none."
    @property
    def torque_limits(self) -> _Result: "The largest torque of each velocity coordinate, N·m or N; inf if there is none."
    @property
    def damping(self) -> _Result: "Viscous friction of the file, N·m·s/rad or N·s/m, for `Viscous`."
    @property
    def friction(self) -> _Result: "Dry friction of the file, N·m or N, for `Coulomb`."
    @property
    def armature(self) -> _Result: "Inertia of the motors of the file, kg·m² or kg, for `Armature`."
    @property
    def spring_stiffness(self) -> _Result: "Stiffness of the springs of the file, N·m/rad or N/m, for `Spring`."
    @property
    def spring_rest(self) -> _Result: "Positions at which the springs of the file are at rest, rad or m, for `Spring`."
    @property
    def advice(self) -> list[Advice]: "Advice on the file, as ``cargo xtask import`` prints it, but for what that finds at random\nstates: impossible inertias, numbers in other units, limits of torque below gravity's, and\nwhat is left out. Options in it are those of the command: ``--motors`` is ``actuated`` of\n`Loops`. Empty for a robot of the library."
    @property
    def notes(self) -> list[str]: "Statements of the file that the robot lacks, a sentence each: the advice of the topic\n\"left-out\"."
    @property
    def couplings(self) -> list[Coupling]: "The joints of the file that follow others (``<mimic>``, ``<equality>``). Their coordinates\nare those of a tree: set q of both, and the torque at the leader is τ of the leader plus the\nsum of ratio times τ of the followers."
    def scene(self, width: float = 0.02) -> Scene: "The scene of a rigid body and of what the file states: damping, friction, which is full\nbeyond the speed ``width``, rad/s or m/s, armatures and springs, as in what ``cargo xtask\nimport`` writes."
    def __eq__(self, other: object, /) -> bool: ...
    def __ne__(self, other: object, /) -> bool: ...
    def __hash__(self) -> int: ...
    def __copy__(self) -> Robot: ...
    def __deepcopy__(self, _memo: Any, /) -> Robot: ...
    def __reduce__(self) -> tuple[Any, ...]: ...
    def body_index(self, name: _Body) -> int: "The number of a body of that name."
    def neutral(self) -> _Result: "The configuration of rest, (nq,): zeros and quaternions of no rotation."
    def costs(self) -> list[Cost]: "The cost of each algorithm on a Cortex-M4F for this robot, from the repository's records.\n\nRaises NotRecorded for a robot without a record, such as one from a file."
    def scene_cycles(self) -> int: "The longest tick of the robot's scene on a Cortex-M4F, cycles: encoders, reference,\ndynamics, safety and drives.\n\nRaises NotRecorded for a robot without a scene."
    def rnea(self, q: _Array, qd: _Array, qdd: _Array, effects: _Effects | None = None) -> _Result: "Inverse dynamics: the torques (…, nv), N·m or N, for q (…, nq), q̇ and q̈ (…, nv). Equations\n(3) to (8) of Featherstone and Orin."
    def bias(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> _Result: "The torques (…, nv), N·m or N, at q (…, nq) and q̇ (…, nv) without acceleration: C(q, q̇)\nq̇ + g(q) and the other effects."
    def gravity(self, q: _Array, effects: _Effects | None = None) -> _Result: "The torques (…, nv), N·m or N, that hold the robot against gravity at q (…, nq). No other\neffects than Gravity and loads act."
    def rnea_and_wrenches(self, q: _Array, qd: _Array, qdd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "Inverse dynamics with the wrenches in joints: the torques (…, nv), N·m or N, and the wrench\nthat the parent exerts on each body through its joint, (…, bodies, 6), couple and force,\nN·m and N, in the body's own frame; q (…, nq), q̇ and q̈ (…, nv). That of a body beyond a\nforce sensor is what the sensor shows, but for its offset."
    def rnea_two_velocities(self, q: _Array, qd: _Array, qdd: _Array, qd_r: _Array, effects: _Effects | None = None) -> _Result: "M q̈_r + C(q, q̇) q̇_r + g and the other effects, (…, nv): q (…, nq), q̇, q̈_r and q̇_r (…,\nnv)."
    def crba(self, q: _Array, effects: _Effects | None = None) -> _Result: "M(q), the joint-space inertia matrix (…, nv, nv), kg·m² or kg, with the motors' `Armature`;\nq (…, nq)."
    def inverse_mass(self, q: _Array, effects: _Effects | None = None) -> _Result: "M(q)⁻¹ (…, nv, nv); q (…, nq)."
    def crba_jacobian(self, q: _Array, body: _Body, effects: _Effects | None = None) -> tuple[_Result, _Result]: "M(q) (…, nv, nv), kg·m² or kg, and J (…, 6, nv) of a body in its own frame, angular rows\nfirst, at once; q (…, nq)."
    def ltdl(self, m: _Array) -> tuple[_Result, _Result]: "The factors of M = Lᵀ D L: L (…, nv, nv), lower triangular with a unit diagonal, and the\nreciprocals of D (…, nv), 1/(kg·m²) or 1/kg; M (…, nv, nv), kg·m² or kg, of which the\nentries up to the diagonal are read. L is zero wherever M is: of two coordinates on\ndifferent branches.\n\nRaises NotPositiveDefinite with the joint that moves no inertia."
    def solve(self, l: _Array, d_inv: _Array, tau: _Array) -> _Result: "x (…, nv) with M x = τ, rad/s² or m/s², by the factors of `ltdl`: L (…, nv, nv), the\nreciprocals of D and τ (…, nv), N·m or N."
    def inverse(self, l: _Array, d_inv: _Array) -> _Result: "M⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, by the factors of `ltdl`: L (…, nv, nv) and the\nreciprocals of D (…, nv)."
    def cholesky(self, m: _Array) -> tuple[_Result, _Result]: "The factor of M = Lᵀ L: L (…, nv, nv), lower triangular, √kg·m or √kg, and the reciprocals\nof its diagonal (…, nv); M (…, nv, nv), kg·m² or kg, of which the entries up to the diagonal\nare read.\n\nRaises NotPositiveDefinite with the joint that moves no inertia."
    def cholesky_solve(self, l: _Array, l_inv: _Array, tau: _Array) -> _Result: "x (…, nv) with M x = τ, rad/s² or m/s², by the factor of `cholesky`: L (…, nv, nv), the\nreciprocals of its diagonal and τ (…, nv), N·m or N."
    def spatial_operator_ltdl(self, q: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "The factors of `ltdl` without M, by the spatial operators of articulated bodies: L (…, nv,\nnv) and the reciprocals of D (…, nv), 1/(kg·m²) or 1/kg; q (…, nq)."
    def spatial_operator_inverse(self, q: _Array, effects: _Effects | None = None) -> _Result: "M(q)⁻¹ (…, nv, nv), 1/(kg·m²) or 1/kg, without M, by the spatial operators of articulated\nbodies; q (…, nq)."
    def acceleration_error(self, m: _Array, l: _Array, d_inv: _Array, qdd: _Array, terms: _Array) -> _Result: "The estimated error (…, nv), rad/s² or m/s², that rounding leaves in a solution q̈ (…, nv)\nof M q̈ = b: M (…, nv, nv), L and the reciprocals of D of `ltdl`, q̈, and the sums of the\nmagnitudes of the terms of b (…, nv), N·m or N."
    def aba(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None) -> _Result: "Forward dynamics by articulated bodies: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ\n(…, nv)."
    def forward_dynamics(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None) -> _Result: "Forward dynamics by M and its factors: q̈ (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ\n(…, nv)."
    def rnea_derivatives(self, q: _Array, qd: _Array, qdd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "The derivatives of inverse dynamics, ∂τ/∂q and ∂τ/∂q̇, each (…, nv, nv), by rows of τ: N·m/rad\nand N·m·s/rad between revolute joints, N/m and N·s/m between prismatic ones; q (…, nq), q̇\nand q̈ (…, nv). ∂τ/∂q is along `integrate`; ∂τ/∂q̈ is `crba`. `Lugre`, wrenches, rotors that\nspin and friction of gears have no place."
    def forward_dynamics_derivatives(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result]: "The derivatives of forward dynamics, ∂q̈/∂q, ∂q̈/∂q̇ and ∂q̈/∂τ = M⁻¹, each (…, nv, nv), by\nrows of q̈: 1/s², 1/s and 1/(kg·m²) between revolute joints; q (…, nq), q̇ and τ (…, nv). As\n`rnea_derivatives`."
    def forward_dynamics_with_error(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "Forward dynamics by M and its factors, with the error that rounding leaves: q̈ and its\nestimated error, each (…, nv), rad/s² or m/s², for q (…, nq), q̇ and τ (…, nv). It says\nwhether float32 serves for a robot and a state."
    def elastic_inverse_dynamics(self, q: _Array, qd: _Array, qdd: _Array, jerk: _Array, snap: _Array, stiffness: _Vector, rotor: _Vector, friction: _Vector, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result]: "Inverse dynamics with elastic joints: of each motor, reflected to the joint, its torque, N·m\nor N, position, rad or m, and velocity, rad/s or m/s, each (…, nv), for a motion of the\nlinks with four derivatives: q (…, nq), q̇, q̈, jerk, rad/s³ or m/s³, and snap (…, nv),\nrad/s⁴ or m/s⁴.\n\nThe arguments of each joint, (nv,), are the stiffness of the transmission, N·m/rad or N/m,\nthe inertia of the rotor, kg·m² or kg, and the viscous friction of the motor, N·m·s/rad or\nN·s/m, reflected. Effects act on the links; wrenches, rotors that spin, friction of gears\nand a moving base have no place.\n\nRaises MultiDofJoint for a joint of several coordinates."
    def hybrid_dynamics(self, q: _Array, qd: _Array, given: _Array, accelerated: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "Torques and accelerations, each (…, nv), where of each coordinate one is given: its torque,\nor, where ``accelerated`` is not zero, its acceleration. q (…, nq), q̇, given and\naccelerated (…, nv)."
    def transmitted_torque(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None) -> _Result: "The part of the motors' torques τ (…, nv) that arrives behind the friction of the gears\n(`LoadFriction`), (…, nv)."
    def jacobian(self, q: _Array, body: _Body, frame: _Frame = "local") -> _Result: "J (…, 6, nv) of a body with v = J q̇, angular rows first; q (…, nq). ``frame``: \"local\",\n\"world\" or \"local_world_aligned\"."
    def bias_acceleration(self, q: _Array, qd: _Array, body: _Body, frame: _Frame = "local") -> _Result: "J̇ q̇ of a body, (…, 6), rad/s² and m/s²: what `jacobian` leaves of the derivative of v = J\nq̇ without q̈; q (…, nq), q̇ (…, nv). In the frames \"local\" and \"world\" it is the spatial\nacceleration, as that of `kinematics` at q̈ = 0; in \"local_world_aligned\" its linear part is\nthe acceleration of the body's origin, and that of `kinematics` is less by ω × v."
    def poses(self, q: _Array, at: _Body | None = None) -> tuple[_Result, _Result]: "Rotation matrices (…, bodies, 3, 3) from each body's frame to the base's, and positions (…,\nbodies, 3), m, or those of the body or frame ``at``, (…, 3, 3) and (…, 3); q (…, nq)."
    def kinematics(self, q: _Array, qd: _Array, qdd: _Array, frame: _Frame = "local", effects: _Effects | None = None, at: _Body | None = None) -> tuple[_Result, _Result]: "Spatial velocities (rad/s, m/s) and accelerations (rad/s², m/s²) of all bodies, each (…,\nbodies, 6), angular part first, or of the body or frame ``at``, (…, 6); q (…, nq), q̇ and q̈\n(…, nv)."
    def kinetic_energy(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> _Result: "The kinetic energy (…), J; q (…, nq), q̇ (…, nv)."
    def potential_energy(self, q: _Array, effects: _Effects | None = None) -> _Result: "The potential energy in the field of gravity (…), J, zero at the base's origin; q (…, nq)."
    def momentum(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> _Result: "The momentum of all bodies about the base's origin (…, 6): N·m·s, then N·s; q (…, nq), q̇\n(…, nv)."
    def centroidal_momentum(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> _Result: "The momentum of all bodies about their centre of mass (…, 6): N·m·s, then N·s; q (…, nq), q̇\n(…, nv)."
    def centroidal_matrix(self, q: _Array, effects: _Effects | None = None) -> _Result: "A(q) (…, 6, nv) with A q̇ the momentum about the centre of mass; q (…, nq)."
    def center_of_mass(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result]: "Mass (…), kg, position (…, 3), m, and velocity (…, 3), m/s, of the centre of mass; q (…,\nnq), q̇ (…, nv)."
    def momentum_and_coriolis(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "p = M q̇ and Cᵀ q̇, each (…, nv), for observers of external torques; q (…, nq), q̇ (…, nv)."
    def momentum_and_drift(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "p = M q̇ and β = Cᵀ q̇ − g − F, each (…, nv); q (…, nq), q̇ (…, nv)."
    def coriolis_matrix(self, q: _Array, qd: _Array, effects: _Effects | None = None) -> _Result: "C(q, q̇) (…, nv, nv), of Christoffel's symbols; q (…, nq), q̇ (…, nv)."
    def base_velocity_from_momentum(self, q: _Array, qd: _Array, h: _Array, effects: _Effects | None = None) -> _Result: "q̇ (…, nv) with the rates of the free base for which the momentum of all bodies about the\nbase's origin is h (…, 6); q (…, nq), q̇ (…, nv)."
    def osim_inverse(self, q: _Array, body: _Body, frame: _Frame = "local", effects: _Effects | None = None) -> _Result: "Λ⁻¹ = J M⁻¹ Jᵀ of a body, (…, 6, 6), by propagation of forces; q (…, nq)."
    def operational_space(self, q: _Array, body: _Body, frame: _Frame = "local", effects: _Effects | None = None, damping: float = 1e-6) -> tuple[_Result, _Result, _Result, _Result]: "J (…, 6, nv), J M⁻¹ (…, 6, nv), Λ⁻¹ and Λ (…, 6, 6) of a body, Λ damped by ``damping``\nrelative to the largest eigenvalue of Λ⁻¹ where it is nearly singular; q (…, nq)."
    def regressor(self, q: _Array, qd: _Array, qdd: _Array, effects: _Effects | None = None) -> _Result: "Y (…, nv, bodies, 10) with τ = Y φ, φ of a body: m, m c (3), then Ixx, Ixy, Iyy, Ixz, Iyz,\nIzz about the origin of its frame whose z is the joint's axis; q (…, nq), q̇ and q̈ (…, nv)."
    def regressor_columns(self, q: _Array, qd: _Array, qdd: _Array, body: _Body, effects: _Effects | None = None) -> _Result: "The columns (…, nv, 10) of one body in `regressor`; q (…, nq), q̇ and q̈ (…, nv)."
    def regressor_row(self, q: _Array, qd: _Array, qdd: _Array, coordinate: _Coordinate, effects: _Effects | None = None) -> _Result: "The row (…, bodies, 10) of one velocity coordinate in `regressor`, given by its number or\nits joint, by powers of the bodies; q (…, nq), q̇ and q̈ (…, nv)."
    def inertial_parameters(self, effects: _Effects | None = None) -> _Result: "φ (bodies, 10) of `regressor`, float64: the inertial parameters of the bodies with the loads\non them, kg, kg·m and kg·m²."
    def friction_regressor(self, qd: _Array, width: float) -> _Result: "The regressor of friction (…, nv, 2): of each coordinate q̇ for the coefficient of\n`Viscous`, N·m·s/rad or N·s/m, and the smooth sign of `Coulomb` of this width, rad/s or m/s,\nfor its torque, N·m or N; q̇ (…, nv)."
    def normalise(self, q: _Array) -> _Result: "q (…, nq) with quaternions of unit length, and angles of continuous joints within half a\nturn.\n\nRaises NoAttitude for a quaternion of length zero."
    def integrate(self, q: _Array, delta: _Array) -> _Result: "q ⊕ δ (…, nq): the configuration after a unit of time at the velocity δ (…, nv)."
    def difference(self, q0: _Array, q1: _Array) -> _Result: "q₁ ⊖ q₀ (…, nv): the velocity that leads from q₀ to q₁ (…, nq) in a unit of time."

@final
class MovingGoal:
    "The motion to a goal that may change at any tick, from any state, with limits of velocity,\nacceleration and jerk, as firmware has it, in float64.\n\nIt rests at q, rad or m, with ticks of `tick` seconds; of each joint velocity, rad/s or m/s,\nacceleration and jerk are the greatest. Joints arrive together, or earlier if they have to brake\nas fast as they can."
    def __new__(
        cls, q: _Vector, tick: float, velocity: _Vector, acceleration: _Vector, jerk: _Vector
    ) -> MovingGoal: ...
    @property
    def ticks(self) -> int: "The tick of the arrival."
    def set(self, tick: int, goal: _Vector, start: tuple[_Vector, _Vector, _Vector] | None = None) -> int: "Moves the goal at a tick, rad or m: from the state there, or from one that is given (q, q̇,\nq̈), to rest at the goal. Returns the tick of the arrival.\n\nRaises MotionError of a goal that is not finite, or of an acceleration beyond its limit."
    def at(self, tick: int | Sequence[int] | _Result) -> tuple[_Result, _Result, _Result]: "q, q̇ and q̈, each (joints), in a tick, or (ticks, joints) in several."

@final
class PoseSolver:
    "A solver of inverse kinematics: positions of the joints for a pose of a body, in float64, by\nLevenberg-Marquardt from several starts.\n\nlower, upper: the ranges, rad or m, else those of the robot; length: at which a displacement\ncounts as much as a rotation, m, a third of the reach; tolerance: the greatest error, rad;\niterations: the most of all starts together."
    def __new__(
        cls,
        robot: Robot,
        body: _Body,
        lower: _Vector | None = None,
        upper: _Vector | None = None,
        length: float = 0.3,
        tolerance: float = 1e-9,
        iterations: int = 130,
    ) -> PoseSolver: ...
    def solve(self, rotation: _Rotation, position: _Vector, start: _Vector | None = None) -> _Result: "Positions (joints), rad or m, at which the body has the rotation (3, 3) and the position\n(3), m, of `Robot.poses`: from `start`, else from the middle of the ranges, and then from\nothers within the ranges\n\nRaises PoseNotReached, with the nearest positions, of a pose that is out of reach or nearly\nso, and MotionError of numbers that are not finite."
    def solutions(self, rotation: _Rotation, position: _Vector, starts: int = 200) -> _Result: "All different positions (solutions, joints) that the first so many seeds lead to; those that\ndiffer by whole turns are one. A UR5e has up to eight."

@final
class TipMotion:
    "The reference of an arm whose tip is moved by a twist that is new in each tick, within limits of\nposition, velocity and acceleration of the joints, as firmware has it, in float64.\n\nIt rests at q, rad or m, with ticks of `tick` seconds; velocity, lower and upper are those of\nthe robot if none are given. damping, s, is about the time in which the tip comes to the end of\nits reach; length, m, is a third of the reach; joints move towards the posture by posture_gain\nper distance, 1/s, as far as the tip leaves them free."
    def __new__(
        cls,
        robot: Robot,
        body: _Body,
        q: _Vector,
        tick: float,
        acceleration: _Vector,
        velocity: _Vector | None = None,
        lower: _Vector | None = None,
        upper: _Vector | None = None,
        damping: float = 0.01,
        length: float = 0.3,
        posture: _Vector | None = None,
        posture_gain: float = 0.0,
    ) -> TipMotion: ...
    @property
    def state(self) -> tuple[_Result, _Result, _Result]: "q, q̇ and q̈ of the reference, each (joints)."
    def step(self, twist: _Vector) -> tuple[Literal["follows", "slowed", "limited", "stops"], int | None]: "Advances the reference by a tick, in which the tip moves by the twist (6), rad/s and m/s, in\nthe base's axes. Returns \"follows\", \"slowed\", \"limited\" or, with a twist that is not finite,\n\"stops\", and the joint that slows or limits the tip, or None."
    def restart(self, start: tuple[_Vector, _Vector, _Vector]) -> None: "Begins again from a state (q, q̇, q̈) of the arm, after a fault or another motion.\n\nRaises MotionError of a state that is not finite."

@final
class SensorLoad:
    "The load of a force sensor and its offset: the mass, kg, its first moment about the sensor's\norigin and along its axes, kg·m, and the wrench that it shows without a load: couple, N·m, and\nforce, N. It computes in float64.\n\nWhile the arm moves, the sensor shows the offset and the wrench of a `Payload` of this mass and\ncentre, which `Robot.rnea_and_wrenches` has."
    def __new__(cls, mass: float, first_moment: _Vector, offset: _Vector) -> SensorLoad: ...
    @staticmethod
    def fit(gravity: _Array, wrench: _Array) -> SensorLoad: "Load and offset by least squares from poses at rest: gravity in the sensor's frame (…, 3),\nm/s², and what the sensor shows there (…, 6), couple and force, N·m and N.\n\nRaises SensorLoadError of poses from which no load follows, and of a sensor with the other\nsign or with other axes than those of gravity."
    @property
    def residual(self) -> list[float] | None: "The root mean squares of couple, N·m, and force, N, that a fit leaves over its poses, near\nthe sensor's noise; None of a load that was not fitted."
    @property
    def mass(self) -> float: "The mass, kg."
    @property
    def first_moment(self) -> list[float]: "Mass times centre of mass, kg·m."
    @property
    def offset(self) -> list[float]: "The wrench that the sensor shows without a load, N·m and N."
    def at_rest(self, gravity: _Array) -> _Result: "The wrench at rest (…, 6), N·m and N, of gravity in the sensor's frame (…, 3), m/s²: that\nof a contact is what it measures less this."

@final
class ThermalLimit:
    "Limits of torque that keep the windings of motors below their greatest temperature, as firmware\nhas them, in float64: the peak while a motor is cold, the continuous torque when it is as hot\nas it may be.\n\ntick, s; of each joint, from data sheets and behind the gear: the torque that may last and that\nof a cold motor, N·m or N, the time constants of winding and motor, s, the share of the thermal\nresistance from winding to housing in that to the ambient (1 for I²t alone), the greatest\ntemperature of the winding, °C; the greatest temperature of the ambient, °C; and `saved` of\nlimits so many seconds before, else the motors are as hot as they may be."
    def __new__(
        cls,
        tick: float,
        continuous: _Vector,
        peak: _Vector,
        winding_time: _Vector,
        housing_time: _Vector,
        share: _Vector,
        hottest: _Vector,
        ambient: float,
        saved: tuple[_Vector, _Vector] | None = None,
        off: float = 0.0,
    ) -> ThermalLimit: ...
    @property
    def torque(self) -> list[float]: "The greatest torques of the next tick, N·m or N."
    @property
    def celsius(self) -> list[float]: "The temperatures of the windings by the model, °C."
    @property
    def saved(self) -> tuple[list[float], list[float]]: "The temperatures of windings and housings to be saved, as shares of the greatest rise."
    @property
    def status(self) -> tuple[Literal["cool", "limited", "hot"], int | None]: "\"cool\", \"limited\" or \"hot\", and the hottest joint that is limited, or None."
    def update(self, torque: _Array) -> _Result: "Takes the torques that the drives have in a tick (n), N·m or N, or in one tick after the\nother (…, n), and returns the limits after each."
    def measured(self, joint: int, celsius: float) -> None: "A winding's temperature that its drive has measured, °C: it may raise that of the model."
    def holds_for(self, joint: int, torque: float) -> float: "How long a joint can hold a torque, N·m or N, before its limit is less, s; inf for ever."

@final
class LoopJoint:
    "A joint that closes a loop: its name, its kind, the two bodies by name or number, None being the\nbase, the frames on them, and its axis in these frames.\n\n``kind``: \"revolute\", \"prismatic\", \"cylindrical\", \"planar\", \"spherical\" or \"fixed\". ``xyz``, m,\nand ``rpy``, rad, are of the frames in those of the bodies; where the loop is closed, they\ndiffer by a motion of the joint."
    def __new__(
        cls,
        name: str,
        kind: Literal["revolute", "prismatic", "cylindrical", "planar", "spherical", "fixed"],
        bodies: Sequence[_Body | None],
        xyz: Sequence[_Vector] = ...,
        rpy: Sequence[_Vector] = ...,
        axis: _Vector = ...,
    ) -> LoopJoint: ...
    @property
    def name(self) -> str: "The name of the loop."

@final
class Loops:
    "A robot with kinematic loops, of any joints.\n\n``joints`` close the loops: those of the MJCF's ``connect`` and ``weld`` if none are given.\n``actuated`` has the velocity coordinates with a motor, or the names of their joints: those of\nthe file, or all, if none are given. Within ``damped_below`` of a dead point of the motors\ntorques are damped. Shapes: nl is the number of directions that the loops constrain, na that of\nactuated coordinates."
    def __new__(
        cls,
        robot: Robot,
        joints: Sequence[LoopJoint] | None = None,
        actuated: Sequence[_Coordinate] | None = None,
        damped_below: float | None = None,
    ) -> Loops: ...
    @property
    def names(self) -> list[str]: "The names of the loops."
    @property
    def actuated(self) -> list[int]: "The actuated coordinates, as indices in q̇."
    @property
    def nl(self) -> int: "The number of directions that the loops constrain."
    def assemble(self, q: _Array, moving: Literal["passive", "all"] = "passive") -> _Result: "q (…, nq) near a guess q (…, nq), rad and m, at which all loops are closed. ``moving``:\n\"passive\" coordinates, or \"all\".\n\nRaises LoopOpen with the loop that stays open."
    def constraints(self, q: _Array, qd: _Array) -> tuple[_Result, _Result, _Result, _Result]: "The constraints K q̈ = k at q (…, nq) and q̇ (…, nv): K (…, nl, nv), k (…, nl), rad/s² and\nm/s², and the errors of position, rad and m, and velocity K q̇, rad/s and m/s, each (…, nl).\nRows of a loop are those of rotations before those of translations, along the successor's\nframe."
    def coordinate_map(self, q: _Array) -> tuple[_Result, _Result]: "G (…, nv, na) with q̇ = G ẏ of the rates ẏ of the motors, at q (…, nq) of closed loops, and\nthe number of degrees of freedom (…). Columns of motors that are redundant are zero.\n\nRaises LoopOpen, and UnderActuated where a coordinate moves with all motors held."
    def mobility(self, q: _Array) -> tuple[_Result, _Result]: "The numbers of degrees of freedom at q (…, nq) of closed loops, and at configurations near\nby, each (…): they differ at a change point."
    def inverse_dynamics(self, q: _Array, yd: _Array, ydd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result, _Result, _Result]: "Inverse dynamics: the torques of the motors (…, na), N·m or N, q̇ and q̈ of all coordinates\n(…, nv), the forces λ of the loops (…, nl), N·m and N, and how many motors are redundant\n(…), −1 where they are near a dead point and torques are damped; for q (…, nq) of closed\nloops, and the rates and accelerations of the motors, (…, na).\n\nRaises LoopOpen, UnderActuated and NotFinite. Scenes have Inertia and Coriolis, and no\nfriction of gears."
    def forward_dynamics(self, q: _Array, qd: _Array, tau: _Array, effects: _Effects | None = None, stabilisation: _Vector = ...) -> tuple[_Result, _Result, _Result]: "Forward dynamics: q̈ (…, nv), rad/s² or m/s², the forces λ of the loops (…, nl), N·m and N,\nand the rank of K (…); for q (…, nq), q̇ (…, nv) and the torques of the motors (…, na), N·m\nor N. ``stabilisation``: of errors of position, 1/s², and of velocity, 1/s, K q̈ = k −\nvelocity K q̇ − position φ.\n\nRaises NotPositiveDefinite and NotFinite. Scenes have Inertia and Coriolis, and no friction\nof gears."

@final
class Linkage:
    "A linkage whose coordinates are a function of fewer independent ones, such as `FourBar(...)`."
    @property
    def driven(self) -> int: "The number of coordinates that it drives."
    @property
    def independent(self) -> int: "The number of independent ones."

def FourBar(ground: float, crank: float, coupler: float, rocker: float, positive: bool = True, zeros: _Vector = ...) -> Linkage: "A planar four-bar: the lengths, m, of ground, crank, coupler and rocker; the coordinates are\nthe angles of crank, coupler on the crank, and rocker. ``positive``: of the two ways to\nassemble it, that in which the coupler's joint on the rocker is to the left of the line from\nthe crank's end to the rocker's joint. ``zeros``, rad: the angle of each link at q = 0 from\nthe ground, and of the coupler from the crank."
def FiveBar(ground: float, first: _Vector, second: _Vector, positive: bool = True, zeros: _Vector = ...) -> Linkage: "A planar five-bar: the distance of the cranks, m, and the lengths of crank and rod of each;\nthe coordinates are the angles of crank, rod, other crank and other rod."
def Differential(ratios: _Vector) -> Linkage: "A differential of two motors: half the sum and half the difference of their angles, over the\ntwo ratios."
def Belt(coefficients: _Vector) -> Linkage: "A belt or gear: the driven angle as a polynomial of the driving one, up to 8 coefficients from\nthe constant on."
def ParallelAnkle(rods: Sequence[tuple[_Vector, _Vector, _Vector, float, bool]]) -> Linkage: "An ankle of pitch and roll that two cranks drive by rods. Each rod is given by the joint of\nits crank, the crank's end and the rod's end on the foot, m, its length, m, and whether its\nroot is positive."
def Delta(base: float, crank: float, rod: float, platform: float) -> Linkage: "A Delta robot: the radii of base and platform, and the lengths of cranks and rods, m."
def Stewart(legs: Sequence[tuple[_Vector, _Vector, float]]) -> Linkage: "A Stewart platform: of each leg its joints on base and platform, and its length at q = 0, m."
@final
class Linkages:
    "A robot with linkages: ``linkages`` has of each a name, the linkage, and the velocity\ncoordinates that it drives, or their joints, in the linkage's order.\n\ny has, in the order of the bodies, the coordinates in no linkage, and the independent ones of\neach linkage in the place of its first body. Shapes: py is the number of y, ny that of ẏ."
    def __new__(cls, robot: Robot, linkages: Sequence[tuple[str, Linkage, Sequence[_Coordinate]]]) -> Linkages: ...
    @property
    def names(self) -> list[str]: "The names of the linkages."
    @property
    def py(self) -> int: "The number of independent positions."
    @property
    def ny(self) -> int: "The number of independent velocities."
    def motion(self, y: _Array, yd: _Array, ydd: _Array) -> tuple[_Result, _Result, _Result, _Result, _Result]: "The motion of the tree: q (…, nq), q̇ and q̈ (…, nv), rad and m, G (…, nv, ny) with q̇ = G\nẏ, and whether a linkage is near a singularity, where G is damped, (…), 1 or 0; y (…, py), ẏ\nand ÿ (…, ny).\n\nRaises LinkageError with the linkage whose links do not reach each other."
    def rnea(self, y: _Array, yd: _Array, ydd: _Array, effects: _Effects | None = None) -> _Result: "Inverse dynamics: the torques at the independent coordinates (…, ny), N·m or N, for y (…,\npy), ẏ and ÿ (…, ny).\n\nRaises LinkageError. Scenes have Inertia and Coriolis, and no friction of gears."
    def forward_dynamics(self, y: _Array, yd: _Array, tau: _Array, effects: _Effects | None = None) -> _Result: "Forward dynamics: ÿ (…, ny), rad/s² or m/s², for y (…, py), ẏ and the torques at the\nindependent coordinates (…, ny), N·m or N.\n\nRaises LinkageError. Scenes have Inertia and Coriolis, and no friction of gears."

@final
class Mode:
    "One assumed mode of a link: a displacement φ(r) η of every point r, in the frame of the link's\njoint, with which it is clamped there.\n\n``momentum``: ∫ φ dm; ``moments``: ∫ φ rᵀ dm by rows of φ; ``shift`` and ``turn``: φ and the\nrotation ½ curl φ at the link's end. φ has no unit where η is in m, and m/rad where it is in\nrad; masses in kg."
    def __new__(cls, momentum: _Vector, moments: Sequence[_Vector], shift: _Vector, turn: _Vector) -> Mode: ...

@final
class FlexibleLink:
    "A link that bends: its body by name or number, its end in the frame of its joint, m, on which\nits children stand, up to 6 modes, and of each pair of modes the products ∫ φ φᵀ dm (n, n, 3,\n3), stiffness, N/m or N·m/rad, and damping, N·s/m or N·m·s/rad, each (n, n)."
    def __new__(
        cls,
        body: _Body,
        end: _Vector,
        modes: Sequence[Mode],
        products: Sequence[Sequence[Sequence[_Vector]]],
        stiffness: Sequence[_Vector],
        damping: Sequence[_Vector],
    ) -> FlexibleLink: ...

@final
class Beam:
    "A uniform beam along x: length, m, and mass per length, kg/m; bending stiffness in the planes of\ny and z and torsion stiffness, N·m²; the sections' second moments of mass, kg·m; a tip's mass,\nkg, and inertia, kg·m²; the damping ratio of its modes."
    def __new__(
        cls,
        length: float,
        mass_per_length: float,
        bending: _Vector = ...,
        torsion: float = 0.0,
        sections: _Vector = ...,
        tip: _Vector = ...,
        damping_ratio: float = 0.0,
    ) -> Beam: ...
    @property
    def mass(self) -> float: "The mass with its tip, kg: that of the robot's body."
    @property
    def com(self) -> list[float]: "The centre of mass from the joint, m."
    @property
    def inertia(self) -> list[float]: "Ixx, Ixy, Ixz, Iyy, Iyz, Izz about the centre of mass, kg·m²."
    def link(self, body: _Body, shapes: Sequence[tuple[str, int]]) -> FlexibleLink: "The link of a body with modes by their shapes, such as ``[(\"bend_z\", 1), (\"twist\", 1)]``:\n\"bend_y\", \"bend_z\" or \"twist\", counted from 1."

@final
class FlexibleRobot:
    "A robot of up to 16 coordinates with links that bend, of up to 8 modes in all. The links' stiffness and damping act in\nevery scene.\n\nShapes: nm is the number of modes, in the order of the bodies. η of a mode is in m or rad, as\nits shape is scaled."
    def __new__(cls, robot: Robot, links: Sequence[FlexibleLink]) -> FlexibleRobot: ...
    @property
    def nm(self) -> int: "The number of modes of the links."
    def rnea(self, q: _Array, qd: _Array, qdd: _Array, eta: _Array, etad: _Array, etadd: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "Inverse dynamics: the torques of the joints (…, nv), N·m or N, and the forces on the modes\n(…, nm), N or N·m, which are zero where the modes move freely; q (…, nq), q̇ and q̈ (…, nv),\nη, η̇ and η̈ (…, nm)."
    def crba(self, q: _Array, eta: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result]: "The inertia of joints and modes in blocks: of joints (…, nv, nv), between modes and joints\n(…, nm, nv), and of modes (…, nm, nm), kg, kg·m or kg·m²; q (…, nq), η (…, nm)."
    def frequencies(self, q: _Array, eta: _Array, effects: _Effects | None = None) -> _Result: "The natural frequencies of the modes with the joints clamped (…, nm), rad/s, in ascending\norder; q (…, nq), η (…, nm)."
    def forward_dynamics(self, q: _Array, qd: _Array, tau: _Array, eta: _Array, etad: _Array, effects: _Effects | None = None) -> tuple[_Result, _Result]: "Forward dynamics: q̈ (…, nv), rad/s² or m/s², and η̈ (…, nm), m/s² or rad/s², for q (…, nq),\nq̇ and τ (…, nv), η and η̇ (…, nm)."
    def modal_dynamics(self, q: _Array, qd: _Array, qdd: _Array, eta: _Array, etad: _Array, effects: _Effects | None = None) -> _Result: "η̈ (…, nm), m/s² or rad/s², along a motion of the joints, q (…, nq), q̇ and q̈ (…, nv),\nwhatever torques it takes; η and η̇ (…, nm)."
    def at_rest(self, q: _Array, effects: _Effects | None = None) -> _Result: "η (…, nm), m or rad, at rest under the scene's gravity at q (…, nq).\n\nRaises ModeError of a link that is too soft for its weight."
    def tick(self, q: _Array, qd: _Array, qdd: _Array, eta: _Array, etad: _Array, etadd: _Array, h: float, effects: _Effects | None = None) -> tuple[_Result, _Result, _Result, _Result]: "A tick of feed-forward of h seconds: the torques (…, nv), N·m or N, at which the joints'\nmotion is a reference, q (…, nq), q̇ and q̈ (…, nv), and η, η̇ and η̈ (…, nm) of the modes\nafter it, from those before."
