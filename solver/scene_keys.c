/* The keys every scene understands: one row each. */
#include "solver/scene_internal.h"
#include "solver/suggest.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define AT(field)  offsetof(struct solver_scene, field)
#define NEEDED     NULL
#define OPTIONAL   ""
#define ABOVE_ZERO DBL_MIN
#define FACE_KINDS                                                                                                     \
    "free, symmetric, skew-symmetric, clamped, { kind = \"traction\", value = f }, { kind = \"motion\", value = f, "   \
    "free_after = t, within = { lower, upper } } or { kind = \"roller\", value = f, traction = f }"
#define SURFACE_KINDS                                                                                                  \
    "free, clamped, { kind = \"traction\", value = f } or { kind = \"motion\", value = f, free_after = t }"
#define FORMULA "function(X, Y, Z, t) returning dim numbers"

/* clang-format off */
/* what it says, key, kind, offset, low, high, count, words, preset, expects, meaning */
#define KEYS(X)                                                                                                        \
X(REPORT, "title", TEXT, AT(title), 0, 0, 0, "", NEEDED, "text", "what the scene shows")                                       \
X(REPORT, "source", TEXT, AT(source), 0, 0, 0, "", OPTIONAL, "text", "paper and section the scene is taken from")              \
X(PROBLEM, "parameters", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "table of NAME = number", "numbers of the scene's own")          \
X(PROBLEM, "dim", INTEGER, AT(dim), 1, 3, 0, "", NEEDED, "1, 2 or 3", "space dimensions")                                       \
X(PROBLEM, "domain.shape", INDEX, AT(domain.kind), 0, 0, 0, "box disc ball cylinder solid stl", "box",                                              \
  "one of box, disc, ball, cylinder, solid, stl",                                                                          \
  "disc in 2D, ball and cylinder along Z in 3D; solid of any shape by its distance, or by a file of triangles")                                                                       \
X(PROBLEM, "domain.lower", NUMBERS, AT(lower), 0, 0, 0, "", OPTIONAL, "list of dim numbers [m]", "lower corner of the box, or of that around a solid")       \
X(PROBLEM, "domain.upper", NUMBERS, AT(upper), 0, 0, 0, "", OPTIONAL, "list of dim numbers [m]", "upper corner of the box, or of that around a solid")       \
X(PROBLEM, "domain.centre", NUMBERS, AT(domain.centre), 0, 0, 0, "", OPTIONAL, "list of dim numbers [m]", "of a round domain")     \
X(PROBLEM, "domain.radius", NUMBER, AT(domain.outer), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0 [m]", "of a round domain")  \
X(PROBLEM, "domain.length", NUMBER, AT(domain.length), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0 [m]", "of a cylinder")     \
X(PROBLEM, "domain.distance", FORMULA, SOLVER_DISTANCE, 0, 0, 0, "", OPTIONAL, "function(X, Y, Z) returning one number [m]",       \
  "distance from the surface of a solid, negative inside; where it is so on a side of the box, that is a face")          \
X(PROBLEM, "domain.file", TEXT, AT(domain_file), 0, 0, SOLVER_TEXT, "", OPTIONAL, "path, relative to the scene's folder",           \
  "closed surface of triangles, a binary or ASCII STL file")                                                            \
X(PROBLEM, "domain.scale", NUMBER, AT(domain_scale), ABOVE_ZERO, DBL_MAX, 0, "", "1", "number > 0 [m]", "of the lengths in that file") \
X(PROBLEM, "domain.symmetry", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ X = place, ... }",                      \
  "planes of symmetry [m], through the centre of a round domain: the part above is modelled, X0, Y0 or Z0 symmetric")                  \
X(PROBLEM, "bodies", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL,                                                                       \
  "list of up to 16 { shape = \"box\", lower = { ... }, upper = { ... } } or { shape = \"ring\", centre = {x, y}, inner = r, outer = R }", \
  "several bodies, in place of domain")                                                                                \
