"""Three balls on top of each other fall onto a plate in Exudyn and come to rest, in steps of a
millisecond.

    pip install exudyn ./python
    python examples/exudyn_column.py [PICTURE.svg]

The balls touch each other, so that their impacts of 0.1 ms overlap. One FMU knows the masses and
moves all of them within a step. The engine gets the impulses, and how far they move the balls,
before its own step.
"""

import brinell
import exudyn
import exudyn.itemInterface as items
import judge
import numpy as np

MASS, HEIGHT, GRAVITY = 4e-3, 0.01, 9.81  # kg, m, m/s^2
STEP, FINE, END, COMPARED = 1e-3, 2e-5, 0.4, 0.1  # s
UP = slice(2, None, 3)  # the vertical coordinates


def column():
    """Three balls above the plate: the system, and the numbers of the nodes."""
    system = exudyn.SystemContainer().AddSystem()
    start = {"initialDisplacement": [0, 0, HEIGHT], "gravity": [0, 0, -GRAVITY]}
    balls = [system.CreateMassPoint(mass=MASS, **start, returnDict=True) for _ in range(3)]
    return system, [ball["nodeNumber"] for ball in balls]


def simulate(system, solver, step, end):
    """Runs the system to the end."""
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.endTime = end
    settings.timeIntegration.numberOfSteps = round(end / step)
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = settings.show.statistics = False
    system.SolveDynamic(settings, solverType=solver)


def fall(path, solver, step, end):
    """Times, and heights and speeds of the balls, zero where all touch; the forces at the end."""
    system, _ = column()
    system.Assemble()
    state, rows = system.systemData, []
    with brinell.Contact(path) as contact:
        balance = judge.Energy(
            lambda: (
                MASS
                * np.sum(
                    GRAVITY * state.GetODE2Coordinates()[UP]
                    + 0.5 * state.GetODE2Coordinates_t()[UP] ** 2
                )
            ),
            contact,
        )

        def before_each_step(system, time):
            balance.step()
            place, speed = state.GetODE2Coordinates(), state.GetODE2Coordinates_t()
            rows.append([time, *place[UP], *speed[UP]])
            # each ball closes on what is below it; gravity accelerates the lowest against the plate
            force = contact.step(step, -np.diff(speed[UP], prepend=0.0), [GRAVITY, 0.0, 0.0])
            # what is below a ball pushes it up, what is above pushes it down
            change = -step * np.diff(force, append=0.0) / MASS
            way = -np.diff(contact["impulse_moment"], append=0.0) / MASS
            speed[UP] += change
            place[UP] += way - step * change  # the engine adds a whole step at the new speed
            state.SetODE2Coordinates(place)
            state.SetODE2Coordinates_t(speed)
            return True

        system.SetPreStepUserFunction(before_each_step)
        simulate(system, solver, step, end)
        if step == STEP:
            balance.told("energy of the fall", 3.0 * MASS * GRAVITY * HEIGHT, 1e-12)
        return np.array(rows).T, contact["mean_force"]


def soft():
    """Times and heights with the engine's own contact: springs with dampers, soft enough for steps
    of a millisecond."""
    system, balls = column()
    ground = system.AddNode(items.NodePointGround())
    ends = [
        system.AddMarker(items.MarkerNodeCoordinate(nodeNumber=node, coordinate=2))
        for node in (ground, *balls)
    ]
    for index, gap in enumerate((HEIGHT, 0.0, 0.0)):
        data = system.AddNode(
            items.NodeGenericData(initialCoordinates=[gap], numberOfDataCoordinates=1)
        )
        system.AddObject(
            items.ObjectContactCoordinate(
                markerNumbers=ends[index : index + 2],
                nodeNumber=data,
                contactStiffness=400.0,
                contactDamping=0.6,
            )
        )
    rows = []

    def before_each_step(system, time):
        rows.append([time, *system.systemData.GetODE2Coordinates()[UP]])
        return True

    system.SetPreStepUserFunction(before_each_step)
    system.Assemble()
    simulate(system, exudyn.DynamicSolverType.GeneralizedAlpha, STEP, END)
    return np.array(rows).T


if __name__ == "__main__":
    path, weights = judge.unit("column"), MASS * GRAVITY * np.array([3.0, 2.0, 1.0])
    for name in ("RK44", "GeneralizedAlpha"):
        solver = getattr(exudyn.DynamicSolverType, name)
        print(f"{name}:")
        rows, forces = fall(path, solver, STEP, END)
        small, _ = fall(path, solver, FINE, COMPARED)
        until, every = round(COMPARED / STEP), round(STEP / FINE)
        place, same = rows[1:4, :until], small[:, ::every]
        judge.agree("heights against steps of 20 us, 0.1 s [m]", place, same[1:4], 1e-14)
        judge.agree("speeds against steps of 20 us, 0.1 s [m/s]", rows[4:, :until], same[4:], 5e-10)
        judge.agree("forces at rest against the weights [N]", forces, weights, 1e-13)
        judge.agree("speeds at rest [m/s]", rows[4:, -1], 0.0, 1e-14)
    own = soft()
    judge.picture(
        "Exudyn: three balls fall onto a plate, 1 ms steps",
        [
            (rows[0], 1e3 * rows[3], "upper ball", "-"),
            (rows[0], 1e3 * rows[2], "middle ball", "-"),
            (rows[0], 1e3 * rows[1], "lower ball", "-"),
            (same[0, ::3], 1e3 * same[3, ::3], "upper ball in steps of 20 us", "."),
            (own[0], 1e3 * own[3], "upper ball, the engine's own contact", "--"),
        ],
        y="height above the place of rest [mm]",
    )
