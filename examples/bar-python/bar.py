"""Elastic waves in two bars welded together, by finite differences: a solver that knows nothing of assay.

The left end is moved by A (1 - cos(omega t)) until t1 and is free from then on; the right end is free. Masses at the
nodes, springs between them, central differences in time: second order in space and time where the solution is smooth.

    python3 bar.py N FILE [--broken impedance|boundary]

N cells per bar, of 1 m each; FILE gets displacement, velocity and stress at the centres of all cells at t = 0.3 ms, when
the pulse has met the weld and both its parts are on their way. --broken makes a mistake that can be made: a right bar
whose impedance is 1 % too high, or an end that is moved as at the beginning of a step instead of its end.
"""
import argparse
import math

LENGTH = 1.0  # m, of each bar
MODULUS = (79.1e9, 138.1e9)  # Pa
DENSITY = (2785.0, 8930.0)  # kg/m^3
AMPLITUDE, OMEGA, DRIVEN = 5e-5, 2 * math.pi / 2e-4, 1e-4  # m, rad/s, s
PERIODS_OF_DRIVING = 3  # the end time over DRIVEN
COURANT = 0.9


def motion(t):
    """Displacement of the left end [m] while it is driven."""
    return AMPLITUDE * (1 - math.cos(OMEGA * t))


def solve(n, broken):
    """Rows of X [m], u [m], v [m/s], P [Pa]; the time [s]; the size of a cell [m]."""
    h = LENGTH / n
    factor = 1.01 if broken == "impedance" else 1.0  # of both, so that waves are as fast as before
    modulus = [MODULUS[0]] * n + [MODULUS[1] * factor] * n
    density = [DENSITY[0]] * n + [DENSITY[1] * factor] * n
    mass = [(a + b) * h / 2 for a, b in zip([0.0] + density, density + [0.0])]  # half of either cell
    fastest = max(math.sqrt(E / rho) for E, rho in zip(MODULUS, DENSITY))
    driven_steps = math.ceil(DRIVEN * fastest / (COURANT * h))  # a whole number, so that the end is let go in time
    dt = DRIVEN / driven_steps
    steps = PERIODS_OF_DRIVING * driven_steps

    old, now = [0.0] * (2 * n + 1), [0.0] * (2 * n + 1)  # at rest
    for step in range(steps + 1):  # one beyond the end, for the velocity there
        stress = [E * (b - a) / h for E, a, b in zip(modulus, now, now[1:])]
        force = [b - a for a, b in zip([0.0] + stress, stress + [0.0])]  # nothing pulls at a free end
        new = [2 * u - u0 + dt * dt * f / m for u, u0, f, m in zip(now, old, force, mass)]
        if step < driven_steps:
            new[0] = motion((step if broken == "boundary" else step + 1) * dt)
        if step < steps:
            old, now = now, new
    velocity = [(b - a) / (2 * dt) for a, b in zip(old, new)]
    rows = [
        ((i + 0.5) * h, (now[i] + now[i + 1]) / 2, (velocity[i] + velocity[i + 1]) / 2, stress[i]) for i in range(2 * n)
    ]
    return rows, steps * dt, h


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("n", type=int, metavar="N")
    parser.add_argument("file", metavar="FILE")
    parser.add_argument("--broken", choices=("impedance", "boundary"))
    options = parser.parse_args()
    rows, time, h = solve(options.n, options.broken)
    with open(options.file, "w", encoding="ascii") as file:
        file.write(f"# time = {time:.17g} s\n# h = {h:.17g} m\nX[m],u_x[m],v_x[m/s],P_xx[Pa]\n")
        for row in rows:
            file.write(",".join(f"{value:.17g}" for value in row) + "\n")


if __name__ == "__main__":
    main()