X(METHOD, "lattice", INDEX, AT(lattice), 0, 0, 0, "nodes centres", "nodes", "one of nodes, centres",                           \
  "particles on the corners of cells, so on faces, or in the centres of cells")                                        \
X(METHOD, "wall", INTEGER, AT(wall), 1, 16, 0, "", "3", "whole number in [1, 16]",                                             \
  "layers of particles beyond a face that is clamped or moved, where lattice = \"centres\"")                           \
X(METHOD, "wall_motion", INDEX, AT(wall_motion), 0, 0, 0, "rigid mirrored", "rigid", "one of rigid, mirrored",                  \
  "particles of walls move as the face, or against those of the body, so that the face has its velocity")             \
X(PROBLEM, "reference_length", NUMBER, AT(reference_length), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0 [m]",            \
  "spacing = reference_length / n; default: the first edge, or the radius")                                                           \
X(METHOD, "n", RESOLUTION, AT(n), 0, 0, 0, "", NEEDED, "whole number >= 1", "spacings along the reference length")             \
X(REPORT, "levels", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "list of up to 16 increasing whole numbers >= 1",                    \
  "values of n for a convergence study; default: n alone")                                                             \
X(METHOD, "grading.X", NUMBER, AT(grading[0].ratio), 1, 1e6, 0, "", "1", "number in [1, 1e6]",                              \
  "largest spacing along X over the smallest, each the same multiple of the last; for boxes on sbp2 or sbp4")      \
X(METHOD, "grading.fine_X", INDEX, AT(grading[0].fine), 0, 0, 0, "lower upper both middle", "lower",                           \
  "one of lower, upper, both, middle", "where spacings along X are smallest: at a face, at both, or half-way")          \
X(METHOD, "grading.Y", NUMBER, AT(grading[1].ratio), 1, 1e6, 0, "", "1", "number in [1, 1e6]",                              \
  "largest spacing along Y over the smallest, each the same multiple of the last; for boxes on sbp2 or sbp4")      \
X(METHOD, "grading.fine_Y", INDEX, AT(grading[1].fine), 0, 0, 0, "lower upper both middle", "lower",                           \
  "one of lower, upper, both, middle", "where spacings along Y are smallest: at a face, at both, or half-way")          \
X(METHOD, "grading.Z", NUMBER, AT(grading[2].ratio), 1, 1e6, 0, "", "1", "number in [1, 1e6]",                              \
  "largest spacing along Z over the smallest, each the same multiple of the last; for boxes on sbp2 or sbp4")      \
X(METHOD, "grading.fine_Z", INDEX, AT(grading[2].fine), 0, 0, 0, "lower upper both middle", "lower",                           \
  "one of lower, upper, both, middle", "where spacings along Z are smallest: at a face, at both, or half-way")          \
X(METHOD, "perturb", NUMBER, AT(perturb), 0, 0.45, 0, "", "0", "number in [0, 0.45]",                                            \
  "random shift of interior particles, as a fraction of the spacing")                                                  \
X(METHOD, "seed", SEED, AT(seed), 0, 0, 0, "", "1", "whole number >= 0", "of the random shift")                                \
X(PROBLEM, "material.model", WORD, AT(material_model), 0, 0, 0, "linear-elastic neo-hookean neo-hookean-polyconvex hencky", NEEDED,                    \
  "one of linear-elastic, neo-hookean, neo-hookean-polyconvex, hencky", "constitutive model")                          \
X(PROBLEM, "material.E", NUMBER, AT(E), ABOVE_ZERO, DBL_MAX, 0, "", NEEDED, "number > 0 [Pa]", "Young's modulus")               \
X(PROBLEM, "material.nu", NUMBER, AT(nu), -1 + DBL_EPSILON / 2, 0.5, 0, "", NEEDED, "number in (-1, 0.5]", "Poisson's ratio")   \
X(PROBLEM, "material.rho", NUMBER, AT(rho), ABOVE_ZERO, DBL_MAX, 0, "", NEEDED, "number > 0 [kg/m^3]",                          \
  "density in the reference configuration")                                                                            \
X(PROBLEM, "material.at", FORMULA, SOLVER_MATERIAL_AT, 0, 0, 0, "", OPTIONAL, "function(X, Y, Z) returning E, nu, rho",            \
  "constants of a composite body; they count in place of material.E, nu and rho, which are given all the same")        \
X(PROBLEM, "material.yield_stress", NUMBER, AT(hardening.yield), 0, DBL_MAX, 0, "", "0", "number >= 0 [Pa]",                      \
  "yield stress (von Mises) of the virgin material; 0: it is elastic")                                                 \
X(PROBLEM, "material.law", INDEX, AT(hardening.law), 0, 0, 0, "linear saturation power", "linear",                              \
  "one of linear, saturation, power",                                                                                  \
  "yield stress over plastic strain e: Y + H e, that + (Ys - Y)(1 - exp(-d e)), or Y (1 + e/e0)^m")                    \
X(PROBLEM, "material.hardening", NUMBER, AT(hardening.modulus), 0, DBL_MAX, 0, "", "0", "number >= 0 [Pa]",                      \
  "H: rise of the yield stress per plastic strain")                                                                    \
X(PROBLEM, "material.saturation", NUMBER, AT(hardening.saturation), 0, DBL_MAX, 0, "", "0", "number >= yield_stress [Pa] with saturation, else 0",\
  "Ys: the yield stress, without H e, that a law of saturation ends at")                                               \
X(PROBLEM, "material.saturation_rate", NUMBER, AT(hardening.rate), 0, DBL_MAX, 0, "", "0", "number > 0 with saturation, else 0",\
  "d: how fast it gets there")                                                                                         \
X(PROBLEM, "material.hardening_strain", NUMBER, AT(hardening.strain), 0, DBL_MAX, 0, "", "0", "number > 0 with power, else 0",  \
  "e0 of the power law")                                                                                               \
X(PROBLEM, "material.hardening_exponent", NUMBER, AT(hardening.exponent), 0, 1, 0, "", "0", "number in (0, 1] with power, else 0",\
  "m of the power law")                                                                                                \
X(METHOD, "scheme", WORD, AT(scheme), 0, 0, 0, "upwind jst ulsph | efg adaptle", "upwind", "one of upwind, jst, ulsph",                    \
  "semi-discrete right-hand side")                                                                                     \
X(METHOD, "evolved", INDEX, AT(evolved), 0, 0, 0, "pF pFJ pFHJ", "pFHJ", "one of pF, pFJ, pFHJ",                               \
  "geometric measures with an equation of their own")                                                                  \
X(METHOD, "stencil", WORD, AT(stencil), 0, 0, 0, "sph closed sbp2 sbp4", "sbp4", "one of sph, closed, sbp2, sbp4",             \
  "how discrete gradients are built")                                                                                  \
X(METHOD, "support", NUMBER, AT(support), 1, 4, 0, "", "2", "number in [1, 4]", "support radius / spacing")                    \
X(METHOD, "reconstruction", WORD, AT(reconstruction), 0, 0, 0, "stencil least-squares lattice none", OPTIONAL,                 \
  "one of stencil, least-squares, lattice, none",                                                                                \
  "slopes of the linear reconstruction at the Riemann states, and of what jst corrects its Laplacian by; default: "    \
  "stencil, but for upwind with closed between particles that were moved, by perturb or onto the surface of a solid or " \
  "an stl, least-squares, and along lines of sbp4 "   \
  "that are graded, or of sbp2 and sbp4 where materials meet, lattice: in the lattice's own coordinate, whose steps "    \
  "are even, and within one material")                            \
X(METHOD, "volume_flux", WORD, AT(volume_flux), 0, 0, 0, "pressure stress", "pressure", "one of pressure, stress",               \
  "jump that drives the upwind dissipation of J: the volumetric stress, or the whole stress as printed")               \
X(METHOD, "angular_momentum", WORD, AT(angular_momentum), 0, 0, 0, "free projected", "free", "one of free, projected",           \
  "as the scheme leaves it, or kept by the least change of the forces within the body (Appendix B)")                   \
X(METHOD, "incompressible.solver", INDEX, AT(incompressible.solver), 0, 0, 0, "none poisson pseudo-time", "none",               \
  "one of none, poisson, pseudo-time",                                                                                 \
  "pressure in place of J, for material.nu up to 0.5: by conjugate gradients, or by iteration in pseudo-time as printed") \
X(METHOD, "incompressible.tolerance", NUMBER, AT(incompressible.tolerance), 1e-14, 1e-2, 0, "", "1e-8",                        \
  "number in [1e-14, 0.01]", "share of a particle's volume that a stage's pressure may leave unbalanced")              \
X(METHOD, "incompressible.iterations", INTEGER, AT(incompressible.iterations), 1, 1000000, 0, "", "10000",                     \
  "whole number in [1, 1000000]", "most iterations per stage; more are an error")                                      \
X(METHOD, "incompressible.modulus", NUMBER, AT(incompressible.modulus), 0.1, 1e4, 0, "", "5", "number in [0.1, 1e4]",          \
  "fictitious bulk modulus of the predictor over the shear modulus: it gives the time step")                           \
X(METHOD, "incompressible.dissipation", NUMBER, AT(incompressible.dissipation), 0, 1, 0, "", "0.003", "number in [0, 1]",          \
  "of the jumps of the pressure, over that of the flux as printed: it changes volumes; 0: none")                       \
X(METHOD, "incompressible.restore", NUMBER, AT(incompressible.restore), 0, 1, 0, "", "0.1", "number in [0, 1]",                  \
  "share of the volume that a particle has strayed from its pressure's which is given back within a step; 0: as printed") \
X(METHOD, "incompressible.gamma", NUMBER, AT(incompressible.gamma), 1e-3, 1e3, 0, "", "1", "number in [0.001, 1000]",          \
  "artificial compressibility of the pseudo-time over the fictitious bulk modulus")                                    \
X(METHOD, "incompressible.alpha", NUMBER, AT(incompressible.alpha), 0, 1, 0, "", "0", "number in [0, 1]",                      \
  "Laplacian that speeds the pseudo-time up; it smooths the pressure, and changes volumes; 0: none")                   \
X(METHOD, "jst.kappa2", NUMBER, AT(jst.kappa2), 0, 10, 0, "", "0", "number in [0, 10]", "harmonic dissipation; 0: none")          \
X(METHOD, "jst.kappa4", NUMBER, AT(jst.kappa4), 0, 10, 0, "", "0.015625", "number in [0, 10]", "biharmonic dissipation; 0: none")    \
X(METHOD, "jst.kappa4_plastic", NUMBER, AT(jst.kappa4_plastic), 0, 10, 0, "", OPTIONAL, "number in [0, 10]",                     \
  "what kappa4 changes to, linearly, while a particle's plastic strain grows to plastic_at; default: it is constant")  \
X(METHOD, "jst.plastic_at", NUMBER, AT(jst.plastic_at), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0",                    \
  "plastic strain from which on kappa4 is kappa4_plastic; default 0.5")                                                \
X(METHOD, "ulsph.gradient", INDEX, AT(ulsph.gradient), 0, 0, 0, "corrected plain", "corrected", "one of corrected, plain",       \
  "gradients with the corrective matrix L, or of the kernel alone")                                                    \
X(METHOD, "ulsph.cells", INDEX, AT(ulsph.cells), 0, 0, 0, "whole cut", "whole", "one of whole, cut",                             \
  "weight in kernel sums of a particle on a face: a whole cell, or its part within the body")                          \
X(METHOD, "ulsph.dissipation", INDEX, AT(ulsph.dissipation), 0, 0, 0, "riemann viscosity none", "riemann",                     \
  "one of riemann, viscosity, none", "second-order Riemann term (R) or artificial viscosity (AV)")                     \
X(METHOD, "ulsph.viscosity", NUMBER, AT(ulsph.viscosity), 0, 10, 0, "", "1", "number in [0, 10]",                              \
  "alpha of the artificial viscosity")                                                                                 \
X(METHOD, "ulsph.tension", INDEX, AT(ulsph.tension), 0, 0, 0, "control stress none", "control",                                \
  "one of control, stress, none", "tensile instability control (TIC) or artificial stress (AS)")                       \
X(METHOD, "ulsph.repulsion", INDEX, AT(ulsph.repulsion), 0, 0, 0, "printed excess", "printed", "one of printed, excess",       \
  "the artificial stress as printed, or what of it exceeds its value at the initial spacing")                          \
X(METHOD, "ulsph.stress_factor", NUMBER, AT(ulsph.stress_factor), 0, 10, 0, "", "0.15", "number in [0, 10]",                   \
  "epsilon of the artificial stress")                                                                                  \
X(METHOD, "ulsph.stress_exponent", NUMBER, AT(ulsph.stress_exponent), 0, 32, 0, "", "8", "number in [0, 32]",                  \
  "exponent n of the artificial stress")                                                                               \
X(METHOD, "ulsph.xsph", NUMBER, AT(ulsph.xsph), 0, 1, 0, "", "0.5", "number in [0, 1]",                                        \
  "smoothing of the velocity that carries particles; 0: none")                                                         \
X(METHOD, "ulsph.delta", NUMBER, AT(ulsph.delta), 0, 1, 0, "", "0.002", "number in [0, 1]", "density diffusion; 0: none")      \
X(PROBLEM, "contact.law", INDEX, AT(contact_law), 0, 0, 0, "none printed predicted", "none",                                  \
  "one of none, printed, predicted",                                                                                   \
  "forces between bodies that stop the approach of particles: the present one, or that at the end of the step")        \
X(PROBLEM, "contact.distance", NUMBER, AT(contact_distance), 0, DBL_MAX, 0, "", "0", "number >= 0 [m]",                         \
  "between particles in touch; 0: the spacing")                                                                        \
X(PROBLEM, "rigid_wall.point", NUMBERS, AT(rigid_wall.point), 0, 0, 0, "", OPTIONAL, "list of dim numbers [m]",                 \
  "on a plane wall without friction, which the body does not pass")                                                    \
X(PROBLEM, "rigid_wall.normal", NUMBERS, AT(rigid_wall.normal), 0, 0, 0, "", OPTIONAL, "list of dim numbers",                   \
  "of that wall, from it to the body")                                                                                 \
X(PROBLEM, "die", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL,                                                                          \
  "list of up to 4 { path = { {x, y}, ... }, fillets = { r, ... } } [m]",                                              \
  "rigid walls without friction in the plane, each a path with the body to its left; one fillet for each corner")      \
X(METHOD, "integrator", WORD, AT(integrator), 0, 0, 0, "euler tvd-rk2 ssp-rk3 rk4", "rk4",                     \
  "one of euler, tvd-rk2, ssp-rk3, rk4",                                                                               \
  "time integrator")                                                                                                   \
X(METHOD, "cfl", NUMBER, AT(cfl), ABOVE_ZERO, 10, 0, "", "0.8", "number in (0, 10]", "Courant-Friedrichs-Lewy number")         \
X(PROBLEM, "t_end", NUMBER, AT(t_end), ABOVE_ZERO, DBL_MAX, 0, "", NEEDED, "number > 0 [s]", "end of the run")                  \
X(REPORT, "golden.t_end", NUMBER, AT(golden_t_end), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0 [s]",                    \
  "end of the run whose record and picture are stored, at the coarsest of levels; default t_end")                      \
X(REPORT, "snapshots", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "list of up to 16 increasing numbers in (0, t_end] [s]",          \
  "times at which a study compares the state with the oracle, besides t_end")                                          \
X(REPORT, "history", INTEGER, AT(history), 1, 100000, 0, "", "200", "whole number in [1, 100000]",                             \
  "rows of the time history over t_end, if there are as many steps")                                                   \
X(REPORT, "balance", FLAG, AT(balance), 0, 0, 0, "", "false", "true or false",                                                 \
  "the energy that numerical dissipation and a rigid wall take is measured, and a column of the history")              \
X(METHOD, "precision", WORD, AT(precision), 0, 0, 0, "double mixed single", "double", "one of double, mixed, single",                    \
  "mixed keeps pair vectors in single precision, and sums in double; single all fields, and sums of pairs (upwind)")  \
X(REPORT, "threads", INTEGER, AT(threads), 0, 1024, 0, "", "0", "whole number in [0, 1024]",                                   \
  "threads; 0: as many as there are cores, or OMP_NUM_THREADS allows, and the work is worth")                                                     \
X(PROBLEM, "initial.from", WORD, AT(initial_from), 0, 0, 0, "formulas oracle", "formulas", "one of formulas, oracle",             \
  "whether formulas or the exact solution give the initial state")                                                     \
X(PROBLEM, "loads.from", WORD, AT(loads_from), 0, 0, 0, "formulas oracle", "formulas", "one of formulas, oracle",                 \
  "whether formulas or the exact solution give the body force, and what faces prescribe")                              \
X(PROBLEM, "initial.displacement", FORMULA, SOLVER_INITIAL_DISPLACEMENT, 0, 0, 0, "", OPTIONAL, FORMULA,                        \
  "initial displacement [m]; default 0")                                                                               \
X(PROBLEM, "initial.velocity", FORMULA, SOLVER_INITIAL_VELOCITY, 0, 0, 0, "", OPTIONAL, FORMULA,                                \
  "initial velocity [m/s]; default 0")                                                                                 \
X(PROBLEM, "initial.F", FORMULA, SOLVER_INITIAL_F, 0, 0, 0, "", OPTIONAL,                                                       \
  "function(X, Y, Z, t) returning dim * dim numbers, row by row",                                                      \
  "initial deformation gradient; default: the stencil's gradient of the initial position")                             \
X(PROBLEM, "body_force", FORMULA, SOLVER_BODY_FORCE, 0, 0, 0, "", OPTIONAL, FORMULA,                                            \
  "force per unit reference volume [N/m^3]")                                                                           \
X(PROBLEM, "faces.X0", FACE, 0, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the lower X face; default free")               \
X(PROBLEM, "faces.X1", FACE, 1, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the upper X face; default free")               \
X(PROBLEM, "faces.Y0", FACE, 2, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the lower Y face; default free")               \
X(PROBLEM, "faces.Y1", FACE, 3, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the upper Y face; default free")               \
X(PROBLEM, "faces.Z0", FACE, 4, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the lower Z face; default free")               \
X(PROBLEM, "faces.Z1", FACE, 5, 0, 0, 0, "", OPTIONAL, FACE_KINDS, "condition on the upper Z face; default free")               \
X(PROBLEM, "faces.surface", FACE, 6, 0, 0, 0, "", OPTIONAL, SURFACE_KINDS, "condition on a round domain's curved face; default free") \
X(REPORT, "probes", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "list of up to 16 { name = text, X = { ... } }",                     \
  "places whose motion is recorded over time")                                                                         \
