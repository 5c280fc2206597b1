"""Systems written after the examples of Exudyn's own repository, to try `solve_dynamic` on.

`EXAMPLES` has them by name; `examples_error.py` prints their errors, `tests/integrate` holds them.
"""

from functools import partial

import exudyn as exu

from exudyn_examples.example import Example
from exudyn_examples.flexible import ancf_cable, beam, cantilever, ffrf_pendulum
from exudyn_examples.other import (
    bouncing_ball,
    cradle,
    hydraulics,
    lugre,
    maxwell,
    regularized,
    stick_slip,
    watch,
)
from exudyn_examples.planar import (
    double_pendulum,
    driven_crank,
    four_bar,
    iftomm_pendulum,
    mass_points,
    slider_crank,
)
from exudyn_examples.spatial import (
    bricard,
    convex_roll,
    flyball_governor,
    four_bar_3d,
    heavy_top,
    kinematic_tree,
    rods_on_a_spring,
    rolling_disc,
    rotor,
    spring,
)

__all__ = ["EXAMPLES"]

ANGLES = {"node_type": exu.NodeType.RotationRxyz}


def sparse(settings):
    settings.linearSolver.solverType = exu.LinearSolverType.EigenSparse


def sharp(settings):
    """Contacts of Exudyn's own accept a newton of error, unless they are told better."""
    settings.timeIntegration.discontinuous.iterationTolerance = 1e-2


def soft(settings):
    """The barrel weighs a quarter of a newton."""
    settings.timeIntegration.discontinuous.iterationTolerance = 1e-4


def redundant(settings):
    """As Exudyn asks for it where constraints say the same twice."""
    settings.linearSolver.solverType = exu.LinearSolverType.EigenDense
    settings.linearSolver.ignoreSingularJacobian = True


EXAMPLES = {
    "slider-crank": Example(slider_crank, 2.0, 0.5, "Examples/SliderCrank.py"),
    "four-bar": Example(four_bar, 0.5, 0.3, "TestModels/fourBarMechanismTest.py"),
    "IFToMM pendulum": Example(iftomm_pendulum, 10.0, 2.0, "Examples/pendulumIftommBenchmark.py"),
    "double pendulum": Example(double_pendulum, 2.0, 1.0, "Examples/doublePendulum2D.py"),
    "mass points": Example(
        mass_points, 1.0, 1.0, "TestModels/coordinateVectorConstraintGenericODE2.py"
    ),
    "four-bar in space": Example(
        four_bar_3d, 2.0, 1.0, "Examples/fourBarMechanism3D.py", change=sparse
    ),
    "four-bar, redundant": Example(
        partial(four_bar_3d, redundant=True),
        2.0,
        1.0,
        # rounding decides which constraints are redundant: finer fixed steps become worse again
        "TestModels/fourBarMechanismRedundant.py",
        change=redundant,
        finest=1e-5,
        twin="four-bar in space",
    ),
    "Bricard": Example(bricard, 1.0, 1.0, "TestModels/bricardMechanism.py", change=redundant),
    "flyball governor": Example(flyball_governor, 2.0, 0.2, "TestModels/stiffFlyballGovernor.py"),
    "flyball, angles": Example(
        partial(flyball_governor, **ANGLES), 2.0, 0.2, "TestModels/stiffFlyballGovernor.py"
    ),
    "rotor run-up": Example(rotor, 10.0, 2.0, "Examples/rigidRotor3Drunup.py", most=12.0),
    "heavy top": Example(heavy_top, 0.5, 0.1, "TestModels/heavyTop.py"),
    "kinematic tree": Example(kinematic_tree, 1.0, 0.5, "Examples/kinematicTreeAndMBS.py"),
    "ten rods": Example(
        partial(rods_on_a_spring, count=10), 0.5, 0.2, "a chain in space, of 70 coordinates"
    ),
    "spring in Python": Example(
        partial(rods_on_a_spring, count=3, forces=spring), 0.5, 0.2, "its force is a user function"
    ),
    "rolling disc": Example(rolling_disc, 1.0, 0.5, "TestModels/createRollingDiscTest.py"),
    "convex roll": Example(
        # its dampers jerk it where it touches
        convex_roll,
        0.1,
        0.03,
        "TestModels/ConvexContactTest.py",
        change=soft,
        finest=1e-5,
        positions=True,
    ),
    "massless point": Example(maxwell, 2.0, 0.5, "a spring that ends at a damper"),
    "friction band": Example(regularized, 1.0, 0.5, "Examples/massSpringFrictionInteractive.py"),
    "bouncing ball": Example(
        # its contact does not converge to less than a hundredth of a newton
        bouncing_ball,
        0.5,
        0.2,
        "TestModels/contactCoordinateTest.py",
        change=sharp,
        finest=1e-5,
    ),
    "stick-slip": Example(
        # where sticking begins is known to a step only
        stick_slip,
        2.0,
        0.5,
        "TestModels/coordinateSpringDamperExt.py",
        finest=1e-3,
        most=20.0,
    ),
    "Newton's cradle": Example(
        cradle, 0.6, 0.4, "Examples/newtonsCradle.py", change=sparse, positions=True
    ),
    "driven crank": Example(driven_crank, 1.0, 0.5, "an offset as a function of time"),
    "ANCF cable": Example(ancf_cable, 1.0, 0.3, "Examples/flexiblePendulumANCF.py", change=sparse),
    "beam": Example(beam, 0.2, 0.1, "TestModels/geometricallyExactBeam2Dtest.py"),
    "cantilever": Example(
        # steps of microseconds round
        cantilever,
        0.1,
        0.02,
        "Examples/ANCFcantileverTestDyn.py",
        finest=1e-4,
    ),
    "FFRF pendulum": Example(ffrf_pendulum, 1.0, 0.2, "TestModels/objectFFRFreducedOrderTest.py"),
    "LuGre": Example(lugre, 10.0, 5.0, "Examples/lugreFrictionODE1.py"),
    "hydraulics": Example(hydraulics, 1.0, 0.1, "TestModels/hydraulicActuatorSimpleTest.py"),
    "balance wheel": Example(watch, 2.0, 0.5, "millimetres and milligrams"),
}
