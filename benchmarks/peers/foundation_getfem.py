#!/usr/bin/python3
"""The beam that is bent onto a foundation (examples/foundation.toml) with GetFEM: plane elasticity on half of the beam,
contact by an augmented multiplier, and GetFEM's continuation for non-smooth equations.

    foundation_getfem.py ELEMENTS   along half of the beam; four over its height

Small displacements, which is what its contact bricks and continuation are made for together. The path ends at a moment of
1, where the examples' beam has touched long since.
"""

import sys
import time

import getfem
import numpy as np

HALF, HEIGHT, WIDTH, GAP = 1.0, 0.2, 0.2, 0.08  # [cm]
E, NU = 2.1e4, 0.29  # [kN/cm²]
LAST_MOMENT = 1.0  # [kN cm]
STIFF = 1e8  # of the penalties that hold supports
BOTTOM, END, MIDDLE = 1, 2, 3
MOST_STEPS = 400


def beam_mesh(along, across):
    mesh = getfem.Mesh("cartesian", np.linspace(0.0, HALF, along + 1), np.linspace(-HEIGHT / 2, HEIGHT / 2, across + 1))
    for region, direction in ((BOTTOM, [0.0, -1.0]), (END, [-1.0, 0.0]), (MIDDLE, [1.0, 0.0])):
        mesh.set_region(region, mesh.outer_faces_with_direction(direction, 0.01))
    return mesh


def beam_model(mesh):
    """The model and what it is made of, which must live as long."""
    displacement, pressure, obstacle = (getfem.MeshFem(mesh, q) for q in (2, 1, 1))
    displacement.set_fem(getfem.Fem("FEM_QK(2,2)"))
    for linear in (pressure, obstacle):
        linear.set_fem(getfem.Fem("FEM_QK(2,1)"))
    points = getfem.MeshIm(mesh, getfem.Integ("IM_GAUSS_PARALLELEPIPED(2,4)"))
    model = getfem.Model("real")
    model.add_fem_variable("u", displacement)
    model.add_filtered_fem_variable("p", pressure, BOTTOM)
    model.add_initialized_data("lambda_", [E * NU / (1.0 - NU * NU)])  # plane stress
    model.add_initialized_data("mu", [E / (2.0 * (1.0 + NU))])
    model.add_isotropic_linearized_elasticity_brick(points, "u", "lambda_", "mu")
    model.add_initialized_data("moment", [0.0])
    model.add_initialized_data("c", [12.0 / (WIDTH * HEIGHT**3)])
    model.add_nonlinear_term(points, "-moment*c*X(2)*Test_u(1)", END)
    model.add_nonlinear_term(points, f"{STIFF}*u(1)*Test_u(1)", MIDDLE)
    places = displacement.basic_dof_nodes()
    support = int(np.where((abs(places[0]) < 1e-9) & (abs(places[1]) < 1e-9))[0][1])
    held = getfem.Spmat("empty", 1, displacement.nbdof())
    held.add(0, support, 1.0)
    model.add_constraint_with_penalization("u", STIFF, held, [0.0])
    model.add_initialized_fem_data("gap", obstacle, obstacle.basic_dof_nodes()[1] + HEIGHT / 2 + GAP)
    model.add_initialized_data("r", [E])
    model.add_integral_contact_with_rigid_obstacle_brick(points, "u", "p", "gap", "r", BOTTOM, 1)
    return model, (mesh, displacement, pressure, obstacle, points, held)


def trace(model):
    path = getfem.ContStruct(model, "moment", 1.0 / model.nbdof(), "h_init", 0.02, "h_max", 0.5, "h_min", 1e-7,
                             "h_inc", 1.3, "h_dec", 0.5, "max_iter", 30, "thr_iter", 8, "max_res", 1e-7,
                             "max_diff", 1e-7, "min_cos", 0.9, "non-smooth", "singularities", 2)
    model.solve("max_res", 1e-9)
    x, moment, steps = model.from_variables(), 0.0, 0
    dx, dmoment, step = path.init_Moore_Penrose_continuation(x, moment, 1.0)
    while moment < LAST_MOMENT and steps < MOST_STEPS and step != 0:
        x, moment, dx, dmoment, step = path.Moore_Penrose_continuation(x, moment, dx, dmoment, step)[:5]
        steps += 1
    return steps, float(moment)


def main():
    elements = int(sys.argv[1])
    getfem.util_trace_level(0)
    getfem.util_warning_level(0)
    start = time.process_time()
    model, parts = beam_model(beam_mesh(elements, 4))
    steps, moment = trace(model)
    used = time.process_time() - start
    del model, parts
    for figure, unit, value in (("path", "s", used), ("points", "", steps), ("moment at the end", "kN cm", moment)):
        print(f"foundation,{elements},{figure},{unit},{value:.10g}")


if __name__ == "__main__":
    main()