X(REPORT, "probe_scale", NUMBER, AT(probe_scale), ABOVE_ZERO, DBL_MAX, 0, "", OPTIONAL, "number > 0 [m]",                      \
  "what the error probes_nrmse is relative to")                                                                        \
X(REPORT, "figures", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ [NAME] = { measure = text, OPTION = ..., ... }, ... }",          \
  "numbers that a study measures and compares with those of the oracle; see assay list measures")                      \
X(REPORT, "oracle", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ name = text }; any number beside it is told to the oracle",       \
  "exact solution that the scene answers to")                                                                          \
X(REPORT, "published", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ source = text, { n = ..., NAME = error, ... }, ... }",         \
  "the figures printed in the paper")                                                                                  \
X(REPORT, "gates", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "list of up to 32 { when = { KEY = value, ... }, NAME = bound, ... }",\
  "largest errors and, as [\"rate NAME\"], smallest observed orders; [\"figure NAME\"] for those of figures, [\"indicator NAME\"]")                                                  \
X(REPORT, "beside", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ KEY = value, ... }",                                              \
  "another configuration of the same scene, whose probes a study shows and compares with this one's")                   \
X(REPORT, "trade", STRUCTURED, 0, 0, 0, 0, "", OPTIONAL, "{ [NAME] = { KEY = value, ... }, ... }",                                  \
  "other ways to set the same problem up, less of it by symmetry for instance, which assay trade varies")              \
X(REPORT, "view.field", TEXT, AT(view.field), 0, 0, SOLVER_NAME, "", "pressure", "name of a scalar of the record",                 \
  "what the picture shows")                                                                                            \
X(REPORT, "view.range", NUMBERS, AT(view.range), 0, 0, 2, "", OPTIONAL, "list of 2 numbers, increasing",                     \
  "colour range; default: what there is, to round numbers")                                                            \
X(REPORT, "view.bands", INTEGER, AT(view.bands), 2, 64, 0, "", OPTIONAL, "whole number in [2, 64]",                          \
  "filled contour bands; default: 8 to 16, so that they end at round numbers")                                         \
X(REPORT, "view.direction", NUMBERS, AT(view.direction), 0, 0, 3, "", "{1,0.8,0.6}", "list of 3 numbers",                      \
  "from the body towards the eye; default {1, 0.8, 0.6}, in a plane {0, 0, 1}")                                                                                     \
X(REPORT, "view.up", NUMBERS, AT(view.up), 0, 0, 3, "", "{0,0,1}", "list of 3 numbers", "what points up in the picture; default {0, 0, 1}, in a plane {0, 1, 0}")       \
X(REPORT, "view.magnify", NUMBER, AT(view.magnify), 0, DBL_MAX, 0, "", "1", "number >= 0",                                     \
  "displacement shown / displacement")                                                                                 \
X(REPORT, "view.size", INTEGERS, AT(view.size), 64, 8192, 2, "", "{1200,900}", "list of 2 whole numbers in [64, 8192]",        \
  "pixels")                                                                                                            \
X(REPORT, "view.frame", NUMBERS, AT(view.frame), 0, 0, 6, "", OPTIONAL, "{x0, x1, y0, y1, z0, z1} [m]",                        \
  "what must stay in sight; default: the body as it was, with room around it")
