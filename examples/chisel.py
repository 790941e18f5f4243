"""A hammer hits a chisel that stands on a rock: three masses in a row, by an importer of FMI alone.

    pip install fmpy ./python
    python examples/chisel.py [PICTURE.svg]

The impacts of the hammer on the chisel and of the chisel on the rock overlap. One FMU moves all three
masses together: a single step over the whole blow has the result of many short ones.
"""

import fmpy
import judge
import numpy as np

MASSES, SPEED = np.array([1.0, 0.3, 30.0]), 3.0  # kg: hammer, chisel, rock; m/s
CONTACTS, END = ("head", "edge"), 2e-3  # s


def blow(path, step):
    """Times, speeds [m/s] of the masses and forces [N]; the depth of the pit in the rock [m], and
    the energy in the dents and in the masses over that of the hammer."""
    description = fmpy.read_model_description(path)
    named = {variable.name: variable.valueReference for variable in description.modelVariables}
    unit = fmpy.instantiate_fmu(fmpy.extract(path), description, fmi_type="CoSimulation")
    unit.setupExperiment(startTime=0.0)
    unit.enterInitializationMode()
    unit.exitInitializationMode()
    speeds, rows = np.array([SPEED, 0.0, 0.0]), []

    def read(name):
        return np.array(unit.getReal([named[f"{contact}.{name}"] for contact in CONTACTS]))

    for index in range(round(END / step)):
        # closing rates: each mass less the next one
        unit.setReal(
            [named[f"{contact}.indentation_rate"] for contact in CONTACTS], -np.diff(speeds)
        )
        unit.doStep(currentCommunicationPoint=index * step, communicationStepSize=step)
        forces = read("mean_force")
        # each contact pushes the mass before it back, and the one behind it on
        speeds -= step * np.diff([0.0, *forces, 0.0]) / MASSES
        rows.append((index * step + step, *speeds, *read("force")))
    held = read("elastic_energy").sum() + read("dissipated_energy").sum()
    kinetic = 0.5 * MASSES @ speeds**2
    pit = read("residual_indentation")[1]
    unit.terminate()
    unit.freeInstance()
    return np.array(rows).T, pit, (held + kinetic) / (0.5 * MASSES[0] * SPEED**2)


if __name__ == "__main__":
    path = judge.unit("chisel")
    one, pit, energy = blow(path, END)
    many, _, _ = blow(path, 2e-6)
    print(f"balance of energy: {abs(energy - 1.0):.1e} of the hammer's energy")
    short, deep = judge.blow("chisel", MASSES, [SPEED, 0.0, 0.0], END, 2e-8)
    judge.agree("speeds after one step against steps of 20 ns [m/s]", one[1:4, -1], short, 1e-5)
    judge.agree("pit in the rock against the same [m]", pit, deep, 1e-9)
    print(f"speeds {one[1:4, -1].round(4)} m/s, a pit of {1e6 * pit:.2f} um")
    judge.picture(
        "Hammer, chisel and rock: one step over the blow, and steps of 2 us",
        [
            (1e3 * many[0], many[1], "hammer", "-"),
            (1e3 * many[0], many[2], "chisel", "-"),
            (1e3 * many[0], 10.0 * many[3], "rock, times 10", "-"),
            (1e3 * one[0], one[1], "one step", "ko"),
            (1e3 * one[0], one[2], None, "ko"),
            (1e3 * one[0], 10.0 * one[3], None, "ko"),
        ],
        x="time [ms]",
        y="speed [m/s]",
    )
