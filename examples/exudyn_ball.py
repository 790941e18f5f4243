"""A ball falls onto a plate in Exudyn and bounces until it no longer yields, with an explicit and an implicit
integrator, in steps of a millisecond.

    pip install exudyn ./python
    python examples/exudyn_ball.py [PICTURE.svg]

The impulse is added to the velocity before the step. As a force, an implicit integrator would
spread it over two steps.
"""

import brinell
import exudyn
import exudyn.itemInterface as items
import judge
import numpy as np

MASS, HEIGHT, STEP, END, GRAVITY = 4e-3, 0.05, 1e-3, 0.6, 9.81  # kg, m, s, s, m/s^2
SOLVERS = {
    "explicit": exudyn.DynamicSolverType.RK44,
    "implicit": exudyn.DynamicSolverType.GeneralizedAlpha,
}


def ball():
    """A ball above the plate: the system, and the number of the node."""
    system = exudyn.SystemContainer().AddSystem()
    start = {"initialDisplacement": [0, 0, HEIGHT], "gravity": [0, 0, -GRAVITY]}
    ball = system.CreateMassPoint(mass=MASS, **start, returnDict=True)
    return system, ball["nodeNumber"]


def simulate(system, solver):
    """Runs the system to the end."""
    system.Assemble()
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = END
    settings.timeIntegration.numberOfSteps = round(END / STEP)
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = settings.show.statistics = False
    system.SolveDynamic(settings, solverType=solver)


def fall(path, solver):
    """Height and speed in the engine, with the FMU as the plate."""
    system, _ = ball()
    rows = []
    with brinell.Contact(path, initial_gap=HEIGHT) as contact:
        balance = judge.Balance(contact)

        def before_each_step(system, time):
            state = system.systemData
            place, speed = state.GetODE2Coordinates(), state.GetODE2Coordinates_t()
            if rows and rows[-1][3] > 0.0:
                # the engine cannot know when within the last step the ball turned
                place[2] = -contact["indentation"]
                state.SetODE2Coordinates(place)
            force = contact.step(STEP, -speed[2], GRAVITY)
            rows.append([time, place[2], speed[2], force])
            speed[2] += STEP * force / MASS
            balance.step(STEP, MASS, force, -rows[-1][2], -speed[2], GRAVITY)
            state.SetODE2Coordinates_t(speed)
            return True

        system.SetPreStepUserFunction(before_each_step)
        simulate(system, solver)
    balance.told()
    return np.array(rows).T


def soft():
    """Height with the engine's own contact: a spring with a damper, soft enough for steps of a
    millisecond."""
    system, number = ball()
    ground = system.AddNode(items.NodePointGround())
    ends = [
        system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
        for node in (ground, number)
    ]
    data = system.AddNode(
        items.NodeGenericData(initialCoordinates=[HEIGHT], numberOfDataCoordinates=1)
    )
    system.AddObject(
        items.ObjectContactCoordinate(
            markerNumbers=ends, nodeNumber=data, contactStiffness=400.0, contactDamping=0.6
        )
    )
    rows = []

    def before_each_step(system, time):
        rows.append([time, system.systemData.GetODE2Coordinates()[2]])
        return True

    system.SetPreStepUserFunction(before_each_step)
    simulate(system, exudyn.DynamicSolverType.GeneralizedAlpha)
    return np.array(rows).T


if __name__ == "__main__":
    path = judge.unit("ball")
    reference = judge.alone(path, HEIGHT, GRAVITY, MASS, END, STEP)
    lines = [(reference[0][::25], 1e3 * reference[1][::25], "the unit alone", ".")]
    for name, solver in SOLVERS.items():
        print(f"{name}:")
        time, height, speed, _ = fall(path, solver)
        count = len(time)
        judge.agree("speed, engine against the unit alone [m/s]", speed, reference[2][:count], 1e-9)
        judge.agree("height, engine against the unit alone [m]", height, reference[1][:count], 1e-6)
        lines.insert(0, (time, 1e3 * height, f"engine with the unit, {name}", "-"))
    own = soft()
    judge.second_flight(height, own[1])
    lines.append((own[0], 1e3 * own[1], "the engine's own contact", "--"))
    judge.picture("Exudyn: a steel ball bounces, 1 ms steps", lines)