/* clang-format on */

#define SAY(says, key, kind, offset, low, high, count, words, preset, expects, meaning)                                \
    {key, expects, meaning, preset, SOLVER_KEY_##says},
#define RULE(says, key, kind, offset, low, high, count, words, preset, expects, meaning)                               \
    {SCENE_##kind, offset, low, high, count, words, preset},
static const struct solver_scene_key keys[] = {KEYS(SAY){NULL, NULL, NULL, NULL, SOLVER_KEY_PROBLEM}};
static const struct scene_key rules[] = {KEYS(RULE)};

const struct solver_scene_key *solver_scene_keys(void)
{
    return keys;
}

int scene_key_find(const char *path)
{
    for (int i = 0; keys[i].key; i++)
        if (!strcmp(keys[i].key, path))
            return i;
    return -1;
}

enum solver_key_says solver_scene_key_says(const char *path, size_t length)
{
    while (length > 0) { /* "faces.X0.kind", then "faces.X0" */
        for (int i = 0; keys[i].key; i++)
            if (strlen(keys[i].key) == length && !strncmp(keys[i].key, path, length))
                return keys[i].says;
        while (length > 0 && path[length - 1] != '.')
            length--;
        length -= length > 0; /* the dot */
    }
    return SOLVER_KEY_PROBLEM; /* of a parameter of the scene */
}

const struct scene_key *scene_key_rule(int index)
{
    return &rules[index];
}

bool scene_key_is_root(const char *name)
{
    size_t length = strlen(name);
    if (length == 0 || strchr(name, '.'))
        return false;
    for (int i = 0; keys[i].key; i++)
        if (!strncmp(keys[i].key, name, length) && (keys[i].key[length] == '.' || keys[i].key[length] == '\0'))
            return true;
    return false;
}

bool scene_key_admits(const char *path)
{
    size_t length = strlen(path);
    if (scene_key_find(path) >= 0 || scene_key_is_root(path))
        return true;
    if (!strncmp(path, "oracle.", 7) || !strncmp(path, "parameters.", 11))
        return path[length - 1] != '.' && !strstr(path, "..");
    char face[SOLVER_NAME];
    if (strncmp(path, "faces.", 6) != 0 || length < 6 || length >= sizeof face ||
        strcmp(path + length - 5, ".kind") != 0)
        return false;
    snprintf(face, sizeof face, "%.*s", (int)(length - 5), path);
    return scene_key_find(face) >= 0;
}

/* "; there are material.model, material.E, ..." of a path whose group has keys; "" else. */
static void list_group(const char *path, char *out, size_t size)
{
    size_t group = strcspn(path, "."), used = 0;
    out[0] = '\0';
    for (int i = 0; keys[i].key && path[group] && used < size; i++)
        if (!strncmp(keys[i].key, path, group + 1))
            used += (size_t)snprintf(out + used, size - used, "%s%s", used ? ", " : "; there are ", keys[i].key);
}

/* The key that is called so within its group, "material.nu" for "nu"; NULL if there is none. */
static const char *find_within(const char *name)
{
    for (int i = 0; keys[i].key; i++) {
        const char *dot = strchr(keys[i].key, '.');
        if (dot && !strcmp(dot + 1, name))
            return keys[i].key;
    }
    return NULL;
}

void scene_key_suggest(const char *path, char *out, size_t size)
{
    const char *best = find_within(path), *dot = strchr(path, '.');
    size_t group = dot ? (size_t)(dot - path) + 1 : 0, shown = best ? strlen(best) : 0;
    bool grouped = false;
    for (int i = 0; keys[i].key; i++)
        grouped = grouped || (group && !strncmp(keys[i].key, path, group));
    struct solver_suggestion nearest = solver_suggest_begin(grouped ? path + group : path);
    for (int i = 0; keys[i].key && !find_within(path); i++) {
        const char *key = keys[i].key;
        size_t whole = strlen(key), root = strcspn(key, ".");
        if (grouped && strncmp(key, path, group) != 0)
            continue;
        size_t from = grouped ? group : 0;
        bool by_whole = solver_suggest_try(&nearest, key + from, whole - from);
        bool by_root = !grouped && solver_suggest_try(&nearest, key, root); /* "material" of "material.nu" */
        best = by_whole || by_root ? key : best;
        shown = by_root ? root : by_whole ? whole : shown;
    }
    if (best)
        snprintf(out, size, ", did you mean %.*s?", (int)shown, best);
    else
        list_group(path, out, size);
}

int scene_word_find(const char *words, const char *word, bool *later)
{
    size_t length = strlen(word);
    int place = 0;
    *later = false;
    while (*words) {
        size_t step = strcspn(words, " ");
        if (*words == '|')
            *later = true;
        else if (step == length && !strncmp(words, word, length))
            return place;
        else
            place++;
        words += step + strspn(words + step, " ");
    }
    return -1;
}

void scene_word_at(const char *words, int place, char *out, size_t size)
{
    for (; place > 0; place--)
        words = strchr(words, ' ') + 1;
    snprintf(out, size, "%.*s", (int)strcspn(words, " "), words);
}

size_t solver_scene_words(const char *key, char (*word)[SOLVER_NAME], size_t room)
{
    int k = scene_key_find(key);
    const char *words = k < 0 ? "" : rules[k].words;
    size_t count = 0;
    while (*words && *words != '|' && count < room) { /* those promised for later come last */
        scene_word_at(words, 0, word[count++], SOLVER_NAME);
        words += strcspn(words, " ");
        words += strspn(words, " ");
    }
    return count;
}

void scene_number_text(double value, char *out, size_t size)
{
    for (int digits = 15; digits <= 17; digits++) {
        snprintf(out, size, "%.*g", digits, value);
        if (strtod(out, NULL) == value)
            return;
    }
}
